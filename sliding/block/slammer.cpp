#include "sliding/block/slide.hpp"

#include "sliding/block/yield.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {
namespace {

/// State of the scheme at a sample; signs as in the result, positive downstream.
struct SlammerState {
    double rate = 0.0, accel = 0.0, downstream = 0.0, upstream = 0.0;
    std::size_t stage = 0;

    double slip() const { return downstream - upstream; }
    double path() const { return downstream + upstream; }
};

/// s'' at a sample of a block that moves with `rate`, or would start from rest; 0: it stays at rest.
double slip_accel(const RigidBlock& block, double a_h, double a_v, double rate, bool two_way)
{
    const BaseEquations e = base_equations(block);
    if (free_normal_force(e).at(a_h, a_v) <= 0.0) {
        const double accel = e.drive.at(a_h, a_v) / e.mass_tt;
        return rate == 0.0 && accel < 0.0 && !two_way ? 0.0 : accel;
    }
    const auto accel_towards = [&](SlipDirection direction) {
        return excess_drive(e, block, direction).at(a_h, a_v) / sliding_mass(e, block.friction, direction);
    };
    const double down = accel_towards(SlipDirection::downstream);
    if (rate > 0.0 || (rate == 0.0 && down > 0.0)) return down;
    const double up = accel_towards(SlipDirection::upstream);
    if (rate < 0.0 || (rate == 0.0 && two_way && up > 0.0)) return -up;
    return 0.0;
}

void step(SlammerState& state, const SlipStages& stages, double a_h, double a_v, double dt, bool two_way)
{
    RigidBlock block = stages[state.stage].block;
    block.friction = friction_at(stages[state.stage], state.path());
    double accel = slip_accel(block, a_h, a_v, state.rate, two_way);
    double rate = state.rate + 0.5 * dt * (state.accel + accel);
    if (rate * state.rate < 0.0 || (!two_way && rate < 0.0)) rate = accel = 0.0;
    const double moved = 0.5 * dt * (state.rate + rate);
    (moved > 0.0 ? state.downstream : state.upstream) += std::abs(moved);
    state.rate = rate;
    state.accel = accel;
    if (rate == 0.0 && state.path() == 0.0) return;
    while (state.stage + 1 < stages.size() && stages[state.stage + 1].from_slip <= state.path()) ++state.stage;
}

void note_sample(const SlammerState& before, const SlammerState& now, double time, SlideResult& result)
{
    const bool was_moving = before.rate != 0.0, is_moving = now.rate != 0.0;
    if (is_moving && !was_moving && ++result.phases == 1) result.first_slip_time = time;
    if (was_moving || is_moving) result.last_slip_time = time;
    result.peak_slip_rate = std::max(result.peak_slip_rate, std::abs(now.rate));
    result.max_slip = std::max(result.max_slip, std::abs(now.slip()));
}

} // namespace

SlideResult slide_slammer(const GroundMotion& motion, const SlipStages& stages, const SlideOptions& options)
{
    SlideResult result;
    result.accuracy = SlideAccuracy::scheme;
    SlammerState state;
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k) {
        const double a_h = options.polarity * motion.accel_h[k];
        const double a_v = motion.accel_v.empty() ? 0.0 : motion.accel_v[k];
        const SlammerState before = state;
        step(state, stages, a_h, a_v, motion.dt, options.sliding.two_way);
        const double time = static_cast<double>(k) * motion.dt;
        note_sample(before, state, time, result);
        result.end_time = time;
        if (options.history == HistoryOutput::none) continue;
        const RigidBlock& block = stages[state.stage].block;
        result.history.time.push_back(time);
        result.history.slip.push_back(state.slip());
        result.history.slip_rate.push_back(state.rate);
        result.history.yield.push_back(yield_acceleration(block, a_v));
        result.history.normal_force.push_back(std::max(0.0, base_equations(block).normal.at(a_h, a_v)));
    }
    result.slip = state.slip();
    result.downstream_slip = state.downstream;
    result.upstream_slip = state.upstream;
    const StaticState still = static_state(stages.front().block);
    result.status = still != StaticState::at_rest ? status_of(still)
                    : state.rate != 0.0           ? Status::sliding_at_end
                                                  : Status::at_rest;
    result.notes.push_back({NoteKind::trapezoid_scheme});
    if (result.status == Status::sliding_at_end) result.notes.push_back({NoteKind::trapezoid_still_sliding});
    return result;
}

double slammer_slip(std::span<const double> accel, double dt, double yield_acceleration)
{
    double rate = 0.0, excess = 0.0, slip = 0.0;
    for (const double a : accel) {
        double now = a - yield_acceleration;
        if (rate == 0.0 && now <= 0.0) {
            excess = 0.0;
            continue;
        }
        double next = rate + 0.5 * dt * (excess + now);
        if (next <= 0.0) next = now = 0.0;
        slip += 0.5 * dt * (rate + next);
        rate = next;
        excess = now;
    }
    return slip;
}

} // namespace damslip::sliding
