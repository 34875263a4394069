#include "fe2d/contact/joint_laws.hpp"

#include <algorithm>
#include <typeinfo>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Solutions of one step: damage can only grow and anchors yield once in each, so this many are never needed.
constexpr int most_rounds = 500;

} // namespace

JointEnergy& JointEnergy::operator+=(const JointEnergy& other)
{
    stored += other.stored;
    bond_fracture += other.bond_fracture;
    anchor_plastic += other.anchor_plastic;
    anchor_loss += other.anchor_loss;
    water += other.water;
    return *this;
}

JointLawSolver::JointLawSolver(std::shared_ptr<const MatrixXd> stiffness, const ContactOptions& options)
    : stiffness_(std::move(stiffness)), options_(options)
{
}

/// Damage changes Z on its diagonal alone, mostly of few pairs. @returns false: V + Z is better made anew
bool JointLawSolver::change_diagonal(const MatrixXd& added)
{
    MatrixXd change = added - added_;
    const VectorXd on_diagonal = change.diagonal();
    change.diagonal().setZero();
    if (!change.isZero(0.0)) return false;
    const auto size = static_cast<Index>(unknowns_.size());
    if (3 * (on_diagonal.array() != 0.0).count() > size) return false;
    for (Index k = 0; k < size; ++k) {
        const double by = on_diagonal[unknowns_[static_cast<std::size_t>(k)]];
        if (by == 0.0) continue;
        (*seen_)(k, k) += by;
        solver_->diagonal_changed(k, by);
    }
    added_ = added;
    return true;
}

void JointLawSolver::prepare(const JointTerms& terms)
{
    if (!bonded_.empty() && bonded_ == terms.bonded) {
        if (added_ == terms.stiffness) return;
        if (solver_ && change_diagonal(terms.stiffness)) return;
    }
    bonded_ = terms.bonded;
    added_ = terms.stiffness;
    unknowns_.clear();
    const auto m = static_cast<Index>(bonded_.size());
    for (const Index shift : {Index{0}, m})
        for (Index i = 0; i < m; ++i)
            if (!bonded_[static_cast<std::size_t>(i)]) unknowns_.push_back(shift + i);
    solver_.reset();
    if (unknowns_.empty()) return;
    seen_ = std::make_shared<MatrixXd>((*stiffness_)(unknowns_, unknowns_));
    *seen_ += added_(unknowns_, unknowns_);
    solver_ = std::make_unique<ContactSolver>(seen_, options_);
}

ContactReport JointLawSolver::solve(const VectorXd& stuck_force, const JointTerms& terms, ContactSolution& solution)
{
    prepare(terms);
    const auto m = static_cast<Index>(terms.bonded.size());
    const VectorXd stuck = stuck_force + terms.force;
    ContactReport report;
    solution.states.resize(terms.bonded.size(), ContactState::stick);
    solution.displacement.setZero(2 * m);
    for (std::size_t i = 0; i < terms.bonded.size(); ++i)
        if (terms.bonded[i]) solution.states[i] = ContactState::stick;
    if (solver_) {
        const auto free = static_cast<Index>(unknowns_.size() / 2);
        ContactLaw law = uniform_law(free, 0.0);
        law.separation = terms.strength.separation;
        ContactSolution part;
        part.states.resize(static_cast<std::size_t>(free));
        for (Index k = 0; k < free; ++k) {
            const Index pair = unknowns_[static_cast<std::size_t>(k)];
            law.friction[k] = terms.strength.friction[pair];
            law.cohesion[k] = terms.strength.cohesion[pair];
            part.states[static_cast<std::size_t>(k)] = solution.states[static_cast<std::size_t>(pair)];
        }
        report = solver_->solve(stuck(unknowns_), law, part);
        for (Index k = 0; k < free; ++k)
            solution.states[static_cast<std::size_t>(unknowns_[static_cast<std::size_t>(k)])] =
                part.states[static_cast<std::size_t>(k)];
        solution.displacement(unknowns_) = part.displacement;
    }
    solution.force = stuck;
    solution.force.noalias() += *stiffness_ * solution.displacement;
    solution.force.noalias() += terms.stiffness * solution.displacement;
    return report;
}

JointLaws::JointLaws(const JointLaws& other) : contact_(other.contact_), force_(other.force_)
{
    for (const auto& law : other.laws_) laws_.push_back(law->clone());
}

JointLaws& JointLaws::operator=(const JointLaws& other)
{
    JointLaws copy(other);
    *this = std::move(copy);
    return *this;
}

void JointLaws::replace(std::unique_ptr<JointLaw> law)
{
    for (auto& old : laws_) {
        const JointLaw &of_old = *old, &of_new = *law;
        if (typeid(of_old) == typeid(of_new)) {
            old = std::move(law);
            return;
        }
    }
}

void JointLaws::terms_of(const ContactLaw& strength, JointTerms& terms) const
{
    const Index m = strength.pairs();
    terms.stiffness.setZero(2 * m, 2 * m);
    terms.force.setZero(2 * m);
    terms.strength = strength;
    terms.bonded.assign(static_cast<std::size_t>(m), 0);
    for (const auto& law : laws_) law->add(terms);
}

ContactReport JointLaws::solve(JointLawSolver& solver, const VectorXd& stuck_force, const JointStart& start,
                               const ContactLaw& strength, ContactSolution& solution)
{
    JointStart known = start;
    known.stiffness = solver.stiffness().get();
    known.strength = &strength;
    for (const auto& law : laws_) law->begin(known);
    ContactReport report;
    int iterations = 0;
    JointTerms terms;
    contact_.states = solution.states;
    for (int k = 0; k < most_rounds; ++k) {
        terms_of(strength, terms);
        report = solver.solve(stuck_force, terms, contact_);
        iterations += std::max(1, report.iterations);
        report.iterations = iterations;
        force_ = -terms.force;
        force_.noalias() -= terms.stiffness * contact_.displacement;
        JointFit fit = JointFit::fits;
        if (report.resolved())
            for (const auto& law : laws_) fit = std::max(fit, law->revise(contact_));
        if (!report.resolved() || fit != JointFit::changed) {
            if (fit == JointFit::too_far) report.path = ContactPath::unresolved;
            solution.states = contact_.states;
            solution.displacement = contact_.displacement;
            solution.force = contact_.force + force_;
            return report;
        }
    }
    report.path = ContactPath::unresolved;
    solution.states = contact_.states;
    solution.displacement = contact_.displacement;
    solution.force = contact_.force + force_;
    return report;
}

void JointLaws::end()
{
    for (const auto& law : laws_) law->end(contact_);
}

JointEnergy JointLaws::energy() const
{
    JointEnergy sum;
    for (const auto& law : laws_) sum += law->energy();
    return sum;
}

} // namespace damslip::fe2d
