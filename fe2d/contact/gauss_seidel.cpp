#include "fe2d/contact/gauss_seidel.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

/// One pair with everything else held: forces q at x = 0, stiffness [[nn, nt], [nt, tt]].
struct Pair {
    double q_n, q_t, nn, nt, tt, friction, cohesion;
};

struct PairResult {
    ContactState state;
    double opening, slip;
};

bool slips(const Pair& p, double direction, PairResult& result)
{
    // λ_t + direction (c + mu λ_n) = 0
    const double stiffness = p.tt + direction * p.friction * p.nt;
    if (!(stiffness > 0.0)) return false;
    const double slip = -(p.q_t + direction * (p.cohesion + p.friction * p.q_n)) / stiffness;
    if (slip * direction < 0.0 || p.q_n + p.nt * slip < 0.0) return false;
    result = {direction > 0.0 ? ContactState::slip_downstream : ContactState::slip_upstream, 0.0, slip};
    return true;
}

PairResult solve_pair(const Pair& p, JointOpening separation)
{
    const bool in_tension = p.q_n < 0.0;
    const double strength = p.cohesion + p.friction * std::max(0.0, p.q_n);
    if (!in_tension && std::abs(p.q_t) <= strength) return {ContactState::stick, 0.0, 0.0};
    PairResult result{};
    if (slips(p, p.q_t < 0.0 ? 1.0 : -1.0, result) || slips(p, p.q_t < 0.0 ? -1.0 : 1.0, result)) return result;
    if (separation == JointOpening::none) return {ContactState::pulled, 0.0, -p.q_t / p.tt};
    const double determinant = p.nn * p.tt - p.nt * p.nt;
    return {ContactState::open, (p.nt * p.q_t - p.tt * p.q_n) / determinant,
            (p.nt * p.q_n - p.nn * p.q_t) / determinant};
}

} // namespace

int gauss_seidel(const ContactProblem& problem, ContactSolution& solution, int sweeps, double tolerance)
{
    const Eigen::MatrixXd& v = problem.stiffness;
    const Index m = problem.law.pairs();
    auto& x = solution.displacement;
    solution.force = problem.stuck_force + v * x;
    for (int sweep = 1; sweep <= sweeps; ++sweep) {
        double largest_change = 0.0;
        for (Index i = 0; i < m; ++i) {
            const Index t = m + i;
            const Pair pair{solution.force[i] - v(i, i) * x[i] - v(i, t) * x[t],
                            solution.force[t] - v(t, i) * x[i] - v(t, t) * x[t],
                            v(i, i),
                            v(i, t),
                            v(t, t),
                            problem.law.friction[i],
                            problem.law.cohesion[i]};
            const PairResult result = solve_pair(pair, problem.law.separation);
            const double opening_step = result.opening - x[i], slip_step = result.slip - x[t];
            ContactState& state = solution.states[static_cast<std::size_t>(i)];
            largest_change = std::max({largest_change, std::abs(opening_step * v(i, i)), std::abs(slip_step * v(t, t)),
                                       state == result.state ? 0.0 : HUGE_VAL});
            state = result.state;
            x[i] = result.opening;
            x[t] = result.slip;
            if (opening_step != 0.0) solution.force += opening_step * v.col(i);
            if (slip_step != 0.0) solution.force += slip_step * v.col(t);
        }
        if (largest_change <= tolerance) return sweep;
    }
    return sweeps;
}

} // namespace damslip::fe2d
