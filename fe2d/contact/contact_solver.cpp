#include "fe2d/contact/contact_solver.hpp"

#include "fe2d/contact/contact_problem.hpp"
#include "fe2d/contact/joint_law.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

/// FNV-1a; equal states give equal numbers on every machine.
std::uint64_t fingerprint(const ContactStates& states)
{
    std::uint64_t hash = 14695981039346656037ULL;
    for (const ContactState state : states) hash = (hash ^ static_cast<std::uint64_t>(state)) * 1099511628211ULL;
    return hash;
}

/// Takes the cohesion of open pairs that carry shear. @returns whether there was one
bool break_open_pairs(const ContactSolution& solution, double tolerance, ContactLaw& law)
{
    bool any = false;
    const Index m = law.pairs();
    for (Index i = 0; i < m; ++i)
        if (solution.states[static_cast<std::size_t>(i)] == ContactState::open && law.cohesion[i] > 0.0 &&
            std::abs(solution.force[m + i]) > tolerance) {
            law.cohesion[i] = 0.0;
            any = true;
        }
    return any;
}

} // namespace

bool ContactSolver::Visited::seen_before(const ContactStates& states)
{
    const std::uint64_t mark = fingerprint(states);
    if (std::find(marks_.begin(), marks_.end(), mark) != marks_.end()) return true;
    marks_.push_back(mark);
    return false;
}

ContactState next_state(const ContactProblem& problem, const ContactSolution& solution, Index pair, double tolerance)
{
    const ContactState now = solution.states[static_cast<std::size_t>(pair)];
    if (!(violation(problem, solution, pair) > tolerance)) return now;
    const Index m = problem.law.pairs();
    const double normal = solution.force[pair], shear = solution.force[m + pair];
    const double opening = solution.displacement[pair], slip = solution.displacement[m + pair];
    const double friction = problem.law.friction[pair];
    const auto slipping = [](bool downstream) {
        return downstream ? ContactState::slip_downstream : ContactState::slip_upstream;
    };
    // A pair that shuts does so where the trial force of a penalty lies: outside the friction cone it goes on
    // slipping. Shutting it stuck instead makes it jump open again and the iteration cycle.
    if (now == ContactState::open)
        return std::abs(slip) > -friction * opening ? slipping(slip > 0.0) : ContactState::stick;
    if (now == ContactState::pulled)
        return std::abs(slip) * problem.stiffness(m + pair, m + pair) > friction * normal ? slipping(slip > 0.0)
                                                                                          : ContactState::stick;
    if (normal < 0.0)
        return problem.law.separation == JointOpening::allowed ? ContactState::open : ContactState::pulled;
    if (is_slip(now)) return ContactState::stick; // it would slip against the direction of its friction
    return slipping(shear < 0.0);
}

ContactSolver::ContactSolver(std::shared_ptr<const Eigen::MatrixXd> stiffness, ContactOptions options)
    : stiffness_(std::move(stiffness)), options_(options), system_(*stiffness_)
{
    visited_.reserve(static_cast<std::size_t>(options.newton_iterations));
}

ContactSolver::ContactSolver(Eigen::MatrixXd stiffness, ContactOptions options)
    : ContactSolver(std::make_shared<const Eigen::MatrixXd>(std::move(stiffness)), options)
{
}

bool ContactSolver::evaluate(const ContactProblem& problem, ContactSolution& solution, ContactReport& report)
{
    ++report.iterations;
    if (system_.set(solution.states, problem.law) && system_.solve(problem.law, problem.stuck_force, solution))
        return true;
    report.mechanism = true;
    return false;
}

bool ContactSolver::newton(const ContactProblem& problem, ContactSolution& solution, ContactReport& report,
                           double tolerance)
{
    const Index m = problem.law.pairs();
    visited_.clear();
    next_ = solution.states;
    for (int k = 0; k < options_.newton_iterations; ++k) {
        if (visited_.seen_before(solution.states) || !evaluate(problem, solution, report)) return false;
        for (Index i = 0; i < m; ++i) next_[static_cast<std::size_t>(i)] = next_state(problem, solution, i, tolerance);
        if (next_ == solution.states) return true;
        solution.states = next_;
    }
    return false;
}

bool ContactSolver::one_by_one(const ContactProblem& problem, ContactSolution& solution, ContactReport& report,
                               double tolerance, std::vector<Index>* opened)
{
    const Index m = problem.law.pairs();
    visited_.clear();
    for (int k = 0; k < options_.switches_per_pair * static_cast<int>(m); ++k) {
        if (visited_.seen_before(solution.states) || !evaluate(problem, solution, report)) return false;
        Index worst = -1;
        double largest = tolerance;
        for (Index i = 0; i < m; ++i) {
            const double size = violation(problem, solution, i);
            if (size <= largest) continue;
            largest = size;
            worst = i;
        }
        if (worst < 0) return true;
        ContactState& state = solution.states[static_cast<std::size_t>(worst)];
        state = next_state(problem, solution, worst, tolerance);
        if (opened && state == ContactState::open) opened->push_back(worst);
    }
    return false;
}

ContactReport ContactSolver::solve(const Eigen::VectorXd& stuck_force, const ContactLaw& law, ContactSolution& solution,
                                   bool definite)
{
    const Index m = law.pairs();
    assert(stiffness_->rows() == 2 * m && stuck_force.size() == 2 * m);
    const ContactProblem problem{*stiffness_, stuck_force, law};
    const double scale = stuck_force.cwiseAbs().maxCoeff(), tolerance = options_.tolerance * scale;
    const auto set_stuck = [&] { solution.states.assign(static_cast<std::size_t>(m), ContactState::stick); };
    if (static_cast<Index>(solution.states.size()) != m) set_stuck();

    ContactReport report;
    const auto finish = [&](ContactPath path) {
        report.path = path;
        report.residual = scale > 0.0 ? complementarity_residual(problem, solution) / scale : 0.0;
        return report;
    };
    start_ = solution.states;
    if (newton(problem, solution, report, tolerance)) return finish(ContactPath::newton);
    solution.states = start_;
    if (report.mechanism) set_stuck();
    if (!definite || options_.gauss_seidel_sweeps == 0) return finish(ContactPath::unresolved);
    if (one_by_one(problem, solution, report, tolerance)) return finish(ContactPath::worst_violator);

    set_stuck();
    solution.displacement.setZero(2 * m);
    for (int restart = 0; restart < 4; ++restart) {
        gauss_seidel(problem, solution, options_.gauss_seidel_sweeps << restart, tolerance);
        ContactSolution trial = solution;
        if (newton(problem, trial, report, tolerance) ||
            (trial = solution, one_by_one(problem, trial, report, tolerance))) {
            solution = std::move(trial);
            return finish(ContactPath::gauss_seidel);
        }
    }
    // Cohesion that an open pair has not makes the law jump, and there need not be a solution: shut, the cohesion pulls the
    // pair open; open, it shuts. To Lemke's method strength is c + mu λ_n of open pairs too. A pair that it leaves open
    // under shear has broken in this step: without its cohesion the problem is solved again.
    ContactLaw left = law;
    const ContactProblem broken{*stiffness_, stuck_force, left};
    for (Index k = 0; k <= m && law.separation == JointOpening::allowed; ++k) { // one pair more each time at least
        int pivots = 0;
        ContactSolution last = solution;
        if (!solve_by_lemke(broken, last, pivots)) break;
        ContactSolution polished = last;
        const bool settled = newton(broken, polished, report, tolerance);
        if (!settled && break_open_pairs(last, tolerance, left)) continue;
        solution = settled ? polished : last;
        report.residual = complementarity_residual(broken, solution) / scale;
        report.path = report.residual <= largest_residual ? ContactPath::lemke : ContactPath::unresolved;
        return report;
    }
    if (break_one_by_one(problem, solution, report, tolerance)) return report;
    return finish(ContactPath::unresolved);
}

/// The same where V is singular, as in statics: the search for states goes round because some pair with cohesion is pulled open
/// by it when shut and shuts without it. Each time round such a pair has broken; without its cohesion the search goes on.
bool ContactSolver::break_one_by_one(const ContactProblem& problem, ContactSolution& solution, ContactReport& report,
                                     double tolerance)
{
    const Index m = problem.law.pairs();
    if (problem.law.separation != JointOpening::allowed || !(problem.law.cohesion.maxCoeff() > 0.0)) return false;
    ContactLaw left = problem.law;
    const ContactProblem broken{problem.stiffness, problem.stuck_force, left};
    const ContactStates stuck(static_cast<std::size_t>(m), ContactState::stick);
    for (Index round = 0; round <= m; ++round) {
        solution.states = stuck;
        std::vector<Index> opened;
        if (newton(broken, solution, report, tolerance) ||
            (solution.states = stuck, one_by_one(broken, solution, report, tolerance, &opened))) {
            report.residual = complementarity_residual(broken, solution) / problem.stuck_force.cwiseAbs().maxCoeff();
            report.path = ContactPath::worst_violator;
            return report.residual <= largest_residual;
        }
        Index breaks = -1; // the last that opened with cohesion
        for (const Index pair : opened)
            if (left.cohesion[pair] > 0.0) breaks = pair;
        if (breaks < 0) return false;
        left.cohesion[breaks] = 0.0;
    }
    return false;
}

bool ContactSolver::land(const ContactLaw& law, const Eigen::VectorXd& held_jump, ContactSolution& solution)
{
    impulsive_ = law;
    impulsive_.cohesion.setZero(); // a force, no impulse
    set_product(*stiffness_, held_jump, held_impulse_);
    if (!system_.set(solution.states, impulsive_) || !system_.solve(impulsive_, held_impulse_, solution)) return false;
    solution.displacement += held_jump;
    return true;
}

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int slip_newton_steps = 30;
constexpr int slip_renewals = 60;
constexpr double residual_tolerance = 1e-10; ///< of the residual, relative to the largest stuck force
constexpr double edge = 1e-10;               ///< of |e| against γ_e: states do not change within it
constexpr double least_strength = 1e-6;      ///< of a pair whose stiffness is held, relative to the largest one
constexpr double renewal_change = 1e-12;     ///< of the strengths, relative to the largest: they repeat themselves

bool is_closed(ContactState state)
{
    return state == ContactState::stick || is_slip(state);
}

} // namespace

SlipTolerance::SlipTolerance(const MatrixXd& stiffness, VectorXd elastic_slip, const ContactOptions& options)
    : stiffness_(stiffness), limit_(std::move(elastic_slip)), options_(options)
{
    assert(limit_.minCoeff() > 0.0);
}

/// Rows λ_t + κ λ_n + d y = r of the tangential unknowns, linearised about the iterate; λ_n = 0 of open pairs.
bool SlipTolerance::linear_solution(const Step& step, Iterate& it) const
{
    const Index m = step.law.pairs();
    std::vector<Index> unknowns;
    for (Index i = 0; i < m; ++i)
        if (it.states[static_cast<std::size_t>(i)] == ContactState::open) unknowns.push_back(i);
    const auto open = static_cast<Index>(unknowns.size()), size = open + m;
    for (Index i = 0; i < m; ++i) unknowns.push_back(m + i);
    MatrixXd matrix = stiffness_(unknowns, unknowns);
    VectorXd right = -step.stuck_force(unknowns);
    for (Index i = 0; i < m; ++i) {
        const ContactState state = it.states[static_cast<std::size_t>(i)];
        if (!is_closed(state)) continue;
        const double friction = step.law.friction[i], normal = it.force[i], strength = step.law.strength(i, normal);
        const double elastic = std::clamp(step.elastic[i] + it.displacement[m + i], -limit_[i], limit_[i]);
        double coupling = 0.0;
        if (state == ContactState::stick) {
            coupling = normal > 0.0 ? friction * elastic / limit_[i] : 0.0;
            matrix(open + i, open + i) += strength / limit_[i];
            right[open + i] += coupling * normal - strength * step.elastic[i] / limit_[i];
        } else {
            const double direction = state == ContactState::slip_downstream ? 1.0 : -1.0;
            coupling = direction * friction;
            right[open + i] -= direction * step.law.cohesion[i];
        }
        for (Index k = 0; k < size; ++k) matrix(open + i, k) += coupling * stiffness_(unknowns[k], i);
        right[open + i] -= coupling * step.stuck_force[i];
    }
    const Eigen::PartialPivLU<MatrixXd> lu(matrix);
    const VectorXd pivots = lu.matrixLU().diagonal().cwiseAbs();
    if (!(pivots.minCoeff() > 1e-13 * pivots.maxCoeff())) return false;
    const VectorXd x = lu.solve(right);
    it.displacement.setZero(2 * m);
    it.displacement(unknowns) = x;
    it.force = step.stuck_force;
    it.force.noalias() += stiffness_.rightCols(m) * x.tail(m);
    for (Index k = 0; k < open; ++k) it.force += x[k] * stiffness_.col(unknowns[static_cast<std::size_t>(k)]);
    return true;
}

ContactState SlipTolerance::next(const Step& step, const Iterate& it, Index pair) const
{
    const ContactState now = it.states[static_cast<std::size_t>(pair)];
    const double normal = it.force[pair];
    const bool may_open = step.law.separation == JointOpening::allowed;
    if (now == ContactState::open && it.displacement[pair] * stiffness_(pair, pair) >= -step.tolerance) return now;
    if (now == ContactState::pulled && normal <= step.tolerance) return now;
    if (is_closed(now) && normal < -step.tolerance) return may_open ? ContactState::open : ContactState::pulled;
    const double share = (step.elastic[pair] + it.displacement[step.law.pairs() + pair]) / limit_[pair];
    const double limit = is_slip(now) ? 1.0 - edge : 1.0 + edge;
    if (std::abs(share) <= limit) return ContactState::stick;
    return share > 0.0 ? ContactState::slip_downstream : ContactState::slip_upstream;
}

double SlipTolerance::residual(const Step& step, const Iterate& it) const
{
    const Index m = step.law.pairs();
    double largest = 0.0;
    for (Index i = 0; i < m; ++i) {
        const double normal = it.force[i], opening = it.displacement[i] * stiffness_(i, i);
        const double normal_residual =
            step.law.separation == JointOpening::allowed ? std::min(normal, opening) : opening;
        const bool closed = is_closed(it.states[static_cast<std::size_t>(i)]);
        const double share = std::clamp((step.elastic[i] + it.displacement[m + i]) / limit_[i], -1.0, 1.0);
        const double shear_residual = it.force[m + i] + (closed ? share * step.law.strength(i, normal) : 0.0);
        if (!std::isfinite(normal_residual) || !std::isfinite(shear_residual)) return HUGE_VAL;
        largest = std::max({largest, std::abs(normal_residual), std::abs(shear_residual)});
    }
    return largest;
}

bool SlipTolerance::newton(const Step& step, Iterate& it, ContactReport& report) const
{
    const Index m = step.law.pairs();
    ContactStates next_states(it.states);
    for (int k = 0; k < slip_newton_steps; ++k) {
        ++report.iterations;
        if (!linear_solution(step, it)) {
            report.mechanism = true;
            return false;
        }
        for (Index i = 0; i < m; ++i) next_states[static_cast<std::size_t>(i)] = next(step, it, i);
        if (next_states == it.states && residual(step, it) <= step.tolerance) return true;
        it.states = next_states;
    }
    return false;
}

/// Stiffnesses held, solved exactly, renewed.
bool SlipTolerance::renewed_stiffness(const Step& step, Iterate& it, ContactReport& report) const
{
    const Index m = step.law.pairs();
    VectorXd strength(m), last(m);
    const auto renew = [&] {
        for (Index i = 0; i < m; ++i) strength[i] = step.law.strength(i, it.force[i]);
        const double largest = strength.maxCoeff();
        strength = strength.cwiseMax(least_strength * largest);
        return largest > 0.0;
    };
    for (int k = 0; k < slip_renewals && renew(); ++k) {
        if (k > 0 && (strength - last).cwiseAbs().maxCoeff() <= renewal_change * strength.maxCoeff()) return true;
        if (k > 10) strength = (0.5 * (strength + last)).eval(); // damped where two sets of pairs take turns
        last = strength;
        MatrixXd softened = stiffness_;
        const ElasticStick soft(softened, limit_.cwiseQuotient(strength));
        VectorXd stuck = step.stuck_force;
        soft.soften(stuck, step.elastic);
        ContactSolver solver(std::move(softened), options_);
        ContactSolution solution{it.states, {}, {}};
        const ContactReport inner = solver.solve(stuck, step.law, solution);
        report.iterations += inner.iterations;
        if (!inner.resolved()) return false;
        it = solution;
        it.displacement.tail(m) += soft.give(solution.force) - step.elastic;
    }
    return false;
}

ContactReport SlipTolerance::solve(const VectorXd& stuck_force, const ContactLaw& law, VectorXd& elastic,
                                   ContactSolution& solution)
{
    const Index m = law.pairs();
    const double scale = stuck_force.cwiseAbs().maxCoeff();
    const VectorXd elastic_start = elastic;
    const Step step{stuck_force, law, elastic_start, residual_tolerance * scale};
    Iterate start = solution;
    if (start.states.size() != static_cast<std::size_t>(m))
        start.states.assign(static_cast<std::size_t>(m), ContactState::stick);
    if (start.force.size() != 2 * m || start.force.isZero(0.0)) start.force = stuck_force;
    start.displacement.setZero(2 * m);

    ContactReport report;
    Iterate it = start;
    bool done = newton(step, it, report);
    if (!done) {
        it = start;
        const bool settled = renewed_stiffness(step, it, report);
        Iterate polished = it;
        done = newton(step, polished, report);
        if (done) it = polished;
        report.path = done || settled ? ContactPath::gauss_seidel : ContactPath::unresolved;
    }
    report.residual = scale > 0.0 ? residual(step, it) / scale : 0.0;
    if (report.residual > largest_residual) report.path = ContactPath::unresolved;

    for (Index i = 0; i < m; ++i) {
        const ContactState state = it.states[static_cast<std::size_t>(i)];
        elastic[i] = state == ContactState::stick             ? elastic_start[i] + it.displacement[m + i]
                     : state == ContactState::slip_downstream ? limit_[i]
                     : state == ContactState::slip_upstream   ? -limit_[i]
                                                              : 0.0;
        it.displacement[m + i] =
            state == ContactState::stick ? 0.0 : it.displacement[m + i] - (elastic[i] - elastic_start[i]);
    }
    solution = std::move(it);
    return report;
}

} // namespace damslip::fe2d
