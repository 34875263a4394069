#include "sliding/wedge/wedge.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

namespace {

constexpr double gravity = 9.81; // of the block that stands for the wedge: cancels

/// A block of unit mass on a level plane with the yields of the wedge.
SlipStages level_block(const WedgeYields& yields)
{
    const double first = yields.at_rest.law.constant, later = yields.moving ? yields.moving->law.constant : first;
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = gravity;
    block.friction = std::max(later, 0.0) / gravity;
    block.horizontal_force = std::max(-later, 0.0);
    block.cohesion_force = first - later;
    SlipStages stages{{0.0, block, 0.0}};
    if (block.cohesion_force > 0.0) {
        block.cohesion_force = 0.0;
        stages.push_back({0.0, block, 0.0}); // from the first slip on
    }
    return stages;
}

/// a_h - per_a_v a_v, which drives that block.
GroundMotion driving(const GroundMotion& motion, double per_a_v, int polarity)
{
    GroundMotion level = motion;
    level.accel_v.clear();
    for (std::size_t k = 0; k < level.accel_h.size(); ++k) {
        level.accel_h[k] *= polarity;
        if (!motion.accel_v.empty()) level.accel_h[k] -= per_a_v * motion.accel_v[k];
    }
    return level;
}

void scale(SlideResult& r, double factor)
{
    for (double* x : {&r.slip, &r.max_slip, &r.downstream_slip, &r.upstream_slip, &r.peak_slip_rate}) *x *= factor;
    for (auto* list : {&r.history.slip, &r.history.slip_rate})
        for (double& x : *list) x *= factor;
}

/// Yield of a_h at the samples; the run-out has no vertical motion.
void restore_yield(SlideHistory& history, const GroundMotion& motion, double per_a_v)
{
    history.normal_force.clear();
    history.gap.clear();
    for (std::size_t k = 0; k < std::min(history.yield.size(), motion.accel_v.size()); ++k)
        history.yield[k] += per_a_v * motion.accel_v[k];
}

/// A wedge that no ground acceleration moves.
SlideResult at_rest(const GroundMotion& motion, const SlideOptions& options)
{
    SlideResult r;
    const std::size_t n = motion.accel_h.size();
    r.end_time = n > 0 ? motion.dt * static_cast<double>(n - 1) : 0.0;
    if (options.history == HistoryOutput::none) return r;
    for (std::size_t k = 0; k < n; ++k) r.history.time.push_back(motion.dt * static_cast<double>(k));
    r.history.slip.assign(n, 0.0);
    r.history.slip_rate.assign(n, 0.0);
    r.history.yield.assign(n, std::numeric_limits<double>::quiet_NaN());
    return r;
}

} // namespace

SlideResult slide_wedge(const GroundMotion& motion, const WedgeYields& yields, const SlideOptions& options)
{
    const WedgeYield& yield = yields.at_rest;
    if (yield.law.constant == std::numeric_limits<double>::infinity()) return at_rest(motion, options);
    if (!(yield.factor > 0.0) || !std::isfinite(yield.law.constant)) { // slides without, and no shaking pushes it on
        SlideResult r = at_rest(motion, options);
        r.status = Status::static_failure;
        return r;
    }
    SlideOptions level = options;
    level.polarity = 1;
    level.sliding.two_way = false;
    SlideResult r = slide(driving(motion, yield.law.per_a_v, options.polarity), level_block(yields), level);
    scale(r, yield.factor);
    restore_yield(r.history, motion, yield.law.per_a_v);
    if (r.status == Status::static_failure)
        r.notes = {"The wedge slides without an earthquake. The slip is the one up to the record's end."};
    return r;
}

double share_of_other_modes(const Wedge& wedge, const Vector3& push, const GroundMotion& motion,
                            const WedgeYield& yield, int polarity)
{
    std::size_t beyond = 0, other = 0;
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k) {
        const double a_h = polarity * motion.accel_h[k], a_v = motion.accel_v.empty() ? 0.0 : motion.accel_v[k];
        if (!(a_h > yield.law.at(a_v))) continue;
        ++beyond;
        other += wedge_state(wedge, push, a_h, a_v).mode != yield.state.mode;
    }
    return beyond > 0 ? static_cast<double>(other) / static_cast<double>(beyond) : 0.0;
}

} // namespace damslip::sliding
