#pragma once

#include "fe2d/contact/contact_problem.hpp"

#include <utility>
#include <vector>

namespace damslip::fe2d {

/// The linear system of one set of contact states: the displacements that the states release, H x_D = r.
///
/// An open pair releases opening and slip, a slipping or pulled one its slip. Their rows are λ_n = 0, λ_t = 0 and
/// λ_t + κ λ_n = -+c with κ = ±mu, so H = (rows of V) restricted to the released columns; sticking pairs cost nothing.
///
/// V is symmetric but for the two entries between opening and slip of a pair, where a bond that softens need not be.
///
/// One set of states, the base, is factorised: H₀ = LU. Other sets are the base with borders (Bisschop & Meeraus 1977; Gill,
/// Murray, Saunders & Wright 1984), one for each unknown whose row differs:
///
///     [H₀  C] [x₀]   [r₀]    added:    its column and row of V
///     [R   E] [s ] = [r₁]    removed:  C = e_k takes its row out, R = e_kᵀ makes x_k zero
///                            changed:  C = e_k takes its row out, R is the new one
///
/// With Y = H₀⁻¹C and S = E - R Y:  s = S⁻¹ (r₁ - R H₀⁻¹r₀),  x₀ = H₀⁻¹r₀ - Y s. A border costs one solution with LU, O(|D|²), and
/// is dropped when its unknown comes back to the base. When too many differ the present set becomes the base.
class ReleasedSystem {
public:
    explicit ReleasedSystem(const Eigen::MatrixXd& stiffness);

    /// Brings the system to these states. @returns false when it is singular (a mechanism).
    bool set(const ContactStates& states, const ContactLaw& law);

    /// Solves for the released displacements: x and λ of the states in the system. x is zero where not released.
    /// @returns false when the rows are not met to round-off, even after a fresh factorisation.
    bool solve(const ContactLaw& law, const Eigen::VectorXd& stuck_force, ContactSolution& solution);

    /// V_kk, or V between opening and slip of the pair in row k, has changed: the next set() puts a border for it.
    void row_changed(Eigen::Index unknown);

    /// V has changed anyhow: a base is made anew when it is needed next.
    void stiffness_changed();

    int updates() const { return updates_; }   ///< borders put so far
    int rebuilds() const { return rebuilds_; } ///< bases factorised so far

private:
    /// What a released unknown demands: λ_k + coupling λ_normal = right-hand side.
    struct Row {
        bool released = false;
        double coupling = 0.0;
        friend bool operator==(const Row&, const Row&) = default;
    };
    enum class BorderKind { none, added, removed, changed };
    struct Border {
        Eigen::Index unknown = -1;
        BorderKind kind = BorderKind::none;
        Row row;
        friend bool operator==(const Border&, const Border&) = default;
    };
    static std::pair<Row, Row> rows_of(ContactState state, double friction); ///< of a pair: normal, shear
    /// Rows of the pairs whose state or friction is another one. @returns false where all rows are what they were
    bool take_rows(const ContactStates& states, const Eigen::VectorXd& friction);
    Border wanted_border(std::size_t unknown) const;
    bool follow_by_borders();
    void put(const Border& border);
    void drop(std::size_t border);
    bool factorise_corner();
    void rebuild_base();
    bool rebuild();
    double entry(Eigen::Index unknown, const Row& row,
                 Eigen::Index column) const; ///< of the row of V with its normal's
    void row_residual(const ContactLaw& law, const ContactSolution& solution);
    void solve_for_step();
    double right_hand_side(Eigen::Index unknown, const ContactLaw& law, const ContactStates& states) const;

    const Eigen::MatrixXd& stiffness_;
    Eigen::Index pairs_;
    std::vector<Row> rows_;              ///< by unknown
    ContactStates states_;               ///< that they are of
    Eigen::VectorXd friction_;           ///< the same
    std::vector<Eigen::Index> unknowns_; ///< released now
    bool settled_ = true;                ///< the borders belong to rows_ and to V as it is
    bool regular_ = true;

    std::vector<Row> base_rows_;      ///< by unknown
    std::vector<char> stale_;         ///< by unknown: V_kk of the base has changed since
    std::vector<Eigen::Index> base_;  ///< unknowns by place
    std::vector<Eigen::Index> place_; ///< of an unknown in the base; -1: not in it
    Eigen::MatrixXd factor_;          ///< LU in its leading |D₀| x |D₀| part
    std::vector<Eigen::Index> pivots_;

    std::vector<Border> borders_;
    Eigen::MatrixXd columns_, lines_; ///< Y and Rᵀ, a column for each border
    Eigen::MatrixXd corner_;          ///< S
    Eigen::MatrixXd corner_factor_;   ///< its LU
    std::vector<Eigen::Index> corner_pivots_;

    Eigen::VectorXd residual_, step_, base_part_, border_part_; ///< work space; the first two by unknown
    double largest_ = 0.0;                                      ///< residual
    int updates_ = 0, rebuilds_ = 0;
};

} // namespace damslip::fe2d
