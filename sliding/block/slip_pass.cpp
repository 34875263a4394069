#include "sliding/block/pressed_lanes.hpp"
#include "sliding/block/pressed_slip.hpp"
#include "sliding/block/roots.hpp"
#include "sliding/block/slip_motion.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {
namespace {

/// Ground acceleration at the samples of a motion.
struct Samples {
    const double* h;
    const double* v; ///< null: none
    double polarity;

    double horizontal(std::size_t k) const { return polarity * h[k]; }
    double vertical(std::size_t k) const { return v ? v[k] : 0.0; }
    double of(const GroundLinear& form, std::size_t k) const { return form.at(horizontal(k), vertical(k)); }
};

/// Independent of the ground's motion.
bool is_constant(const GroundLinear& form, const Samples& ground)
{
    return form.per_a_h == 0.0 && (!ground.v || form.per_a_v == 0.0);
}

/// Open range of samples a_h below which a block plainly rests, whatever round-off says.
struct RestRange {
    double low = -never, high = never; ///< [m/s^2]
};

/// @param drive  per_a_h > 0  @param resistance  [N/m]
RestRange rest_range(const GroundLinear& drive, double resistance, bool two_way)
{
    const double margin = 1e-13 * (std::abs(resistance) + std::abs(drive.constant)) / drive.per_a_h;
    return {two_way ? (-resistance - drive.constant) / drive.per_a_h + margin : -never,
            (resistance - drive.constant) / drive.per_a_h - margin};
}

Samples samples_of(const GroundMotion& motion, double polarity)
{
    return {motion.accel_h.data(), motion.accel_v.empty() ? nullptr : motion.accel_v.data(), polarity};
}

} // namespace

std::size_t SlipMotion::pass(const GroundMotion& motion, double polarity, std::size_t k, std::size_t last,
                             std::size_t before, const SkippingMotion* blocks)
{
    if (!touching_ || airborne_ || !plain_[stage_]) return k;
    if (blocks && next_stage_path() == never) {
        const std::size_t passed = blocks->has_vertical() ? pass_pressed<true>(*blocks, polarity, k, last, before)
                                                          : pass_pressed<false>(*blocks, polarity, k, last, before);
        if (passed > k) return passed;
    }
    const std::size_t next =
        moving_ ? pass_sliding(motion, polarity, k, last) : pass_resting(motion, polarity, k, last, blocks);
    if (next > k) time_ = static_cast<double>(before + (next - k) - 1) * motion.dt + motion.dt;
    return next;
}

/// @returns k where the motion might lift the block
template <bool vertical>
std::size_t SlipMotion::pass_pressed(const SkippingMotion& motion, double polarity, std::size_t k, std::size_t last,
                                     std::size_t before)
{
    PressedSlip<vertical> slip(*this, motion, polarity);
    if (!slip.stays_pressed(forms().free_normal, polarity)) return k;
    const std::size_t next = slip.run(k, last, before);
    slip.write(*this);
    return next;
}

bool SlipMotion::may_go_together() const
{
    return touching_ && !moving_ && !airborne_ && plain_[stage_] && next_stage_path() == never;
}

bool SlipMotion::pass_together(const SkippingMotion& motion, double polarity, const std::array<SlipMotion*, 4>& blocks)
{
    if (!has_pressed_lanes()) return false;
    const auto of = [&](std::size_t i) { return PressedSlip<false>(*blocks[i], motion, polarity); };
    FourPressed slips{of(0), of(1), of(2), of(3)};
    for (std::size_t i = 0; i < slips.size(); ++i)
        if (!blocks[i]->may_go_together() || slips[i].two_way() ||
            !slips[i].stays_pressed(blocks[i]->forms().free_normal, polarity))
            return false;
    if (!run_in_lanes(motion, slips)) return false;
    const AccelRange& r = motion.whole();
    const double low = polarity > 0.0 ? r.h_min : -r.h_max, high = polarity > 0.0 ? r.h_max : -r.h_min;
    for (std::size_t i = 0; i < slips.size(); ++i)
        if (!blocks[i]->stays_at_rest(low, high, 0.0, 0.0)) slips[i].write(*blocks[i]); // else it has no time, either
    return true;
}

/// What is linear between two samples and below zero at both is so all along.
std::size_t SlipMotion::pass_resting(const GroundMotion& motion, double polarity, std::size_t k, std::size_t last,
                                     const SkippingMotion* blocks) const
{
    const StageForms& f = forms();
    const Samples ground = samples_of(motion, polarity);
    if (!ground.v && is_constant(f.equations.normal, ground) && is_constant(f.free_normal, ground) &&
        f.equations.drive.per_a_h > 0.0) {
        if (!(f.equations.normal.constant > 0.0 && f.free_normal.constant > 0.0)) return k;
        RestRange range =
            rest_range(f.equations.drive, f.friction * f.equations.normal.constant + f.bond, options_.two_way);
        if (polarity < 0.0) range = {-range.high, -range.low};
        const auto plainly_rests = [&](std::size_t i) { return range.low < ground.h[i] && ground.h[i] < range.high; };
        const auto all_rest = [&](const AccelRange& r) { return range.low < r.h_min && r.h_max < range.high; };
        if (!plainly_rests(k)) return k;
        while (k < last) {
            if (blocks && k % SkippingMotion::block == 0) {
                k = std::min(blocks->skip(k, all_rest), last);
                if (k == last) break;
            }
            if (!plainly_rests(k + 1)) break;
            ++k;
        }
        return k;
    }
    const auto rests = [&](std::size_t i) {
        const double drive = ground.of(f.equations.drive, i), normal = ground.of(f.equations.normal, i);
        const double resistance = f.friction * normal + f.bond;
        return normal > 0.0 && ground.of(f.free_normal, i) > 0.0 && drive - resistance <= 0.0 &&
               (!options_.two_way || -drive - resistance <= 0.0);
    };
    if (!rests(k)) return k;
    while (k < last && rests(k + 1)) ++k;
    return k;
}

std::size_t SlipMotion::pass_sliding(const GroundMotion& motion, double polarity, std::size_t k, std::size_t last)
{
    if (from_rest_) return k;
    const StageForms& f = forms();
    const Samples ground = samples_of(motion, polarity);
    const bool downstream = direction_ == SlipDirection::downstream;
    const GroundLinear& excess = downstream ? f.excess_downstream : f.excess_upstream;
    const double mass = downstream ? f.mass_downstream : f.mass_upstream, dt = motion.dt;
    const bool steady = is_constant(f.equations.normal, ground) && is_constant(f.free_normal, ground);
    if (steady && !(f.equations.normal.constant > 0.0 && f.free_normal.constant > 0.0)) return k;
    const auto pressed = [&](std::size_t i) {
        return steady || (ground.of(f.equations.normal, i) > 0.0 && ground.of(f.free_normal, i) > 0.0);
    };
    if (!pressed(k)) return k;
    span_ = dt;
    const bool one_stage = next_stage_path() == never;
    double& along = downstream ? slid_.downstream : slid_.upstream;
    const double against = downstream ? slid_.upstream : slid_.downstream;
    double rate = rate_, path = path_, slid = along, largest = slid_.largest, peak_rate = slid_.peak_rate;
    Line accel;
    accel.end = ground.of(excess, k) / mass;
    for (; k < last && pressed(k + 1); ++k) {
        accel = {accel.end, ground.of(excess, k + 1) / mass};
        const auto jerk = [&] { return (accel.end - accel.now) / dt; };
        // Not even with its lowest acceleration all along does the rate come near zero; else it is looked at closely.
        const bool goes_on = rate + dt * std::min(accel.now, accel.end) > 1e-6 * rate;
        const bool rises = accel.now > 0.0 && accel.end > 0.0;
        if (!goes_on && !rises && !(time_of_stop(rate, accel.now, jerk()) > dt)) break;
        if (!one_stage) {
            rate_ = rate;
            path_ = path;
            if (time_of_stage(dt, accel) != never) break;
        }
        if (accel.now > 0.0 && accel.end < 0.0)
            peak_rate = std::max(peak_rate, rate - accel.now * accel.now / (2.0 * jerk()));
        const double way = std::max(dt * (rate + dt * (2.0 * accel.now + accel.end) / 6.0), 0.0);
        path += way;
        slid += way;
        largest = std::max(largest, std::abs(slid - against));
        rate = std::max(0.0, rate + 0.5 * dt * (accel.now + accel.end));
        peak_rate = std::max(peak_rate, rate);
    }
    rate_ = rate;
    path_ = path;
    along = slid;
    slid_.largest = largest;
    slid_.peak_rate = peak_rate;
    span_ = 0.0;
    return k;
}

} // namespace damslip::sliding
