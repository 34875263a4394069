#include "sliding/rocking/rocking.hpp"

#include "core/text.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/rocking/rocking_motion.hpp"

#include <algorithm>
#include <numbers>

namespace damslip::sliding {

namespace {

/// The resultant of the static loads acts outside the base.
bool tips_statically(const RockingBlock& block)
{
    const RockingStage& first = block.stages.front();
    return corner(block, first, Stance::toe).moment > 0.0 || corner(block, first, Stance::heel).moment < 0.0;
}

Status status_of(const RockingMotion& motion, const RockingBlock& block, StaticState state)
{
    if (motion.unresolved()) return Status::not_resolved;
    if (state != StaticState::at_rest) return status_of(state);
    if (tips_statically(block)) return Status::overturns;
    if (motion.overturned()) return Status::overturned;
    return motion.at_rest() ? Status::at_rest : Status::sliding_at_end;
}

void add_notes(const RockingMotion& motion, const SlideOptions& options, RockingResult& result)
{
    std::vector<Note>& notes = result.slide.notes;
    if (result.slide.status == Status::overturned)
        notes.push_back({NoteKind::turned_over, {result.overturned_time}});
    if (result.slide.status == Status::sliding_at_end)
        notes.push_back({NoteKind::still_moving, {options.sliding.run_out_max}});
    if (result.slide.status == Status::not_resolved)
        notes.push_back({motion.jammed() ? NoteKind::jammed_corner : NoteKind::many_events_at, {result.slide.end_time}});
    if (result.slide.lift_offs > 0)
        notes.push_back({NoteKind::lost_weight, {std::int64_t{result.slide.lift_offs}}});
}

} // namespace

void RockingMotion::add_sample(double time, RockingResult& result) const
{
    SlideHistory& history = result.slide.history;
    history.time.push_back(time);
    history.slip.push_back(y_[slip]);
    history.slip_rate.push_back(y_[slip_rate]);
    history.normal_force.push_back(pressed_ ? std::max(0.0, instant(0.0, y_).normal) : 0.0);
    result.rotation.push_back(y_[turn]);
    result.uplift.push_back(stance_ == Stance::base ? block_.stages[stage_].slip.block.uplift
                                                    : standing(0.0).force_n - block_.force_n);
}

void RockingMotion::write(RockingResult& result) const
{
    std::vector<double> rotation = std::move(result.rotation), uplift = std::move(result.uplift);
    SlideHistory history = std::move(result.slide.history);
    result = seen_;
    result.rotation = std::move(rotation);
    result.uplift = std::move(uplift);
    SlideResult& r = result.slide;
    r.history = std::move(history);
    r.accuracy = SlideAccuracy::series;
    r.slip = y_[slip];
    slid_.write(r, time_, sliding_);
    r.wet_length = longest_wet_;
    r.max_gap = block_.length *
                std::sin(std::min(0.5 * std::numbers::pi, std::max(seen_.max_toe_rotation, seen_.max_heel_rotation)));
    RockingEnergy& e = result.energy;
    e.ground = y_[work_ground];
    e.loads = y_[work_loads];
    e.friction = y_[work_friction];
    e.landings = landing_loss_;
    e.kinetic = kinetic_energy(standing(0.0), y_[turn], y_[slip_rate], y_[turn_rate]);
    const double left = first_energy_ + e.ground + e.loads - e.kinetic - e.friction - e.landings;
    e.imbalance = largest_work_ > 0.0 ? left / largest_work_ : 0.0;
}

RockingResult rock_and_slide(const GroundMotion& motion, const RockingBlock& block, const SlideOptions& options,
                             const RockingStart& start)
{
    check_motion(motion);
    SlipStages stages;
    for (const RockingStage& stage : block.stages) stages.push_back(stage.slip);
    check_stages(stages);
    const bool vertical = !motion.accel_v.empty();
    const auto a_h = [&](std::size_t k) { return options.polarity * motion.accel_h[k]; };
    const auto a_v = [&](std::size_t k) { return vertical ? motion.accel_v[k] : 0.0; };
    const bool keep = options.history == HistoryOutput::samples;

    RockingResult result;
    RockingMotion state(block, options, start);
    const std::size_t last = motion.accel_h.size() - 1;
    if (keep) state.add_sample(0.0, result);
    for (std::size_t k = 0; k < last && !state.finished(); ++k) {
        state.cross(static_cast<double>(k) * motion.dt, motion.dt, {a_h(k), a_h(k + 1)}, {a_v(k), a_v(k + 1)});
        if (keep) state.add_sample(static_cast<double>(k + 1) * motion.dt, result);
    }
    const StaticState standing = static_state(stages.front().block);
    const double end = static_cast<double>(last) * motion.dt, longest = options.sliding.run_out_max;
    if (standing == StaticState::at_rest && !tips_statically(block))
        for (double elapsed = 0.0; elapsed < longest && !state.at_rest() && !state.finished(); elapsed += motion.dt) {
            const double step = std::min(motion.dt, longest - elapsed);
            state.cross(end + elapsed, step, {}, {});
            if (keep) state.add_sample(end + elapsed + step, result);
        }
    state.write(result);
    result.slide.status = status_of(state, block, standing);
    add_notes(state, options, result);
    return result;
}

} // namespace damslip::sliding
