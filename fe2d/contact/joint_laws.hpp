#pragma once

#include "fe2d/contact/contact_solver.hpp"
#include "fe2d/contact/joint_law.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace damslip::fe2d {

/// Solvers of contact problems V + Z, kept from one solution to the next: most differ in λ⁰ alone. Damage that grows changes
/// the diagonal of Z, which the factor follows; water in the joint changes a block of it.
class JointLawSolver {
public:
    JointLawSolver(std::shared_ptr<const Eigen::MatrixXd> stiffness, const ContactOptions& options);

    const std::shared_ptr<const Eigen::MatrixXd>& stiffness() const { return stiffness_; } ///< V

    /// Hard contact with Coulomb's friction and the terms of the laws; bonded pairs keep x = 0.
    /// @param stuck_force  λ⁰, 2m [N/m] @param solution  on entry where to start; after: x, λ_c
    ContactReport solve(const Eigen::VectorXd& stuck_force, const JointTerms& terms, ContactSolution& solution);

private:
    void prepare(const JointTerms& terms);
    bool change_diagonal(const Eigen::VectorXd& diagonal);
    void fill();

    std::shared_ptr<const Eigen::MatrixXd> stiffness_;
    ContactOptions options_;
    Eigen::VectorXd diagonal_; ///< Z of the solver at hand
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

} // namespace damslip::fe2d
