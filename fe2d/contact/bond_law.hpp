#pragma once

#include "fe2d/contact/joint_law.hpp"
#include "scene/joint_laws.hpp"

#include <vector>

namespace damslip::fe2d {

/// Strength of the bond of one pair; areas counted in.
struct BondStrength {
    double area = 0.0;           ///< A [m]
    double tension = 0.0;        ///< f_t A [N/m]
    double shear = 0.0;          ///< c A [N/m]
    double tension_energy = 0.0; ///< G_I A [J/m]
    double shear_energy = 0.0;   ///< G_II A [J/m]
    double opening = 0.0;        ///< w_I = G_I/(f_t S(1)): opening that breaks it [m]
    double slip = 0.0;           ///< w_II = G_II/(c S(1)) [m]
    double friction = 0.0;       ///< mu for the first damage [-]
    BondUnloading unloading = BondUnloading::origin;
    BondSoftening softening = BondSoftening::linear;
    double increase = 1.0;       ///< of strengths and energies in motion, over those at rest [-]

    bool any() const { return tension > 0.0 || shear > 0.0; }

    /// Share of the strength that is left at damage κ. Linear 1 - κ; exponential (e^(-Nκ) - e^(-N))/(1 - e^(-N)), N = ln 1000.
    double left(double damage) const;
    double slope(double damage) const; ///< -d left/dκ
    double work(double damage) const;  ///< S(κ) = ∫ left dκ from 0; S(1) is 1/2 where linear, 0.1438 where exponential
    double spent(double damage) const; ///< share of the fracture energy that is gone at κ, what is stored left out
    double softness(double damage) const { return left(damage) / damage; } ///< h
    double damage_at(double softness) const;                               ///< κ with this h
};

/// How far a joint has cracked [m].
struct BondLengths {
    double bonded = 0.0;  ///< of the intact joint; 0: it has no bond
    double damaged = 0.0; ///< has reached its strength and softened, broken length included
    double broken = 0.0;  ///< carries nothing but friction any more
    double upstream = 0.0, downstream = 0.0; ///< of it, from that end on without a bonded pair between

    double ligament() const { return bonded - broken; }
    bool through() const { return broken >= bonded * (1.0 - 1e-9); } ///< from end to end: sums round
};

/// The bond of one pair. Without tensile strength opening breaks it as slip does, w_I = w_II, and takes no work across the
/// joint; without cohesion the other way round.
/// @param area  [m] @param friction  mu [-] @pre an energy for each strength
BondStrength bond_strength(double area, double friction, double cohesion, const Bond& bond);

/// Bond with fracture energy (JOINTS 1): a cohesive law in two modes beside Coulomb's friction. With g⁺ = max(g, 0) and the
/// largest damage κ ever,
///
///     ε = √((g⁺/w_I)² + (s/w_II)²),   κ = max(κ, min(ε, 1)),   h = left(κ)/κ,
///
/// the bond pulls with f_t h g⁺/w_I and c h s/w_II: along any straight path its strength falls as BondStrength::left says, linear
/// or exponential, which costs
/// G_I cos²ψ + G_II sin²ψ (Camanho & Dávila 2002; beside friction Alfano & Sacco 2006). A pair is rigid until tension and
/// shear beyond friction reach √((-λ_n/f_tA)² + (|λ_t|/cA)²) = 1. Unloading goes to the origin; `plastic` unloads along
/// the joint with the stiffness at first damage.
///
/// A step in time finds x by Newton's iteration: each solution has the force of the law at the strains of the one before, and
/// its tangent as Z, which along a straight path is -f_t A slope(κ)/w_I, with linear softening the line of the law itself. The tangent of mixed modes is not
/// symmetric unless G_I = G_II. Statics, where V may be singular, and plastic unloading find the damage by fixed points
/// κ = ε(x(κ)), pair by pair with a secant. A step in time is too long where the bond softens faster than what is around unloads, V - diag(A f_t/w_I, A c/w_II) slope(κ) not positive
/// definite on the pairs that break: there it may have more than one answer. V grows as 1/Δt².
class BondLaw final : public JointLaw {
public:
    /// @param first_damage  κ₀ of a pair that has just reached its strength: it gives way by κ₀ w before it softens, with
    /// (1 - κ₀)/κ₀ times the stiffness of a bond half broken. The law's limit κ₀ -> 0 is rigid; loads and energies are off
    /// by a share of about κ₀. Exponential softening begins at the same opening κ₀ 2G/f, where 1 - 2κ₀ of f is left.
    explicit BondLaw(std::vector<BondStrength> pairs, double first_damage = 1e-3);

    std::unique_ptr<JointLaw> clone() const override { return std::make_unique<BondLaw>(*this); }
    void begin(const JointStart& start) override;
    void add(JointTerms& terms) const override;
    JointFit revise(const ContactSolution& solution) override;
    void end(const ContactSolution& solution) override;
    JointEnergy energy() const override;
    void save(JointLawState& state) const override;
    void restore(const JointLawState& state) override;

    /// Strengths and energies as in motion, BondStrength::increase times those at rest, or at rest again. A damaged bond keeps
    /// its stiffness, so no force changes: its damage becomes that which has the same line to the origin.
    void set_motion(bool moving);

    const std::vector<BondStrength>& strength() const { return strength_; }
    const Eigen::VectorXd& damage() const { return damage_; }    ///< κ of each pair: 0 intact, 1 broken [-]
    /// Length of the bonded pairs among these, of those that have softened, and of those that are broken [m].
    BondLengths lengths(Eigen::Index first, Eigen::Index pairs) const;
    double broken(Eigen::Index first, Eigen::Index pairs) const; ///< share of the bond's fracture work spent [-]

    /// For path following, where the caller decides which pair breaks next. How far a solution is beyond the damage of
    /// each pair: ε/κ, or the first-damage measure of rigid pairs; 0 of broken ones [-].
    Eigen::VectorXd excess(const ContactSolution& solution) const;
    /// Damages a pair for the first time, or by a share of the damage it has.
    void damage_more(Eigen::Index pair, double share);
    /// A copy that keeps its damage whatever the solution: revise() fits always.
    std::unique_ptr<BondLaw> held() const;
    std::unique_ptr<BondLaw> released() const; ///< a copy whose damage follows the solutions again

private:
    /// Opening and slip of a pair over what breaks it.
    struct Strain {
        double across = 0.0, along = 0.0;
        double size() const;
    };
    /// Which way a bond of plastic unloading yields.
    enum class Yield : signed char { upstream = -1, none = 0, downstream = 1 };

    /// What the bond of a pair holds against opening and slip [N/m], and its derivatives by them [N/m²].
    struct Pull {
        double across = 0.0, along = 0.0;
        double nn = 0.0, nt = 0.0, tn = 0.0, tt = 0.0;
    };

    Strain strain(Eigen::Index pair, const ContactSolution& solution) const;
    double smallest(Eigen::Index pair) const; ///< κ₀ of the pair
    bool by_tangent(Eigen::Index pair) const; ///< does the step at hand find it by Newton's iteration?
    double least_damage(Eigen::Index pair) const; ///< of the step at hand, of a pair that is damaged
    Pull pull(Eigen::Index pair, const Strain& strain) const;
    void add_tangent(Eigen::Index pair, JointTerms& terms) const;
    JointFit revise_tangent(Eigen::Index pair, const ContactSolution& solution);
    void break_first(Eigen::Index pair, const ContactSolution& solution);
    void goes_on_softening(Eigen::Index pair);
    double first_damage(Eigen::Index pair, const ContactSolution& solution) const;
    double energy_of(Eigen::Index pair, const Strain& strain) const;
    double guess(Eigen::Index pair, double wanted, double strain) const;
    JointFit revise_pair(Eigen::Index pair, const ContactSolution& solution);
    bool revise_yield(Eigen::Index pair, const ContactSolution& solution);
    bool unique(const ContactSolution& solution) const;
    double elastic_slip(Eigen::Index pair, const ContactSolution& solution) const;
    double initial_stiffness(Eigen::Index pair) const;
    bool plastic(Eigen::Index pair) const;

    std::vector<BondStrength> strength_;
    double smallest_damage_;    ///< κ₀
    Eigen::VectorXd damage_;    ///< κ
    Eigen::VectorXd reference_; ///< slip without shear in the bond: moves where it unloads plastically [m]
    Eigen::VectorXd path_;      ///< plastic slip so far, its way [m]
    double fracture_ = 0.0;     ///< spent [J/m]
    double stored_ = 0.0;       ///< [J/m]

    // Of the step at hand.
    Eigen::VectorXd start_damage_;
    Eigen::VectorXd slip_; ///< at its start [m]
    std::vector<Yield> yield_;
    std::vector<Strain> at_;                      ///< of the solution before: where the tangent is taken
    Eigen::VectorXd tried_damage_, tried_strain_; ///< of the solution before the last; strain < 0: none
    const Eigen::MatrixXd* stiffness_ = nullptr;  ///< V; null: not known
    int solutions_ = 0;
    bool held_ = false;
    bool static_ = true;
    bool moving_ = false; ///< of set_motion()
};

} // namespace damslip::fe2d
