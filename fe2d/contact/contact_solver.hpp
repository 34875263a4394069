#pragma once

#include "fe2d/contact/released_system.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace damslip::fe2d {

/// How a contact problem was solved.
enum class ContactPath {
    newton,         ///< all violated pairs switched at once
    worst_violator, ///< one pair at a time
    gauss_seidel,   ///< Newton's iteration after a restart
    lemke,          ///< complementary pivoting
    unresolved      ///< nothing ended within its limits: the best state found is returned
};

/// Velocity of gaps that come to be held (shut, stuck) in a step.
enum class Landing {
    at_rest, ///< impulses make it zero
    ringing  ///< what Newmark's formulas leave, to compare with plain integrators: it changes sign every step
};

/// How contact problems are solved; the law itself is the scene's Contact.
struct ContactOptions {
    Landing landing =
        Landing::at_rest;         ///< of rigid sticking and hard contact; elastic laws bring gaps to rest themselves
    double tolerance = 1e-11;     ///< violations below this share of the largest stuck force are round-off [-]
    int newton_iterations = 15;   ///< 1 ... ; more only when the states cycle, which is detected
    int switches_per_pair = 8;    ///< limit of the one-at-a-time search
    int gauss_seidel_sweeps = 60; ///< of one restart
};

/// Residual of a solution, over the largest stuck force, above which it is none, whatever way led to it [-].
inline constexpr double largest_residual = 1e-7;

struct ContactReport {
    ContactPath path = ContactPath::newton;
    int iterations = 0;     ///< linear solutions with one set of states
    double residual = 0.0;  ///< complementarity residual over the largest stuck force [-]
    bool mechanism = false; ///< some set of states on the way left the structure loose
    bool resolved() const { return path != ContactPath::unresolved; }
};

/// Solves a sequence of contact problems with the same V: λ⁰ and strengths may change from one to the next. The factor
/// of a recent active set is kept, so a step with the same states costs one small solution.
///
/// Semismooth Newton on the states (Alart & Curnier 1991; Hüeber, Stadler & Wohlmuth 2008): solve with the states
/// held, re-read the states from the result, until they repeat themselves. Pure Newton can cycle where the structure
/// is stiff and undamped, so each repetition is noticed and leads to the next, slower and safer way: worst violator
/// first, a Gauss-Seidel restart, Lemke's method.
class ContactSolver {
public:
    explicit ContactSolver(std::shared_ptr<const Eigen::MatrixXd> stiffness, ContactOptions options = {});
    explicit ContactSolver(Eigen::MatrixXd stiffness, ContactOptions options = {});
    ContactSolver(const ContactSolver&) = delete;
    ContactSolver& operator=(const ContactSolver&) = delete;

    const Eigen::MatrixXd& stiffness() const { return *stiffness_; }

    /// @param stuck_force  λ⁰, 2m [N/m]
    /// @param solution     on entry its states are the start (those of the last step; empty: all stuck)
    /// @param definite     V is positive semi-definite; else nothing is tried where the search for states goes round
    ContactReport solve(const Eigen::VectorXd& stuck_force, const ContactLaw& law, ContactSolution& solution,
                        bool definite = true);

    /// Impulses on held gaps that change their rates by `held_jump` (2m, zero where not held), with the states of the last
    /// solution: none on open pairs, slipping ones slide on with Coulomb's friction. @returns false for a mechanism.
    /// @param solution  jumps of all gaps and impulses; on entry the states
    bool land(const ContactLaw& law, const Eigen::VectorXd& held_jump, ContactSolution& solution);

    /// The owner of V has changed its row k within the pair.
    void row_changed(Eigen::Index unknown) { system_.row_changed(unknown); }

    /// The owner of V has changed it anyhow.
    void stiffness_changed() { system_.stiffness_changed(); }

    const ReleasedSystem& system() const { return system_; }

private:
    bool newton(const ContactProblem& problem, ContactSolution& solution, ContactReport& report, double tolerance);
    /// @param opened  gets the pairs that were set open on the way, in order; null: not asked for
    bool one_by_one(const ContactProblem& problem, ContactSolution& solution, ContactReport& report, double tolerance,
                    std::vector<Eigen::Index>* opened = nullptr);
    bool break_one_by_one(const ContactProblem& problem, ContactSolution& solution, ContactReport& report,
                          double tolerance);
    bool evaluate(const ContactProblem& problem, ContactSolution& solution, ContactReport& report);

    /// Remembers which sets of states one search has tried.
    class Visited {
    public:
        void reserve(std::size_t sets) { marks_.reserve(sets); }
        void clear() { marks_.clear(); }
        bool seen_before(const ContactStates& states);

    private:
        std::vector<std::uint64_t> marks_;
    };

    std::shared_ptr<const Eigen::MatrixXd> stiffness_;
    ContactOptions options_;
    ReleasedSystem system_;

    // Work space: solutions with few changes of states allocate nothing.
    Visited visited_;
    ContactStates start_, next_;
    ContactLaw impulsive_; ///< of land()
    Eigen::VectorXd held_impulse_;
};

/// The state the result of a solution with states held asks for; the only place where states change.
ContactState next_state(const ContactProblem& problem, const ContactSolution& solution, Eigen::Index pair,
                        double tolerance);

/// Coulomb's law behind elastic slip whose stiffness follows the pressure (Goldgruber 2015, 4-10 to 4-12): a pair in
/// compression carries
///
///     λ_t = -(c + mu λ_n) e / γ_e,   |e| <= γ_e
///
/// e is the elastic slip, which the pair remembers; what goes beyond γ_e is slip. Falling pressure takes shear away
/// from a pair that does not move, so the law is neither symmetric nor conservative. An open pair forgets its e.
///
/// Same V and λ⁰ as the contact problem, of which it is the limit γ_e -> 0. Newton on states and mobilised share e/γ_e
/// together; where that does not end, stiffnesses (c + mu λ_n)/γ_e are held, that problem is solved exactly with all
/// safeguards of ContactSolver, and the stiffnesses are renewed until they repeat themselves.
class SlipTolerance {
public:
    /// @param stiffness     V, kept by reference
    /// @param elastic_slip  γ_e of each pair, > 0 [m]
    SlipTolerance(const Eigen::MatrixXd& stiffness, Eigen::VectorXd elastic_slip, const ContactOptions& options);

    /// @param elastic   e of the pairs at the start, and at the end [m]
    /// @param solution  on entry states and, if there, forces of the start; its slips are net of the elastic ones
    ContactReport solve(const Eigen::VectorXd& stuck_force, const ContactLaw& law, Eigen::VectorXd& elastic,
                        ContactSolution& solution);

private:
    /// Whole steps of the gaps, slip and elastic slip together, in `displacement`.
    using Iterate = ContactSolution;
    struct Step {
        const Eigen::VectorXd& stuck_force;
        const ContactLaw& law;
        const Eigen::VectorXd& elastic; ///< at the start
        double tolerance;               ///< [N/m]
    };
    bool newton(const Step& step, Iterate& iterate, ContactReport& report) const;
    bool linear_solution(const Step& step, Iterate& iterate) const;
    ContactState next(const Step& step, const Iterate& iterate, Eigen::Index pair) const;
    bool renewed_stiffness(const Step& step, Iterate& iterate, ContactReport& report) const;
    double residual(const Step& step, const Iterate& iterate) const;

    const Eigen::MatrixXd& stiffness_;
    Eigen::VectorXd limit_; ///< γ_e
    ContactOptions options_;
};

} // namespace damslip::fe2d
