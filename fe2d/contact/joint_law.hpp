#pragma once

#include "fe2d/contact/contact_problem.hpp"
#include "scene/joint_laws.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace damslip::fe2d {

/// Energy of the laws of a joint beside hard contact and Coulomb's friction, summed up from the start [J/m].
struct JointEnergy {
    double stored = 0.0;         ///< in bonds and anchors; given back
    double bond_fracture = 0.0;  ///< spent on breaking bonds
    double anchor_plastic = 0.0; ///< spent on yielding anchors
    double anchor_loss = 0.0;    ///< stored in anchors that snapped
    double water = 0.0;          ///< done by the water in the joint, beyond its pressure before the earthquake

    /// What forces of the laws have taken from dam and rock.
    double taken() const { return stored + bond_fracture + anchor_plastic + anchor_loss - water; }
    JointEnergy& operator+=(const JointEnergy& other);
};

/// What a law does to the contact problem in its present state. Contact forces become
///
///     λ_c = λ⁰ + r + (V + Z) x,   x = (opening g_N at the end of the step, slip s within it),
///
/// so the law's own force on the upper side is -(r + Z x), and all that crosses the joint λ = λ_c - (r + Z x) = λ⁰ + V x.
///
/// Z is symmetric and positive semi-definite, but for the tangent of a bond that softens. It is kept as sparse as the laws are: a dense Z would cost as much as a step.
struct JointTerms {
    /// Part of Z on unknowns that follow each other, from `first` on [N/m²].
    struct Block {
        Eigen::Index first = 0;
        std::shared_ptr<const Eigen::MatrixXd> stiffness; ///< another one whenever it changes
        bool operator==(const Block&) const = default;
    };
    /// One entry of Z beside the diagonal and the blocks [N/m²]; its mirror image is one more.
    struct Entry {
        Eigen::Index row = 0, column = 0;
        double value = 0.0;
        bool operator==(const Entry&) const = default;
    };

    Eigen::VectorXd diagonal; ///< of Z, 2m [N/m²]; the blocks' and entries' own diagonals come on top
    Eigen::VectorXd cross;    ///< of Z between the two unknowns of a pair, by row, 2m; need not be symmetric [N/m²]
    std::vector<Block> blocks;
    std::vector<Entry> entries;
    Eigen::VectorXd force;    ///< r, 2m [N/m]
    ContactLaw strength;      ///< of λ_c: a law may change friction and cohesion of pairs
    std::vector<char> bonded; ///< m: not 0, x of the pair is zero whatever the force

    void clear(const ContactLaw& plain);                                         ///< no laws: Z = 0, r = 0
    void add_stiffness(const Eigen::VectorXd& x, Eigen::VectorXd& f) const;      ///< f += Z x
    void subtract_stiffness(const Eigen::VectorXd& x, Eigen::VectorXd& f) const; ///< f -= Z x
};

/// What laws need of the start of a step. References live as long as the step.
struct JointStart {
    double dt = 0.0;                ///< [s]; 0: a static stage
    const Eigen::VectorXd& opening; ///< m [m]
    const Eigen::VectorXd& slip;    ///< sum so far, m [m]
    const ContactStates& states;
    /// Rate of the slip at the end of the step: rate_slope s + rate_known [1/s], m [m/s]; static: 0, empty
    double rate_slope = 0.0;
    Eigen::VectorXd rate_known = {};
    const Eigen::MatrixXd* stiffness = nullptr; ///< V; JointLaws::solve() knows it
    const ContactLaw* strength = nullptr;       ///< of the pairs without the laws; the same
};

/// What laws keep of a dam at rest, as numbers by name: the key says what and in which unit.
using JointLawState = std::map<std::string, std::vector<double>>;

/// How a law takes the solution of a contact problem.
enum class JointFit {
    fits,    ///< its state is that of the solution
    changed, ///< the state is another one: solve again
    too_far  ///< it gives up: the step is too long (made in halves), a static stage needs another way
};

/// A law of the joint beside hard contact and Coulomb's friction: bond, anchor, water in the opening joint, friction over
/// the rate. Its state belongs to ContactMemory and is copied with it, so a step that is given up leaves no trace.
///
/// A step: begin(), then { add(), the contact problem, revise() } until it fits, then end(). A static stage is a step without
/// time, dt = 0.
class JointLaw {
public:
    virtual ~JointLaw() = default;
    virtual std::unique_ptr<JointLaw> clone() const = 0;

    virtual void begin(const JointStart& start) = 0;
    /// Adds its part in its present state.
    virtual void add(JointTerms& terms) const = 0;
    /// @param solution  x, and λ_c as force
    virtual JointFit revise(const ContactSolution& solution) = 0;
    /// The step is made. @param solution  as of revise(), the last one
    virtual void end(const ContactSolution& solution) = 0;
    virtual JointEnergy energy() const = 0; ///< after end()

    /// Adds what it keeps of a dam at rest.
    virtual void save(JointLawState&) const {}
    /// Goes on from what the law of the same scene saved. @pre numbers that save() would write
    virtual void restore(const JointLawState&) {}
};

/// Friction of one plane over the rate of slip.
struct RateFrictionPart {
    Eigen::Index first = 0, pairs = 0; ///< of the plane
    RateFriction law;
};

/// Friction over the rate of slip, pair by pair: mu = mu_s(S) r with
///
///     r(v) = k + (1 - k) exp(-|v|/v_c),   k = mu_k/mu_s      (Stribeck curve; Armstrong-Hélouvry et al. 1994, eq. (4))
///     r' = (r(v) - r)(1/tau + |v|/d)                         where it lags; mu_s(S) never does
///
/// v is the rate of the step's end, by the scheme's formula v = rate_slope s + rate_known; zero of a pair that sticks. A pair
/// that is open keeps its r. Over a step r goes on as by the constant rate v: exact for one.
///
/// Each contact problem is solved with r given (Z = 0, r = 0: pairs that stick do not feel the law), then r is found anew from
/// its slips, until no mu changes by more than 1e-12. With V_tt the stiffness of the slipping pairs and
///
///     D = diag(λ_n mu_s (-dr/dv) rate_slope)
///
/// the errors of one solution are V_tt⁻¹D of the one before, and the answer is the only one where V_tt - D is positive
/// definite (Cholesky) for the rates on the way through the step: D is taken with the smaller of the rates at its start and
/// end, where r falls most steeply. A start from rest so needs steps of a rigid block below v_c/(g' Δmu) for a rate of first
/// order, g' = N'/M. Where it is not, or no friction settles, the step is too_far and made in halves, in which V grows as
/// 1/Δt² and rate_slope as 1/Δt.
class RateFrictionLaw final : public JointLaw {
public:
    /// @param pairs  m, of all planes; those of no part keep their friction
    RateFrictionLaw(Eigen::Index pairs, std::vector<RateFrictionPart> parts);

    std::unique_ptr<JointLaw> clone() const override { return std::make_unique<RateFrictionLaw>(*this); }
    void begin(const JointStart& start) override;
    void add(JointTerms& terms) const override;
    JointFit revise(const ContactSolution& solution) override;
    void end(const ContactSolution& solution) override;
    JointEnergy energy() const override { return {}; } ///< friction's work is the ledger's

    const Eigen::VectorXd& ratio() const { return ratio_; } ///< r at the end of the last step [-]

private:
    /// r at the end of the step and its slope dr/dv, |v| given.
    struct Value {
        double ratio, slope;
    };
    Value value(const RateFriction& law, double start, double rate) const;
    bool unique(const ContactSolution& solution) const;

    std::vector<RateFrictionPart> parts_;
    Eigen::VectorXd ratio_, rate_; ///< r and |v| at the end of the last step

    // Of the step being made.
    double dt_ = 0.0, rate_slope_ = 0.0;
    Eigen::VectorXd rate_known_, trial_, rate_then_, slope_, strength_; ///< strength_: mu_s of the pairs
    const Eigen::MatrixXd* stiffness_ = nullptr;
    int solutions_ = 0;
};

} // namespace damslip::fe2d
