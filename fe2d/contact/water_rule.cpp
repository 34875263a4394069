#include "fe2d/contact/water_rule.hpp"

#include <algorithm>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The middle part of a profile, and one pressure in the crack at either end.
/// @param wet  how far full head reaches into the cracks; nothing is in the rest of them
PressureProfile with_empty_cracks(const PressureProfile& full, double length, const CrackLengths& wet,
                                  const CrackLengths& crack)
{
    PressureProfile result;
    const auto take = [&](double from, double to) {
        if (!(to > from)) return;
        for (const ProfilePoint& point : part(full, from, to)) result.points.push_back(point);
    };
    const auto none = [&](double from, double to) {
        if (!(to > from)) return;
        result.points.push_back({from, 0.0});
        result.points.push_back({to, 0.0});
    };
    const double far_tip = std::max(crack.upstream, length - crack.downstream);
    take(0.0, wet.upstream);
    none(wet.upstream, crack.upstream);
    take(crack.upstream, far_tip);
    none(far_tip, length - wet.downstream);
    take(std::max(far_tip, length - wet.downstream), length);
    return result;
}

} // namespace

WaterRule::WaterRule(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint)
    : CrackWater(std::move(joint)), law_(law), change_(VectorXd::Zero(joint_->pairs())), next_(change_),
      target_(change_), wet_pair_(static_cast<std::size_t>(joint_->pairs()), 0)
{
}

/// Change of the pressure by the rule, with the present crack.
VectorXd WaterRule::by_rule() const
{
    const CrackLengths& crack = report_.crack;
    const CrackLengths wet_end{joint_->upstream_pressure > 0.0 ? crack.upstream : 0.0,
                               joint_->downstream_pressure > 0.0 ? crack.downstream : 0.0};
    if (wet_end.upstream == 0.0 && wet_end.downstream == 0.0) return lost_;
    CrackLengths wet = wet_end;
    switch (law_.opening) {
    case OpeningWater::zero:
        wet = {std::min(at_start_.upstream, wet_end.upstream), std::min(at_start_.downstream, wet_end.downstream)};
        break;
    case OpeningWater::mouth:
        wet = wet_;
        break;
    case OpeningWater::full:
        break;
    case OpeningWater::unchanged:
    case OpeningWater::reynolds: // ReynoldsWater's
        return lost_;
    }
    const bool full_head = law_.opening != OpeningWater::zero && (wet.upstream > 0.0 || wet.downstream > 0.0);
    const PressureProfile full = full_head ? joint_->cracked(wet.upstream, wet.downstream) : joint_->before;
    return pair_pressure(*joint_, with_empty_cracks(full, joint_->length(), wet, wet_end)) - at_rest_;
}

/// The pressure of the next step: the rule's, and what pairs behind a shut mouth keep.
void WaterRule::follow(const ContactStates& states)
{
    const Index m = joint_->pairs();
    const VectorXd before = target_;
    target_ = by_rule();
    if (law_.opening == OpeningWater::unchanged) return;
    const auto open = [&](Index i) { return states[static_cast<std::size_t>(i)] == ContactState::open; };
    Index first = 0, last = m; // pairs between the two cracks
    if (joint_->upstream_pressure > 0.0)
        while (first < m && open(first)) ++first;
    if (joint_->downstream_pressure > 0.0)
        while (last > first && open(last - 1)) --last;
    for (Index i = 0; i < m; ++i) {
        char& wet = wet_pair_[static_cast<std::size_t>(i)];
        const bool in_crack = i < first || i >= last;
        if (wet && !in_crack && open(i)) target_[i] = before[i];
        wet = open(i) && (in_crack || wet);
    }
}

void WaterRule::begin(const JointStart& start)
{
    dt_ = start.dt;
    opening_ = start.opening.segment(joint_->first, joint_->pairs());
    if (dt_ == 0.0) {
        next_.setZero();
        return;
    }
    next_ = target_;
}

void WaterRule::add(JointTerms& terms) const
{
    terms.force.segment(joint_->first, joint_->pairs()) -= joint_->area.cwiseProduct(next_);
}

void WaterRule::end(const ContactSolution& solution)
{
    const Index first = joint_->first, m = joint_->pairs();
    const VectorXd opening = solution.displacement.segment(first, m);
    if (dt_ > 0.0) add_work(change_, next_, opening - opening_);
    change_ = next_;
    report_.pressure = at_rest_ + change_;
    report_.force = joint_->area.cwiseProduct(change_);
    const auto from = solution.states.begin() + first;
    const ContactStates states(from, from + m);
    look(dt_, opening, states);
    if (dt_ == 0.0) at_start_ = report_.crack;
    // Before it shakes the water has had time to follow.
    const bool slow = law_.opening == OpeningWater::mouth && dt_ > 0.0;
    const double way = slow ? *law_.mouth_speed * dt_ : joint_->length();
    wet_.upstream = std::min(wet_.upstream + way, joint_->upstream_pressure > 0.0 ? report_.crack.upstream : 0.0);
    wet_.downstream =
        std::min(wet_.downstream + way, joint_->downstream_pressure > 0.0 ? report_.crack.downstream : 0.0);
    const bool comes_in = law_.opening == OpeningWater::full || law_.opening == OpeningWater::mouth;
    report_.wet_length = comes_in ? wet_.upstream : 0.0;
    if (dt_ > 0.0) shear_drains(dt_, solution);
    follow(states);
}

} // namespace damslip::fe2d
