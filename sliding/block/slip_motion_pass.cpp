#include "sliding/block/slip_motion.hpp"
#include "sliding/block/yield.hpp"

#include <algorithm>
#include <cmath>

// What the block does not need to be followed for event by event: rest, permanent contact; and its results.
namespace damslip::sliding {
namespace {

AccelRange turned(const AccelRange& r, double polarity)
{
    return polarity > 0.0 ? r : AccelRange{-r.h_max, -r.h_min, r.v_min, r.v_max};
}

ContactMotion samples_of(const SkippingMotion& motion)
{
    const GroundMotion& ground = motion.motion();
    return {ground.accel_h.data(), motion.has_vertical() ? ground.accel_v.data() : nullptr, ground.dt, &motion};
}

/// Downstream yield at a_v with lift-off: where the base would be open at the yield, the block slides without
/// resistance.
double yield_with_lift_off(const RigidBlock& block, const BaseEquations& e, double a_v)
{
    const double in_contact = yield_downstream(block).law.at(a_v);
    if (e.normal.at(in_contact, a_v) > 0.0) return in_contact;
    return -(e.drive.constant + e.drive.per_a_v * a_v) / e.drive.per_a_h;
}

} // namespace

bool SlipMotion::stays_at_rest(double a_h_min, double a_h_max, double a_v_min, double a_v_max) const
{
    if (!at_rest() || moving_ || !touching_) return false;
    const BaseEquations& e = forms().equations;
    const RigidBlock& block = stage().block;
    const double mu = friction();
    if (lags(stage().rate) && stage().rate.relaxation_time && ratio_ != 1.0) return false;
    // Upper bound of a linear form over the box, with a margin for round-off so that a skipped sample is one that
    // plainly does not slide.
    const auto upper = [&](double constant, double per_a_h, double per_a_v) {
        const double h = std::max(per_a_h * a_h_min, per_a_h * a_h_max);
        const double v = std::max(per_a_v * a_v_min, per_a_v * a_v_max);
        return constant + h + v + 1e-13 * (std::abs(constant) + std::abs(h) + std::abs(v));
    };
    if (slow_water() && !water_stays(a_h_min, a_h_max, a_v_min, a_v_max)) return false;
    if (upper(-e.normal.constant, -e.normal.per_a_h, -e.normal.per_a_v) >= 0.0) return false;
    const auto slides = [&](SlipDirection direction) {
        const double d = sign(direction),
                     change = block.opening ? block.opening->largest(direction, a_v_min, a_v_max) : 0.0;
        const double c = block.cohesion_force + block.dowel_force - mu * change;
        return upper(d * e.drive.constant - c - mu * e.normal.constant, d * e.drive.per_a_h - mu * e.normal.per_a_h,
                     d * e.drive.per_a_v - mu * e.normal.per_a_v) >= 0.0;
    };
    return !slides(SlipDirection::downstream) && !(options_.two_way && slides(SlipDirection::upstream));
}

/// N' at rest and N' of the block sliding without resistance are surely positive. @param whole  range of the whole motion
bool SlipMotion::stays_in_contact(const AccelRange& range, const AccelRange& whole) const
{
    const auto positive = [&](const GroundLinear& form) {
        const GroundLinear minus{-form.constant, -form.per_a_h, -form.per_a_v};
        return -upper(minus, range) - 1e-13 * magnitude(form, whole) > 0.0;
    };
    return positive(forms().equations.normal) && positive(forms().free_normal);
}

/// End of the intervals from k on in which contact is surely kept.
std::size_t SlipMotion::contact_until(const SkippingMotion& motion, double polarity, std::size_t k,
                                      std::size_t last) const
{
    const AccelRange whole = turned(motion.whole(), polarity);
    if (stays_in_contact(whole, whole)) return last;
    while (k < last && stays_in_contact(turned(motion.block_range(k / SkippingMotion::block), polarity), whole))
        k = (k / SkippingMotion::block + 1) * SkippingMotion::block;
    return std::min(k, last);
}

/// @param polarity  1 or -1: ContactBlock has it in its forms
ContactBlock SlipMotion::contact_block(const SkippingMotion& motion, double polarity) const
{
    const StageForms& f = forms();
    const AccelRange& whole = motion.whole();
    const auto turned = [polarity](const GroundLinear& form) {
        return GroundLinear{form.constant, polarity * form.per_a_h, form.per_a_v};
    };
    ContactBlock b;
    b.drive = turned(f.equations.drive);
    b.down = {turned(f.excess_downstream), f.mass_downstream, turned(f.equations.normal), f.friction, f.bond};
    b.up = {turned(f.excess_upstream), f.mass_upstream, turned(f.equations.normal), f.friction, f.bond};
    b.plainly_below = -1e-13 * (magnitude(f.equations.drive, whole) +
                                f.friction * magnitude(f.equations.normal, whole) + std::abs(f.bond));
    // A block that the motion nowhere drives upstream does not slide that way, whatever it may do.
    b.two_way = options_.two_way && !(upper(b.up.excess, whole) < b.plainly_below);
    b.path_limit = next_stage_path() * (1.0 - 1e-9); // the step into the next stage is left to cross()
    b.time = time_;
    b.moving = moving_;
    b.from_rest = from_rest_;
    b.direction = direction_;
    b.rate = rate_;
    b.path = path_;
    b.slid = slid_;
    b.changes = changes_;
    return b;
}

void SlipMotion::take(const ContactBlock& b)
{
    time_ = b.time;
    moving_ = b.moving;
    from_rest_ = b.from_rest;
    direction_ = b.direction;
    rate_ = b.rate;
    path_ = b.path;
    slid_ = b.slid;
    changes_ = b.changes;
    unresolved_ = b.unresolved;
}

std::size_t SlipMotion::pass(const SkippingMotion& motion, double polarity, std::size_t k, std::size_t last,
                             std::size_t before)
{
    if (!touching_ || airborne_ || !plain_[stage_]) return k;
    const std::size_t end = contact_until(motion, polarity, k, last);
    if (end == k) return k;
    ContactBlock block = contact_block(motion, polarity);
    k = run_in_contact(block, samples_of(motion), k, end, before);
    take(block);
    return k;
}

bool SlipMotion::pass_together(const SkippingMotion& motion, double polarity,
                               const std::array<SlipMotion*, batch_size>& blocks)
{
    if (!has_batched_runs()) return false;
    std::array<ContactBlock, batch_size> batch;
    const std::size_t intervals = motion.intervals();
    for (std::size_t i = 0; i < batch_size; ++i) {
        const SlipMotion& b = *blocks[i];
        if (!b.touching_ || b.moving_ || b.airborne_ || !b.plain_[b.stage_] || b.next_stage_path() != never ||
            b.contact_until(motion, polarity, 0, intervals) != intervals)
            return false;
        batch[i] = b.contact_block(motion, polarity);
    }
    if (!run_in_contact(batch, samples_of(motion), intervals)) return false;
    const AccelRange r = turned(motion.whole(), polarity);
    for (std::size_t i = 0; i < batch_size; ++i) // a block that is at rest all along has no time, either
        if (!blocks[i]->stays_at_rest(r.h_min, r.h_max, r.v_min, r.v_max)) blocks[i]->take(batch[i]);
    return true;
}

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
