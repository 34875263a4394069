#pragma once

#include "fe2d/contact/contact_problem.hpp"
#include "fe2d/contact/contact_solver.hpp"
#include "scene/joint_laws.hpp"

#include <Eigen/Core>

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

/// Soft contact pressure that falls with the clearance g of the two sides (Goldgruber 2015, section 6.3; "exponential
/// pressure-overclosure" of Abaqus):
///
///     p = p0/(e - 1) z (exp z - 1),   z = 1 - g/c0;   p = 0 for g >= c0
///
/// p0 at zero clearance, zero from the clearance c0 on, with a zero slope there: p has a continuous derivative, falls
/// everywhere in g < c0 and has the energy w = ∫ p dg, so it is conservative. c0 -> 0 is hard contact.
///
/// At the penetration z = `deepest` (p = 5e18 p0) and beyond the law goes on along its tangent, so nothing overflows.
class ExponentialPressure {
public:
    static constexpr double deepest = 40.0;

    /// @param at_zero_clearance  p0, > 0 [Pa]
    /// @param at_zero_pressure   c0, > 0 [m]
    ExponentialPressure(double at_zero_clearance, double at_zero_pressure);

    double pressure(double clearance) const;  ///< p, >= 0 [Pa]
    double stiffness(double clearance) const; ///< -dp/dg, >= 0 [N/m³]
    double energy(double clearance) const;    ///< w, from the clearance on, >= 0 [J/m²]
    double clearance(double pressure) const;  ///< g of a pressure > 0 [m]; the inverse of pressure()
    double range() const { return range_; }   ///< c0 [m]

private:
    double unit_;  ///< p0/(e - 1) [Pa]
    double range_; ///< c0 [m]
};

/// Contact whose normal forces follow an ExponentialPressure of the clearance, with Coulomb's friction on top:
///
///     λ_n = A p(g) >= 0,   |λ_t| <= c + mu λ_n where g < c0,   λ = 0 where g >= c0
///
/// Same V and λ⁰ as the contact problem (λ⁰ of shut sides, g = 0; x = (clearance g, slip)), of which it is the limit
/// c0 -> 0. The pairs are never `pulled`, and `open` means g >= c0.
///
/// Newton on states and clearances together: all normal rows are released, λ_n + D g = A p(ĝ) + D ĝ with the tangent
/// D = -A p'(ĝ). A pair that closes takes its next ĝ from the force of the tangent, one that opens from its clearance
/// (Ho, Ruehli & Brennan 1975 for diodes, whose law is the same): steps along the exponential neither overshoot nor
/// overflow. Where the states cycle, the tangents are held, friction is then solved exactly with all safeguards of
/// ContactSolver, and the tangents are renewed.
class ExponentialNormal {
public:
    /// @param stiffness  V
    /// @param area       of each pair [m]
    ExponentialNormal(Eigen::MatrixXd stiffness, Eigen::VectorXd area, const ExponentialPressure& pressure,
                      const ContactOptions& options);

    /// @param solution  on entry states and forces of the start; without forces all pairs start at zero clearance
    ContactReport solve(const Eigen::VectorXd& stuck_force, const ContactLaw& law, ContactSolution& solution) const;

private:
    struct Step {
        const Eigen::VectorXd& stuck_force;
        const ContactLaw& law;
        double tolerance; ///< [N/m]
    };
    struct Iterate {
        ContactSolution at;
        Eigen::VectorXd point; ///< ĝ, where the law is linearised [m]
    };
    /// λ_n = constant - tangent g.
    struct Tangent {
        Eigen::VectorXd stiffness; ///< D [N/m²]
        Eigen::VectorXd constant;  ///< [N/m]
    };
    Iterate start(const ContactSolution& given) const;
    Tangent tangent(const Eigen::VectorXd& point) const;
    bool newton(const Step& step, Iterate& it, ContactReport& report) const;
    bool linear_solution(const Step& step, Iterate& it) const;
    double next_point(const Iterate& it, Eigen::Index pair) const;
    ContactState next_state(const Step& step, const Iterate& it, Eigen::Index pair, double point) const;
    bool renewed_tangents(const Step& step, Iterate& it, ContactReport& report) const;
    bool friction_solution(const Step& step, Iterate& it, ContactReport& report) const;
    double residual(const Step& step, const ContactSolution& at) const;

    Eigen::MatrixXd stiffness_;
    Eigen::VectorXd area_;
    ExponentialPressure pressure_;
    ContactOptions options_;
};

/// Tangential penalty of constant stiffness in front of Coulomb's law: a sticking pair gives way by -λ_t / (k A), the
/// slip is what goes beyond it. The same contact problem with V' = V (I + C V)⁻¹ = (W + C)⁻¹, so the penalty's error is
/// what a run with and a run without it differ by. At k = 2e8 N/m³ (about a slip tolerance of 0.005 with 0.5 m
/// elements) it puts a spring near the first frequency under the dam; from 1e11 on it changes the slip by less than 1 %.
class ElasticStick {
public:
    ElasticStick() = default;
    /// @param stiffness   V; replaced by V'
    /// @param compliance  1/(k A) of each pair [m²/N]
    ElasticStick(Eigen::MatrixXd& stiffness, const Eigen::VectorXd& compliance);

    bool active() const { return compliance_.size() > 0; }
    /// λ⁰ of the rigid stick problem into that of V'; `elastic` is the elastic part of the tangential gaps at which λ⁰
    /// holds them, m values [m].
    void soften(Eigen::VectorXd& stuck_force, const Eigen::VectorXd& elastic) const;
    /// Elastic part of the tangential gaps, -C λ_t, m values [m].
    Eigen::VectorXd give(const Eigen::VectorXd& force) const;

private:
    Eigen::VectorXd compliance_; ///< m values
    Eigen::MatrixXd soften_;     ///< (I + V C)⁻¹
    Eigen::MatrixXd tangential_; ///< V' of the tangential gaps, 2m x m
};

} // namespace damslip::fe2d
