#pragma once

#include "fe2d/contact/contact_solver.hpp"
#include "fe2d/contact/joint_law.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace damslip::fe2d {

/// Solvers of contact problems V + Z, kept from one solution to the next: most differ in λ⁰ alone. Damage that grows changes
/// Z within its pairs, which the factor follows; water in the joint changes a block of it.
class JointLawSolver {
public:
    JointLawSolver(std::shared_ptr<const Eigen::MatrixXd> stiffness, const ContactOptions& options);

    const std::shared_ptr<const Eigen::MatrixXd>& stiffness() const { return stiffness_; } ///< V

    /// Hard contact with Coulomb's friction and the terms of the laws; bonded pairs keep x = 0.
    /// @param stuck_force  λ⁰, 2m [N/m] @param solution  on entry where to start; after: x, λ_c
    ContactReport solve(const Eigen::VectorXd& stuck_force, const JointTerms& terms, ContactSolution& solution);

private:
    void prepare(const JointTerms& terms);
    void change_pairs(const JointTerms& terms);
    void fill();

    std::shared_ptr<const Eigen::MatrixXd> stiffness_;
    ContactOptions options_;
    Eigen::VectorXd diagonal_, cross_; ///< Z of the solver at hand
    std::vector<JointTerms::Block> blocks_;
    std::vector<JointTerms::Entry> entries_;
    std::shared_ptr<Eigen::MatrixXd> seen_; ///< V + Z
    std::unique_ptr<ContactSolver> solver_; ///< null: none made so far
};

/// The laws of all joints of a run, with their states. A copy has states of its own.
class JointLaws {
public:
    JointLaws() = default;
    JointLaws(const JointLaws& other);
    JointLaws& operator=(const JointLaws& other);
    JointLaws(JointLaws&&) noexcept = default;
    JointLaws& operator=(JointLaws&&) noexcept = default;

    void add(std::unique_ptr<JointLaw> law) { laws_.push_back(std::move(law)); }
    void replace(std::unique_ptr<JointLaw> law); ///< in place of the one of its type
    bool active() const { return !laws_.empty(); }
    const std::vector<std::unique_ptr<JointLaw>>& all() const { return laws_; }

    /// One step: the contact problem is solved again until every law fits.
    /// @param strength  of the pairs without the laws
    /// @param solution  on entry the states to start with; after: x, and λ of all that crosses the joint
    /// @returns unresolved also where a law gives up
    ContactReport solve(JointLawSolver& solver, const Eigen::VectorXd& stuck_force, const JointStart& start,
                        const ContactLaw& strength, ContactSolution& solution);
    void end(); ///< the last step that was solved is made

    /// Force of the laws on the upper side of the pairs in the last solution, -(r + Z x), 2m [N/m]; empty: no laws.
    const Eigen::VectorXd& force() const { return force_; }
    JointEnergy energy() const;

    JointLawState save() const; ///< of a dam at rest
    void restore(const JointLawState& state);

    /// The only law of a type; null: none.
    template <class Law>
    const Law* find() const
    {
        for (const auto& law : laws_)
            if (const auto* found = dynamic_cast<const Law*>(law.get())) return found;
        return nullptr;
    }

    template <class Law>
    Law* find()
    {
        return const_cast<Law*>(std::as_const(*this).template find<Law>());
    }

private:
    std::vector<std::unique_ptr<JointLaw>> laws_;
    ContactSolution contact_; ///< x and λ_c of the last solution
    Eigen::VectorXd force_;
};

/// For these laws. A bond that breaks in a step: shorter ones are cheaper than the slow methods, and their answer is the only one.
std::unique_ptr<JointLawSolver> law_solver(std::shared_ptr<const Eigen::MatrixXd> stiffness, const JointLaws& laws,
                                           ContactOptions options);

/// Contact by the scene's law: sticking is rigid (ContactSolver), gives way by a constant stiffness (ElasticStick) or by
/// elastic slip that follows the pressure (SlipTolerance), as Contact::enforcement says. Across the plane contact is hard
/// or, with the first two, soft (ExponentialNormal), as Contact::normal says.
class JointSolver {
public:
    /// @param stiffness  V of rigid sticking; solvers of one V may share it
    /// @param area       length of the base that belongs to each pair [m]
    /// @param law        enforcement and normal contact; its strength is the ContactLaw of each solution
    JointSolver(std::shared_ptr<const Eigen::MatrixXd> stiffness, const Eigen::VectorXd& area, const Contact& law,
                const ContactOptions& options = {});
    JointSolver(Eigen::MatrixXd stiffness, const Eigen::VectorXd& area, const Contact& law,
                const ContactOptions& options = {});
    JointSolver(const JointSolver&) = delete;
    JointSolver& operator=(const JointSolver&) = delete;

    const Eigen::MatrixXd& stiffness() const { return *stiffness_; } ///< V of rigid sticking
    const std::shared_ptr<const Eigen::MatrixXd>& shared_stiffness() const { return stiffness_; }

    /// @param stuck_force  λ⁰ of a gap that stays as it is, elastic part included [N/m]
    /// @param elastic      elastic part of the tangential gaps, at the start and at the end, m values [m]; zero where
    ///                     sticking is rigid
    /// @param solution     on entry states and forces of the start; its slips are net of the elastic part
    ContactReport solve(const Eigen::VectorXd& stuck_force, const ContactLaw& law, Eigen::VectorXd& elastic,
                        ContactSolution& solution);

    /// Do gaps come to be held between two sets of states, so that land() has to bring them to rest? Never where
    /// sticking or shutting is elastic, or with Landing::ringing.
    bool lands(const ContactStates& before, const ContactStates& now) const;
    /// Does a body that flew, every pair open, shut some pair between two sets of states? False where lands() is.
    bool shuts(const ContactStates& before, const ContactStates& now) const;
    /// Impulses that make the rates of all held gaps zero (ContactSolver::land()). Friction stops a slipping pair, it does
    /// not turn it round: such pairs come to stick. @returns false for a mechanism.
    /// @param rate  of all gaps, 2m @param jumps  states on entry and after; changes of the rates, and impulses
    bool land(const ContactLaw& law, const Eigen::VectorXd& rate, ContactSolution& jumps);
    /// Forces that make `values` of all held gaps zero, with the states as they are. @returns false for a mechanism.
    bool hold(const ContactLaw& law, const Eigen::VectorXd& values, ContactSolution& jumps);

private:
    std::shared_ptr<const Eigen::MatrixXd> stiffness_;
    ElasticStick elastic_stick_;
    std::unique_ptr<SlipTolerance> slip_tolerance_;
    std::unique_ptr<ExponentialNormal> soft_normal_; ///< of V, or of V' behind the elastic stick
    std::unique_ptr<ContactSolver> rigid_;           ///< the same
    bool lands_ = false;
    Eigen::VectorXd softened_, held_; ///< work space: λ⁰ behind the elastic stick; jumps of held gaps
};

/// Which of the 2m gaps a set of states holds as they are.
bool holds(const ContactStates& states, Eigen::Index gap);

/// Energy that soft normal contact stores at these openings, Σ A w(g) [J/m]; zero where contact is hard.
double stored_energy(const Contact& law, const Eigen::VectorXd& area, const Eigen::VectorXd& opening);

} // namespace damslip::fe2d
