#include "core/input_error.hpp"
#include "core/text.hpp"
#include "sliding/flexible/coupled_motion.hpp"
#include "sliding/flexible/flexible_slide.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

namespace {

void add_sample(const CoupledMotion& block, double time, double a_v, FlexibleSlide& result)
{
    SlideHistory& history = result.slide.history;
    history.time.push_back(time);
    history.slip.push_back(block.slip());
    history.slip_rate.push_back(block.slip_rate());
    history.yield.push_back(block.yield(a_v));
    result.deflection.push_back(block.mode().x);
    result.deflection_rate.push_back(block.mode().v);
}

/// Stages without slope. What follows the last stage has no end to cut towards: it keeps its first friction.
SlipStages in_steps(const SlipStages& stages)
{
    SlipStages out;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const SlipStage& stage = stages[i];
        const bool cut = stage.friction_slope != 0.0 && i + 1 < stages.size();
        const int parts = cut ? 100 : 1;
        const double length = cut ? (stages[i + 1].from_slip - stage.from_slip) / parts : 0.0;
        for (int k = 0; k < parts; ++k) {
            SlipStage part = stage;
            part.from_slip = stage.from_slip + k * length;
            if (cut) part.block.friction = friction_at(stage, part.from_slip + 0.5 * length);
            part.friction_slope = 0.0;
            out.push_back(part);
        }
    }
    return out;
}

[[noreturn]] void refuse(const std::string& problem, const std::string& expected)
{
    Diagnostic wrong;
    wrong.file = "flexible_block";
    wrong.problem = problem;
    wrong.expected = expected;
    throw InputError(wrong);
}

} // namespace

void check_flexible(const FlexibleBlock& flexible, const SlipStages& stages)
{
    check_stages(stages);
    if (!(flexible.period > 0.0) || !std::isfinite(flexible.period))
        refuse("the period " + shortest(flexible.period) + " s is not allowed.", "a period > 0 s");
    if (!(flexible.damping_ratio >= 0.0 && flexible.damping_ratio <= 0.5))
        refuse("the damping ratio " + shortest(flexible.damping_ratio) + " is not allowed.", "0 ... 0.5");
    if (!(flexible.mass_ratio > 0.0 && flexible.mass_ratio <= 0.95))
        refuse("the mass ratio " + shortest(flexible.mass_ratio) + " is not allowed.", "> 0, at most 0.95");
    for (const SlipStage& stage : stages)
        for (const Yield& yield : {yield_downstream(stage.block), yield_upstream(stage.block)}) {
            const double coupling = std::cos(stage.block.base_inclination) * yield.factor;
            if (1.0 - flexible.mass_ratio * coupling < 0.01)
                refuse("friction " + shortest(stage.block.friction) +
                           " on a base this steep jams a block with the mass "
                           "ratio " +
                           shortest(flexible.mass_ratio) + ": 1 - Gamma c f is not above 0.01.",
                       "a smaller mass_ratio, less friction or a flatter base");
        }
}

void note_vibration(const SlideOptions& options, SlideResult& result)
{
    result.status = Status::sliding_at_end;
    result.notes.push_back("Still vibrating " + shortest(options.sliding.run_out_max) +
                           " s after the record's end, enough to slide again: the slip is a lower bound.");
}

FlexibleSlide slide_coupled(const GroundMotion& motion, const SlipStages& stages, const FlexibleBlock& flexible,
                            const SlideOptions& options)
{
    check_motion(motion);
    check_flexible(flexible, stages);
    FlexibleSlide result;
    if (const StaticState still = static_state(stages.front().block); still != StaticState::at_rest) {
        result.slide.status = status_of(still);
        result.slide.notes.push_back(
            "The block slides or floats without an earthquake: its vibration is not followed.");
        return result;
    }
    const bool vertical = !motion.accel_v.empty(), history = options.history == HistoryOutput::samples;
    const double dt = motion.dt;
    const auto a_h = [&](std::size_t k) { return options.polarity * motion.accel_h[k]; };
    const auto a_v = [&](std::size_t k) { return vertical ? motion.accel_v[k] : 0.0; };
    CoupledMotion block(in_steps(stages), flexible, options.sliding);
    if (history) add_sample(block, 0.0, a_v(0), result);
    const std::size_t last = motion.accel_h.size() - 1;
    for (std::size_t k = 0; k < last; ++k) {
        block.cross(static_cast<double>(k) * dt, dt, {a_h(k), a_h(k + 1)}, {a_v(k), a_v(k + 1)});
        if (history) add_sample(block, static_cast<double>(k + 1) * dt, a_v(k + 1), result);
    }
    const double end = static_cast<double>(last) * dt;
    for (double t = 0.0; t < options.sliding.run_out_max && !block.at_rest_for_good(); t += dt) {
        block.cross(end + t, std::min(dt, options.sliding.run_out_max - t), {}, {});
        if (history) add_sample(block, end + std::min(t + dt, options.sliding.run_out_max), 0.0, result);
    }
    block.write(result.slide);
    result.peak_acceleration = block.peak_acceleration();
    if (block.moving()) {
        result.slide.status = Status::sliding_at_end;
        result.slide.notes.push_back("Still sliding " + shortest(options.sliding.run_out_max) +
                                     " s after the record's end: the slip is a lower bound.");
    } else if (!block.at_rest_for_good()) {
        note_vibration(options, result.slide);
    }
    return result;
}

} // namespace damslip::sliding
