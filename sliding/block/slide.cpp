#include "sliding/block/slide.hpp"

#include "core/defect.hpp"
#include "core/number.hpp"
#include "sliding/block/slammer.hpp"
#include "sliding/block/slip_motion.hpp"
#include "sliding/block/yield.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {
namespace {

/// Zero ground acceleration in steps of dt until the block rests.
void run_out(SlipMotion& block, double start, double dt, double longest, SlideHistory* history)
{
    for (double elapsed = 0.0; elapsed < longest && !block.unresolved(); elapsed += dt) {
        const double step = std::min(dt, longest - elapsed);
        block.cross(start + elapsed, step, {}, {});
        if (history) block.add_sample(start + elapsed + step, 0.0, 0.0, *history);
        if (block.at_rest()) return;
    }
}

std::string static_note(const SlipStages& stages, StaticState state)
{
    const RigidBlock& block = stages.front().block;
    if (state == StaticState::lifts_off)
        return "The uplift carries more than the weight (N' = " + shortest(static_normal_force(block)) +
               " N/m): the block floats without an earthquake; no friction would hold it.";
    return std::string("The block slides ") + (state == StaticState::slides_downstream ? "downstream" : "upstream") +
           " without an earthquake; a friction of " + shortest(critical_friction(block)) +
           " or more would hold it (here " + shortest(block.friction) +
           "). The slip is the one up to the record's end.";
}

void add_notes(const SlipStages& stages, StaticState state, const SlideOptions& options, SlideResult& result)
{
    if (state != StaticState::at_rest) result.notes.push_back(static_note(stages, state));
    if (result.status == Status::sliding_at_end)
        result.notes.push_back("Still sliding " + shortest(options.sliding.run_out_max) +
                               " s after the record's end: the slip is a lower bound.");
    if (result.status == Status::not_resolved)
        result.notes.push_back("More events in one sample interval than a motion can have; the slip up to " +
                               shortest(result.end_time) + " s is given.");
    if (result.accuracy == SlideAccuracy::series)
        result.notes.push_back("Friction linear in slip under a varying normal force has no closed form: Taylor series "
                               "to round-off, events "
                               "located within 1e-10.");
    if (result.lift_offs > 0)
        result.notes.push_back("The base opened " + std::to_string(result.lift_offs) +
                               " times (N' = 0); lift-off is treated as " +
                               (options.sliding.lift_off == LiftOff::ballistic ? "ballistic flight."
                                                                               : "loss of resistance without flight."));
}

/// `blocks`: ranges of the motion's blocks of samples, for skipping; null: every interval is looked at.
SlideResult slide_exact(const GroundMotion& motion, const SkippingMotion* blocks, const SlipStages& stages,
                        const SlideOptions& options)
{
    const bool vertical = !motion.accel_v.empty();
    const double polarity = options.polarity;
    const auto a_h = [&](std::size_t k) { return polarity * motion.accel_h[k]; };
    const auto a_v = [&](std::size_t k) { return vertical ? motion.accel_v[k] : 0.0; };

    SlideResult result;
    SlideHistory* history = options.history == HistoryOutput::samples ? &result.history : nullptr;
    SlipMotion block(stages, options);
    if (history) block.add_sample(0.0, a_h(0), a_v(0), *history);
    const std::size_t last = motion.accel_h.size() - 1;
    const auto rests = [&](const AccelRange& r) {
        return options.polarity > 0 ? block.stays_at_rest(r.h_min, r.h_max, r.v_min, r.v_max)
                                    : block.stays_at_rest(-r.h_max, -r.h_min, r.v_min, r.v_max);
    };
    for (std::size_t k = 0; k < last && !block.unresolved(); ++k) {
        if (blocks && !history && block.at_rest()) k = blocks->skip(k, rests);
        if (k == last) break;
        block.cross(static_cast<double>(k) * motion.dt, motion.dt, {a_h(k), a_h(k + 1)}, {a_v(k), a_v(k + 1)});
        if (history) block.add_sample(static_cast<double>(k + 1) * motion.dt, a_h(k + 1), a_v(k + 1), *history);
    }
    const double end = static_cast<double>(last) * motion.dt;
    if (static_state(stages.front().block) == StaticState::at_rest && !defect(Defect::run_out_off))
        run_out(block, end, motion.dt, options.sliding.run_out_max, history);
    conclude(block, stages, options, end, result);
    return result;
}

} // namespace

void conclude(const SlipMotion& block, const SlipStages& stages, const SlideOptions& options, double record_end,
              SlideResult& result)
{
    const StaticState state = static_state(stages.front().block);
    block.write(result);
    if (!block.unresolved()) result.end_time = std::max(result.end_time, record_end);
    result.status = block.unresolved()              ? Status::not_resolved
                    : state != StaticState::at_rest ? status_of(state)
                    : block.at_rest()               ? Status::at_rest
                                                    : Status::sliding_at_end;
    add_notes(stages, state, options, result);
}

SlideResult slide(const GroundMotion& motion, const SlipStages& stages, const SlideOptions& options)
{
    check_motion(motion);
    check_stages(stages);
    if (options.sliding.scheme == SlidingScheme::slammer) return slide_slammer(motion, stages, options);
    return slide_exact(motion, nullptr, stages, options);
}

SlideResult slide(const SkippingMotion& motion, const SlipStages& stages, const SlideOptions& options)
{
    check_stages(stages);
    if (options.sliding.scheme == SlidingScheme::slammer) return slide_slammer(motion.motion(), stages, options);
    return slide_exact(motion.motion(), &motion, stages, options);
}

SlideResult slide(const GroundMotion& motion, const RigidBlock& block, const SlideOptions& options)
{
    return slide(motion, SlipStages{{0.0, block, 0.0}}, options);
}

} // namespace damslip::sliding
