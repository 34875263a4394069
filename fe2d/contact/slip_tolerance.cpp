#include "fe2d/contact/slip_tolerance.hpp"

#include "fe2d/contact/elastic_stick.hpp"
#include "fe2d/solver/dense_algebra.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
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
