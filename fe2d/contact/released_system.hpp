#pragma once

#include "fe2d/contact/contact_problem.hpp"

namespace damslip::fe2d {

/// The linear system of one set of contact states: the displacements that the states release, H x_D = r.
///
/// An open pair releases opening and slip, a slipping or pulled one its slip. Their rows are λ_n = 0, λ_t = 0 and
/// λ_t + κ λ_n = -+c with κ = ±mu, so H = (rows of V) restricted to the released columns; sticking pairs cost nothing.
/// The explicit inverse of H is kept and follows changes of few states by rank-one updates, O(|D|²) each; it is made
/// anew when more has changed or too many updates have gone by.
class ReleasedSystem {
public:
    explicit ReleasedSystem(const Eigen::MatrixXd& stiffness);

    /// Brings the system to these states. @returns false when it is singular (a mechanism).
    bool set(const ContactStates& states, const ContactLaw& law);

    /// Solves for the released displacements: x and λ of the states in the system. x is zero where not released.
    /// @returns false when the rows are not met to round-off, even after a fresh factorisation.
    bool solve(const ContactLaw& law, const Eigen::VectorXd& stuck_force, ContactSolution& solution);

    /// V_kk has grown by so much [N/m²]: the system follows at the price of one rank-one update.
    void diagonal_changed(Eigen::Index unknown, double by);

    /// V has changed anyhow: the inverse is made anew when it is needed next.
    void stiffness_changed();

    int updates() const { return updates_; }   ///< rank-one updates so far
    int rebuilds() const { return rebuilds_; } ///< inverses made from scratch so far

private:
    /// What a released unknown demands: λ_k + coupling λ_normal = right-hand side.
    struct Row {
        bool released = false;
        double coupling = 0.0;
        friend bool operator==(const Row&, const Row&) = default;
    };
    void wanted_rows(const ContactStates& states, const ContactLaw& law);
    Eigen::VectorXd row_of(Eigen::Index unknown, const Row& row) const; ///< row of V combined with that of its normal
    bool add(Eigen::Index unknown, const Row& row);
    bool remove(Eigen::Index unknown);
    bool change(Eigen::Index unknown, const Row& row);
    bool rebuild();
    void clear();
    double row_residual(const ContactLaw& law, const ContactSolution& solution, Eigen::VectorXd& residual) const;
    double right_hand_side(Eigen::Index unknown, const ContactLaw& law, const ContactStates& states) const;

    const Eigen::MatrixXd& stiffness_;
    Eigen::Index pairs_;
    std::vector<Row> rows_, wanted_;           ///< by unknown
    std::vector<Eigen::Index> place_;          ///< of an unknown in the system; -1: not released
    std::vector<Eigen::Index> unknowns_;       ///< by place
    Eigen::MatrixXd inverse_;                  ///< leading |D| x |D| part in use
    Eigen::VectorXd column_, line_, residual_; ///< work space
    bool regular_ = true;
    int updates_ = 0, rebuilds_ = 0, updates_since_rebuild_ = 0;
};

} // namespace damslip::fe2d
