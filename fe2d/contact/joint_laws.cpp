#include "fe2d/contact/joint_laws.hpp"

#include "fe2d/contact/bond_law.hpp"

#include <algorithm>
#include <cassert>
#include <typeinfo>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Solutions of one step: damage can only grow and anchors yield once in each, so this many are never needed.
constexpr int most_rounds = 500;
constexpr double first_preload = 16.0; ///< of bonded pairs, over the largest stuck force; more where it does not do [-]
constexpr int most_preloads = 5;

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

void JointTerms::clear(const ContactLaw& plain)
{
    const Index m = plain.pairs();
    diagonal.setZero(2 * m);
    cross.setZero(2 * m);
    blocks.clear();
    entries.clear();
    force.setZero(2 * m);
    strength = plain;
    bonded.assign(static_cast<std::size_t>(m), 0);
}

void JointTerms::add_stiffness(const VectorXd& x, VectorXd& f) const
{
    const Index m = x.size() / 2;
    f.array() += diagonal.array() * x.array();
    f.head(m).array() += cross.head(m).array() * x.tail(m).array();
    f.tail(m).array() += cross.tail(m).array() * x.head(m).array();
    for (const Block& block : blocks) {
        const Index n = block.stiffness->rows();
        if (!x.segment(block.first, n).isZero(0.0))
            f.segment(block.first, n).noalias() += *block.stiffness * x.segment(block.first, n);
    }
    for (const Entry& entry : entries) f[entry.row] += entry.value * x[entry.column];
}

void JointTerms::subtract_stiffness(const VectorXd& x, VectorXd& f) const
{
    f = -f;
    add_stiffness(x, f);
    f = -f;
}

void JointLawSolver::fill()
{
    *seen_ = *stiffness_;
    const Index m = diagonal_.size() / 2;
    seen_->diagonal() += diagonal_;
    seen_->diagonal(m) += cross_.head(m);
    seen_->diagonal(-m) += cross_.tail(m);
    for (const JointTerms::Block& block : blocks_)
        seen_->block(block.first, block.first, block.stiffness->rows(), block.stiffness->cols()) += *block.stiffness;
    for (const JointTerms::Entry& entry : entries_) (*seen_)(entry.row, entry.column) += entry.value;
}

void JointLawSolver::change_pairs(const JointTerms& terms)
{
    const Index m = diagonal_.size() / 2;
    for (Index k = 0; k < 2 * m; ++k) {
        const Index other = k < m ? k + m : k - m;
        if (terms.diagonal[k] == diagonal_[k] && terms.cross[k] == cross_[k]) continue;
        (*seen_)(k, k) += terms.diagonal[k] - diagonal_[k];
        (*seen_)(k, other) += terms.cross[k] - cross_[k];
        solver_->row_changed(k);
    }
    diagonal_ = terms.diagonal;
    cross_ = terms.cross;
}

void JointLawSolver::prepare(const JointTerms& terms)
{
    if (solver_ && blocks_ == terms.blocks && entries_ == terms.entries) return change_pairs(terms);
    diagonal_ = terms.diagonal;
    cross_ = terms.cross;
    blocks_ = terms.blocks;
    entries_ = terms.entries;
    if (!seen_) seen_ = std::make_shared<MatrixXd>();
    fill();
    if (solver_)
        solver_->stiffness_changed();
    else
        solver_ = std::make_unique<ContactSolver>(seen_, options_);
}

ContactReport JointLawSolver::solve(const VectorXd& stuck_force, const JointTerms& terms, ContactSolution& solution)
{
    prepare(terms);
    const VectorXd stuck = stuck_force + terms.force;
    std::vector<Index> bonded;
    for (std::size_t i = 0; i < terms.bonded.size(); ++i)
        if (terms.bonded[i]) bonded.push_back(static_cast<Index>(i));
    const bool definite = terms.diagonal.minCoeff() >= 0.0;
    if (bonded.empty()) return solver_->solve(stuck, terms.strength, solution, definite);

    // Bonded pairs are pressed together by more than pulls or shears them, so they stick and stay out of the active set:
    // one that breaks is one more in it, and the inverse goes on.
    solution.states.resize(terms.bonded.size(), ContactState::stick);
    const ContactStates start = solution.states;
    ContactReport report;
    double preload = first_preload * stuck.cwiseAbs().maxCoeff();
    for (int attempt = 0; attempt < most_preloads; ++attempt, preload *= first_preload) {
        ContactLaw law = terms.strength;
        VectorXd pressed = stuck;
        solution.states = start;
        for (const Index i : bonded) {
            solution.states[static_cast<std::size_t>(i)] = ContactState::stick;
            pressed[i] += preload;
            law.cohesion[i] = preload;
        }
        report = solver_->solve(pressed, law, solution, definite);
        for (const Index i : bonded) solution.force[i] -= preload;
        if (std::all_of(bonded.begin(), bonded.end(),
                        [&](Index i) { return solution.states[static_cast<std::size_t>(i)] == ContactState::stick; }))
            return report;
    }
    report.path = ContactPath::unresolved;
    return report;
}

std::unique_ptr<JointLawSolver> law_solver(std::shared_ptr<const MatrixXd> stiffness, const JointLaws& laws, ContactOptions options)
{
    if (laws.find<BondLaw>()) options.gauss_seidel_sweeps = 0;
    return std::make_unique<JointLawSolver>(std::move(stiffness), options);
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
        terms.clear(strength);
        for (const auto& law : laws_) law->add(terms);
        report = solver.solve(stuck_force, terms, contact_);
        iterations += std::max(1, report.iterations);
        report.iterations = iterations;
        force_ = -terms.force;
        terms.subtract_stiffness(contact_.displacement, force_);
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

JointLawState JointLaws::save() const
{
    JointLawState state;
    for (const auto& law : laws_) law->save(state);
    return state;
}

void JointLaws::restore(const JointLawState& state)
{
    for (const auto& law : laws_) law->restore(state);
}

namespace {

/// γ_e = F_f l, l the mean length of the contact elements (Goldgruber 2015, 4-10): m pairs are m - 1 elements.
VectorXd elastic_slip(const VectorXd& area, double slip_tolerance)
{
    const auto elements = static_cast<double>(std::max<Eigen::Index>(1, area.size() - 1));
    return VectorXd::Constant(area.size(), slip_tolerance * area.sum() / elements);
}

} // namespace

double stored_energy(const Contact& law, const VectorXd& area, const VectorXd& opening)
{
    if (law.normal == NormalContact::hard) return 0.0;
    const ExponentialPressure pressure(law.pressure_at_zero_clearance, law.clearance_at_zero_pressure);
    double sum = 0.0;
    for (Eigen::Index i = 0; i < area.size(); ++i) sum += area[i] * pressure.energy(opening[i]);
    return sum;
}

JointSolver::JointSolver(std::shared_ptr<const MatrixXd> stiffness, const VectorXd& area, const Contact& law,
                         const ContactOptions& options)
    : stiffness_(std::move(stiffness))
{
    const bool soft = law.normal == NormalContact::exponential;
    assert(!(soft && law.enforcement == ContactEnforcement::slip_tolerance));
    if (law.enforcement == ContactEnforcement::slip_tolerance) {
        slip_tolerance_ = std::make_unique<SlipTolerance>(*stiffness_, elastic_slip(area, law.slip_tolerance), options);
        return;
    }
    std::shared_ptr<const MatrixXd> seen = stiffness_;
    if (law.enforcement == ContactEnforcement::penalty) {
        MatrixXd softened = *stiffness_;
        elastic_stick_ = ElasticStick(softened, (law.tangential_stiffness.value() * area).cwiseInverse());
        seen = std::make_shared<const MatrixXd>(std::move(softened));
    }
    if (soft)
        soft_normal_ = std::make_unique<ExponentialNormal>(
            *seen, area, ExponentialPressure(law.pressure_at_zero_clearance, law.clearance_at_zero_pressure), options);
    else
        rigid_ = std::make_unique<ContactSolver>(std::move(seen), options);
    lands_ = rigid_ && !elastic_stick_.active() && options.landing == Landing::at_rest;
}

bool holds(const ContactStates& states, Eigen::Index gap)
{
    const auto m = static_cast<Eigen::Index>(states.size());
    const ContactState state = states[static_cast<std::size_t>(gap < m ? gap : gap - m)];
    return gap < m ? state != ContactState::open : state == ContactState::stick;
}

bool JointSolver::lands(const ContactStates& before, const ContactStates& now) const
{
    if (!lands_ || before == now) return false;
    for (Eigen::Index gap = 0; gap < 2 * static_cast<Eigen::Index>(now.size()); ++gap)
        if (holds(now, gap) && !holds(before, gap)) return true;
    return false;
}

bool JointSolver::shuts(const ContactStates& before, const ContactStates& now) const
{
    const auto open = [](ContactState state) { return state == ContactState::open; };
    return lands_ && std::all_of(before.begin(), before.end(), open) && !std::all_of(now.begin(), now.end(), open);
}

bool JointSolver::land(const ContactLaw& law, const VectorXd& rate, ContactSolution& jumps)
{
    const auto m = static_cast<Eigen::Index>(jumps.states.size());
    for (bool turned = true; turned;) {
        if (!hold(law, rate, jumps)) return false;
        turned = false;
        for (Eigen::Index i = 0; i < m; ++i) {
            ContactState& state = jumps.states[static_cast<std::size_t>(i)];
            const double after = rate[m + i] + jumps.displacement[m + i];
            const bool back = (state == ContactState::slip_downstream && after < 0.0) ||
                              (state == ContactState::slip_upstream && after > 0.0);
            if (back) state = ContactState::stick;
            turned = turned || back;
        }
    }
    return true;
}

bool JointSolver::hold(const ContactLaw& law, const VectorXd& values, ContactSolution& jumps)
{
    held_.setZero(values.size());
    for (Eigen::Index gap = 0; gap < values.size(); ++gap)
        if (holds(jumps.states, gap)) held_[gap] = -values[gap];
    return rigid_->land(law, held_, jumps);
}

JointSolver::JointSolver(MatrixXd stiffness, const VectorXd& area, const Contact& law, const ContactOptions& options)
    : JointSolver(std::make_shared<const MatrixXd>(std::move(stiffness)), area, law, options)
{
}

ContactReport JointSolver::solve(const VectorXd& stuck_force, const ContactLaw& law, VectorXd& elastic,
                                 ContactSolution& solution)
{
    if (slip_tolerance_) return slip_tolerance_->solve(stuck_force, law, elastic, solution);
    const VectorXd* seen = &stuck_force;
    if (elastic_stick_.active()) {
        softened_ = stuck_force;
        elastic_stick_.soften(softened_, elastic);
        seen = &softened_;
    }
    const ContactReport report =
        soft_normal_ ? soft_normal_->solve(*seen, law, solution) : rigid_->solve(*seen, law, solution);
    if (elastic_stick_.active()) elastic = elastic_stick_.give(solution.force);
    return report;
}

} // namespace damslip::fe2d
