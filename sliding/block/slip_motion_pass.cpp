#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slip_motion.hpp"

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

// Uplift that changes while the block slides: by the crack that opens, and by water that needs time to enter it.
namespace {

constexpr double wet_tolerance = 1e-8;        ///< of the base's length and of the block's weight, within a part
constexpr double shortest_wet_part = 0x1p-26; ///< of an interval: the water's way may break there
constexpr int most_wet_parts = 100000;

} // namespace

/// Water on its way: in parts that are short enough for its uplift to be linear, and end where the block's motion changes.
void SlipMotion::cross_wet(double start, double dt, const Line& a_h, const Line& a_v)
{
    double from = 0.0, length = 1.0;
    bool changed = false;
    for (int parts = 0; from < 1.0 && !unresolved_; ++parts) {
        unresolved_ = parts > most_wet_parts;
        const double to = from + length < 1.0 ? from + length : 1.0, h = (to - from) * dt;
        const Line part_h = part(a_h, from, to), part_v = part(a_v, from, to);
        const double bend = let_water_flow(h, part_h, part_v);
        if (bend > 1.0 && length > shortest_wet_part) {
            length *= 0.5;
            continue;
        }
        cross_part(start + from * dt, h, part_h, part_v, true, changed);
        changed = span_ > 0.0;
        longest_wet_ = std::max({longest_wet_, wet_down_.now, wet_up_.now});
        from = to - (to - from) * (span_ / h);
        if (bend < 0.2) length = std::min(2.0 * length, 1.0);
    }
}

const SlowWater* SlipMotion::slow_water() const
{
    const OpeningUplift* opening = stages_[stage_].block.opening.get();
    return opening ? opening->slow.get() : nullptr;
}

/// x_w of one end of the base a time dt later, where (a_h, a_v) is the ground's acceleration then.
double SlipMotion::wet_after(SlipDirection direction, double wet, double dt, double a_h, double a_v) const
{
    const SlowWater& water = *slow_water();
    if (moving_ && !airborne_ && direction_ != direction) return water.first(direction);
    const double come = std::min(wet + water.speed() * dt, water.length());
    if (airborne_) return come;
    const double sliding = water.sliding(direction, a_v, come).wet;
    return moving_ ? sliding : std::min(sliding, water.front(direction, a_h, a_v, wet, come));
}

/// Where the water will be at the end of a part. @returns how far its way and its uplift are from straight lines, 1: as far
/// as they may be
double SlipMotion::let_water_flow(double dt, const Line& a_h, const Line& a_v)
{
    const SlowWater& water = *slow_water();
    double bend = 0.0;
    for (const SlipDirection direction : {SlipDirection::downstream, SlipDirection::upstream}) {
        Line& wet = direction == SlipDirection::downstream ? wet_down_ : wet_up_;
        const double middle = wet_after(direction, wet.now, 0.5 * dt, a_h.at(0.5), a_v.at(0.5));
        const double at_once = wet_after(direction, wet.now, dt, a_h.end, a_v.end);
        wet.end = wet_after(direction, middle, 0.5 * dt, a_h.end, a_v.end);
        const auto uplift = [&](double a_v, double x) { return water.sliding(direction, a_v, x).change; };
        const double chord = 0.5 * (uplift(a_v.now, wet.now) + uplift(a_v.end, wet.end));
        const double off = std::abs(uplift(a_v.at(0.5), middle) - chord) / stage().block.mass / stage().block.gravity;
        // Water that the crack still held back now and no longer at the end: it went on at an instant between.
        const double way = water.speed() * dt;
        const bool held = wet_after(direction, wet.now, dt, a_h.now, a_v.now) < wet.now + way;
        const double late = held && wet.end >= wet.now + way * (1.0 - 1e-9) ? way : std::abs(wet.end - at_once);
        bend = std::max({bend, off / wet_tolerance, late / (wet_tolerance * water.length())});
    }
    return bend;
}

void SlipMotion::read_opening()
{
    opening_down_ = opening_up_ = {};
    const OpeningUplift* opening = stage().block.opening.get();
    if (!opening) return;
    const auto over = [&](SlipDirection direction) {
        if (const SlowWater* slow = opening->slow.get()) {
            const Line& wet = direction == SlipDirection::downstream ? wet_down_ : wet_up_;
            return Line{slow->sliding(direction, a_v_.now, wet.now).change,
                        slow->sliding(direction, a_v_.end, wet.end).change};
        }
        return Line{opening->at(direction, a_v_.now), opening->at(direction, a_v_.end)};
    };
    opening_down_ = over(SlipDirection::downstream);
    opening_up_ = over(SlipDirection::upstream);
}

Line SlipMotion::less_opening(const Line& normal, SlipDirection direction) const
{
    if (!stage().block.opening) return normal;
    return combine(1.0, normal, -1.0, direction == SlipDirection::downstream ? opening_down_ : opening_up_);
}

/// No water has come in, and none does while a_h and a_v stay within the ranges.
bool SlipMotion::water_stays(double a_h_min, double a_h_max, double a_v_min, double a_v_max) const
{
    const SlowWater& water = *slow_water();
    for (const SlipDirection direction : {SlipDirection::downstream, SlipDirection::upstream}) {
        const double first = water.first(direction);
        if ((direction == SlipDirection::downstream ? wet_down_ : wet_up_).now != first) return false;
        for (const double a_h : {a_h_min, a_h_max})
            for (const double a_v : {a_v_min, a_v_max})
                if (water.front(direction, a_h, a_v, first, water.length()) != first) return false;
    }
    return true;
}

} // namespace damslip::sliding
