#include "sliding/block/slip_motion.hpp"
#include "sliding/block/yield.hpp"

#include <algorithm>

namespace damslip::sliding {
namespace {

/// Downstream yield at a_v with lift-off: where the base would be open at the yield, the block slides without
/// resistance.
double yield_with_lift_off(const RigidBlock& block, const BaseEquations& e, double a_v)
{
    const double in_contact = yield_downstream(block).law.at(a_v);
    if (e.normal.at(in_contact, a_v) > 0.0) return in_contact;
    return -(e.drive.constant + e.drive.per_a_v * a_v) / e.drive.per_a_h;
}

} // namespace

void SlipMotion::add_sample(double time, double a_h, double a_v, SlideHistory& history) const
{
    const BaseEquations& e = forms().equations;
    RigidBlock block = stage().block;
    block.friction = friction();
    double normal_force = e.normal.at(a_h, a_v);
    if (moving_ && touching_) {
        const double accel =
            excess_drive(e, block, direction_).at(a_h, a_v) / sliding_mass(e, block.friction, direction_);
        normal_force += e.mass_tn * sign(direction_) * accel;
    }
    history.time.push_back(time);
    history.slip.push_back(slid_.downstream - slid_.upstream);
    history.slip_rate.push_back(moving_ ? sign(direction_) * rate_ : 0.0);
    history.yield.push_back(yield_with_lift_off(block, e, a_v));
    history.normal_force.push_back(touching_ && !airborne_ ? std::max(0.0, normal_force) : 0.0);
    if (options_.lift_off == LiftOff::ballistic) history.gap.push_back(gap_);
}

void SlipMotion::write(SlideResult& result) const
{
    result.slip = slid_.downstream - slid_.upstream;
    slid_.write(result, time_, moving());
    result.max_gap = max_gap_;
    result.landings = landings_;
    result.impact_loss = impact_loss_;
    result.wet_length = longest_wet_;
    if (landings_ > 0) result.last_landing_time = last_landing_;
    result.accuracy = used_series_ ? SlideAccuracy::series : SlideAccuracy::closed_form;
    for (const BlockAnchor& anchor : anchors_)
        result.anchors.push_back(
            {anchor.bar.name, anchor.history, anchor.bar.yield_force, anchor.history.stored(anchor.bar)});
}

} // namespace damslip::sliding
