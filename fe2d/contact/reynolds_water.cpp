#include "fe2d/contact/reynolds_water.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double atmosphere = 1e5; // [Pa]

} // namespace

ReynoldsWater::ReynoldsWater(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint)
    : CrackWater(std::move(joint)), clearance_(law.clearance), with_waves_(law.wet_end == WetEndPressure::with_waves)
{
    channel_.length = joint_->area;
    channel_.fall = joint_->fall;
    channel_.drain = joint_->drain;
    held_ = {joint_->upstream_pressure, joint_->downstream_pressure, joint_->drain ? at_rest_[*joint_->drain] : 0.0};
    scale_ = std::max({held_.first, held_.second, atmosphere});
    water_ = {at_rest_, VectorXd::Zero(joint_->pairs())};
    change_ = force_ = VectorXd::Zero(joint_->pairs());
}

void ReynoldsWater::rest_with(const PressureProfile& pressure)
{
    CrackWater::rest_with(pressure);
    if (joint_->drain) held_.drain = at_rest_[*joint_->drain];
    water_ = {at_rest_, VectorXd::Zero(joint_->pairs())};
    source_.resize(0);
}

VectorXd ReynoldsWater::width(const VectorXd& opening) const
{
    return opening.cwiseMax(0.0).array() + clearance_;
}

JointFlowStep ReynoldsWater::step() const
{
    return {channel_, joint_->fluid, water_, width(opening_), now_, source_, dt_};
}

void ReynoldsWater::begin(const JointStart& start)
{
    const Index m = joint_->pairs();
    dt_ = start.dt;
    opening_ = start.opening.segment(joint_->first, m);
    passes_ = 0;
    if (dt_ == 0.0) { // the water has time to come to rest
        force_.setZero();
        return;
    }
    now_ = held_;
    now_.first = std::max(held_.first + waves_, joint_->fluid.cavitation);
    if (source_.size() == 0) source_ = steady_source(channel_, joint_->fluid, at_rest_, width(opening_), held_);
    const JointFlowStep flow = step();
    next_ = flow.state(width(opening_));
    linearise(flow, opening_, false);
}

/// r and, where it must be, Z about the pressure `next_` of these openings.
void ReynoldsWater::linearise(const JointFlowStep& flow, const VectorXd& opening, bool anew)
{
    const std::vector<char> cavitated = flow.cavitated(next_);
    const VectorXd widths = width(opening_);
    const auto changed = [&] {
        return ((widths.array() / linear_->width.array()).cube() - 1.0).abs().maxCoeff() > rebuild_share;
    };
    if (anew || !linear_ || linear_->dt != dt_ || linear_->cavitated != cavitated || changed()) {
        Linear made{flow.stiffness(cavitated), widths, cavitated, dt_};
        made.stiffness = joint_->area.asDiagonal() * made.stiffness;
        made.stiffness = (0.5 * (made.stiffness + made.stiffness.transpose())).eval();
        linear_ = std::make_shared<const Linear>(std::move(made));
    }
    force_ = joint_->area.cwiseProduct(at_rest_ - next_.pressure) - linear_->stiffness * opening;
}

void ReynoldsWater::add(JointTerms& terms) const
{
    if (dt_ == 0.0) return;
    const Index first = joint_->first, m = joint_->pairs();
    terms.force.segment(first, m) += force_;
    terms.blocks.push_back({first, {linear_, &linear_->stiffness}});
}

JointFit ReynoldsWater::revise(const ContactSolution& solution)
{
    if (dt_ == 0.0) return JointFit::fits;
    const VectorXd opening = solution.displacement.segment(joint_->first, joint_->pairs());
    const JointFlowStep flow = step();
    next_ = flow.state(width(opening));
    const VectorXd used = at_rest_ - (force_ + linear_->stiffness * opening).cwiseQuotient(joint_->area);
    if ((used - next_.pressure).cwiseAbs().maxCoeff() <= tolerance * scale_) return JointFit::fits;
    if (++passes_ >= largest_passes) return JointFit::too_far;
    linearise(flow, opening, passes_ > 4);
    return JointFit::changed;
}

void ReynoldsWater::end(const ContactSolution& solution)
{
    const Index first = joint_->first, m = joint_->pairs();
    const VectorXd opening = solution.displacement.segment(first, m);
    const auto from = solution.states.begin() + first;
    if (dt_ == 0.0) {
        water_ = {at_rest_, VectorXd::Zero(m)};
        change_.setZero();
    } else {
        const JointFlowStep flow = step();
        const VectorXd widths = width(opening);
        const VectorXd change = -(force_ + linear_->stiffness * opening).cwiseQuotient(joint_->area);
        add_work(change_, change, opening - opening_);
        change_ = change;
        report_.flow += flow.work(next_, widths);
        report_.reynolds_number = std::max(report_.reynolds_number, flow.reynolds_number(next_));
        water_ = next_;
    }
    report_.pressure = water_.pressure;
    report_.force = joint_->area.cwiseProduct(change_);
    look(dt_, opening, ContactStates(from, from + m));
}

} // namespace damslip::fe2d
