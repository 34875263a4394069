#include "fe2d/contact/contact_problem.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

ContactLaw uniform_law(Index pairs, double friction, double cohesion_force)
{
    return {Eigen::VectorXd::Constant(pairs, friction), Eigen::VectorXd::Constant(pairs, cohesion_force),
            JointOpening::allowed};
}

double violation(const ContactProblem& problem, const ContactSolution& solution, Index pair)
{
    const Index m = problem.law.pairs();
    const double normal = solution.force[pair], shear = solution.force[m + pair];
    const double opening = solution.displacement[pair], slip = solution.displacement[m + pair];
    const double strength = problem.law.strength(pair, normal);
    const double slip_stiffness = problem.stiffness(m + pair, m + pair);
    const bool may_open = problem.law.separation == JointOpening::allowed;
    switch (solution.states[static_cast<std::size_t>(pair)]) {
    case ContactState::stick:
        if (normal < 0.0) return -normal;
        return std::max(0.0, std::abs(shear) - strength);
    case ContactState::slip_downstream:
        if (normal < 0.0) return -normal;
        return std::max(0.0, -slip * slip_stiffness);
    case ContactState::slip_upstream:
        if (normal < 0.0) return -normal;
        return std::max(0.0, slip * slip_stiffness);
    case ContactState::open:
        return may_open ? std::max(0.0, -opening * problem.stiffness(pair, pair)) : HUGE_VAL;
    case ContactState::pulled:
        return may_open ? HUGE_VAL : std::max(0.0, normal);
    }
    return HUGE_VAL;
}

double complementarity_residual(const ContactProblem& problem, const ContactSolution& solution)
{
    const Index m = problem.law.pairs();
    double largest = 0.0;
    for (Index i = 0; i < m; ++i) {
        const double normal = solution.force[i], shear = solution.force[m + i];
        const double opening = solution.displacement[i] * problem.stiffness(i, i);
        const double slip = solution.displacement[m + i] * problem.stiffness(m + i, m + i);
        const bool may_open = problem.law.separation == JointOpening::allowed;
        const bool parted = may_open ? opening > 0.0 : normal < 0.0; // then there is no shear, cohesion or not
        const double strength = parted ? 0.0 : problem.law.strength(i, normal);
        const double normal_residual = may_open ? std::min(normal, opening) : opening;
        // λ_t is its own projection on [-strength, strength] after a step against the slip.
        const double shear_residual = shear - std::clamp(shear - slip, -strength, strength);
        largest = std::max({largest, std::abs(normal_residual), std::abs(shear_residual)});
        if (!std::isfinite(normal_residual) || !std::isfinite(shear_residual)) return HUGE_VAL;
    }
    return largest;
}

} // namespace damslip::fe2d
