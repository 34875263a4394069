#include "fe2d/contact/joint_solver.hpp"

#include <algorithm>
#include <cassert>

namespace damslip::fe2d {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
