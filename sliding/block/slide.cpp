#include "sliding/block/slide.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slip_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

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

namespace {

/// Smallest and largest of samples first ... last, four sums side by side.
std::pair<double, double> extremes(const std::vector<double>& a, std::size_t first, std::size_t last)
{
    std::array<double, 4> low, high;
    low.fill(a[first]);
    high.fill(a[first]);
    std::size_t k = first;
    for (; k + 3 <= last; k += 4)
        for (std::size_t i = 0; i < 4; ++i) {
            low[i] = std::min(low[i], a[k + i]);
            high[i] = std::max(high[i], a[k + i]);
        }
    for (; k <= last; ++k) {
        low[0] = std::min(low[0], a[k]);
        high[0] = std::max(high[0], a[k]);
    }
    return {*std::min_element(low.begin(), low.end()), *std::max_element(high.begin(), high.end())};
}

AccelRange range_of(const GroundMotion& motion, std::size_t first, std::size_t last)
{
    AccelRange range;
    std::tie(range.h_min, range.h_max) = extremes(motion.accel_h, first, last);
    if (!motion.accel_v.empty()) std::tie(range.v_min, range.v_max) = extremes(motion.accel_v, first, last);
    return range;
}

AccelRange joined(std::span<const AccelRange> ranges)
{
    AccelRange all = ranges.front();
    for (const AccelRange& r : ranges)
        all = {std::min(all.h_min, r.h_min), std::max(all.h_max, r.h_max), std::min(all.v_min, r.v_min),
               std::max(all.v_max, r.v_max)};
    return all;
}

} // namespace

SkippingMotion::SkippingMotion(GroundMotion motion) : motion_(std::move(motion))
{
    check_motion(motion_);
    for (std::size_t k = 0; k < intervals(); k += block)
        blocks_.push_back(range_of(motion_, k, std::min(k + block, intervals())));
    const std::span<const AccelRange> all(blocks_);
    for (std::size_t k = 0; k < all.size(); k += block)
        large_blocks_.push_back(joined(all.subspan(k, std::min(block, all.size() - k))));
    whole_ = joined(large_blocks_);
}

void check_motion(const GroundMotion& motion)
{
    Diagnostic wrong;
    wrong.file = motion.name;
    wrong.expected =
        "a time step > 0 s and at least 2 finite samples, the vertical component as long as the horizontal one";
    const auto finite = [](double a) { return std::isfinite(a); };
    if (!(motion.dt > 0.0) || !std::isfinite(motion.dt))
        wrong.problem = "ground motion: time step " + shortest(motion.dt) + " s is not allowed.";
    else if (motion.accel_h.size() < 2)
        wrong.problem = "ground motion: " + std::to_string(motion.accel_h.size()) + " samples are too few.";
    else if (!motion.accel_v.empty() && motion.accel_v.size() != motion.accel_h.size())
        wrong.problem = "ground motion: " + std::to_string(motion.accel_v.size()) + " vertical samples beside " +
                        std::to_string(motion.accel_h.size()) + " horizontal ones.";
    else if (!std::ranges::all_of(motion.accel_h, finite) || !std::ranges::all_of(motion.accel_v, finite))
        wrong.problem = "ground motion: a sample is not a finite number.";
    else
        return;
    throw InputError(wrong);
}

namespace {

/// Zero samples between two events until the block rests, and for the pause from there on. @returns false where it does not
/// come to rest within `longest` [s]
template <typename Cross>
bool pause(const SlipMotion& block, const GroundMotion& motion, double longest, Line a_h, Line a_v, Cross&& cross)
{
    const auto most = static_cast<long>(std::ceil(longest / motion.dt - 1e-9));
    const auto wanted = static_cast<long>(std::ceil(motion.pause / motion.dt - 1e-9));
    for (long zeros = 1, at_rest = 0;; ++zeros) {
        cross(a_h, a_v);
        a_h = a_v = {};
        if (block.unresolved()) return false;
        at_rest = block.at_rest() ? at_rest + 1 : 0;
        if (at_rest > wanted) return true;
        if (at_rest == 0 && zeros >= most) return false;
    }
}

/// What each event of a sequence has added. @param slip  at the end, after the last one's run-out [m]
void add_changes(const GroundMotion& motion, double slip, SlideResult& result)
{
    if (result.events.empty()) return;
    result.events.back().slip = slip;
    double before = 0.0;
    for (EventSlip& event : result.events) {
        event.change = event.slip - before;
        before = event.slip;
    }
    const std::size_t left = motion.events.size() - result.events.size();
    if (left > 0 && (result.status == Status::at_rest || result.status == Status::sliding_at_end))
        result.notes.push_back(
            {NoteKind::events_not_run, {result.events.back().name, static_cast<std::int64_t>(left)}});
}

Note static_note(const SlipStages& stages, StaticState state)
{
    const RigidBlock& block = stages.front().block;
    if (state == StaticState::lifts_off) return {NoteKind::floats_statically, {static_normal_force(block)}};
    return {state == StaticState::slides_downstream ? NoteKind::slides_statically_downstream
                                                    : NoteKind::slides_statically_upstream,
            {critical_friction(block), block.friction}};
}

void add_notes(const SlipStages& stages, StaticState state, const SlideOptions& options, SlideResult& result)
{
    if (state != StaticState::at_rest) result.notes.push_back(static_note(stages, state));
    if (result.status == Status::sliding_at_end)
        result.notes.push_back({NoteKind::still_sliding, {options.sliding.run_out_max}});
    const RateFriction& rate = stages.front().rate;
    if (result.status == Status::not_resolved)
        result.notes.push_back(rate.active()
                                   ? Note{NoteKind::many_events_of_rate, {result.end_time, *rate.characteristic_rate}}
                                   : Note{NoteKind::many_events, {result.end_time}});
    if (result.accuracy == SlideAccuracy::series && rate.active())
        result.notes.push_back({NoteKind::rate_by_series});
    else if (result.accuracy == SlideAccuracy::series && options.anchors.empty())
        result.notes.push_back({NoteKind::slip_by_series});
    const RigidBlock& block = stages.front().block;
    if (block.opening && !(static_normal_force(block) > block.opening->largest()))
        result.notes.push_back(
            {NoteKind::crack_water_carries, {static_normal_force(block), block.opening->largest()}});
    if (block.opening && block.opening->slow)
        result.notes.push_back({NoteKind::crack_water_late,
                                {block.opening->slow->speed(), std::round(1e3 * result.wet_length) / 1e3}});
    if (result.lift_offs > 0)
        result.notes.push_back({options.sliding.lift_off == LiftOff::ballistic ? NoteKind::base_flew
                                                                               : NoteKind::base_opened,
                                {std::int64_t{result.lift_offs}}});
}

/// Longest cracks from heel and toe under a motion.
struct LongestCracks {
    double heel = 0.0, toe = 0.0; ///< [m]

    void look(const RestBetweenEvents& rests, double a_h, double a_v)
    {
        heel = std::max(heel, rests.crack(SlipDirection::downstream, a_h, a_v));
        toe = std::max(toe, rests.crack(SlipDirection::upstream, a_h, a_v));
    }
};

/// The static states between records, one after the other.
class Rests {
public:
    explicit Rests(const RestBetweenEvents* rests) : rests_(rests) {}

    void look(double a_h, double a_v)
    {
        if (rests_) cracks_.look(*rests_, a_h, a_v);
    }
    /// @returns false where the block does not stand there
    bool take(SlipMotion& block, SlideResult& result)
    {
        if (!rests_) return true;
        const RestBetweenEvents::Rest& now = taken_.emplace_back(rests_->rest(cracks_.heel, cracks_.toe));
        rests_ = now.next.get();
        state_ = static_state(now.stages.front().block);
        const bool stands = state_ == StaticState::at_rest;
        result.notes.push_back(now.note);
        result.notes.back().values.insert(result.notes.back().values.begin(), result.events.back().name);
        if (!stands) result.notes.push_back({NoteKind::rest_falls});
        if (!stands) return false;
        block.stand_on(now.stages);
        return true;
    }
    StaticState state() const { return state_; }

private:
    const RestBetweenEvents* rests_;
    LongestCracks cracks_;
    std::list<RestBetweenEvents::Rest> taken_; ///< the block looks at the stages of the last one
    StaticState state_ = StaticState::at_rest;
};

SlideResult slide_exact(const SkippingMotion& blocks, const SlipStages& stages, const SlideOptions& options,
                        const RestBetweenEvents* between)
{
    const GroundMotion& motion = blocks.motion();
    const bool vertical = !motion.accel_v.empty();
    const double polarity = options.polarity;
    const auto a_h = [&](std::size_t k) { return polarity * motion.accel_h[k]; };
    const auto a_v = [&](std::size_t k) { return vertical ? motion.accel_v[k] : 0.0; };

    SlideResult result;
    SlideHistory* history = options.history == HistoryOutput::samples ? &result.history : nullptr;
    SlipMotion block(stages, options);
    if (history) block.add_sample(0.0, a_h(0), a_v(0), *history);
    const bool stands = static_state(stages.front().block) == StaticState::at_rest;
    const auto rests = [&](const AccelRange& r) {
        return options.polarity > 0 ? block.stays_at_rest(r.h_min, r.h_max, r.v_min, r.v_max)
                                    : block.stays_at_rest(-r.h_max, -r.h_min, r.v_min, r.v_max);
    };
    Rests static_rests(between);
    if (between) static_rests.look(a_h(0), a_v(0));
    std::size_t n = 0; // intervals so far, those between events included
    const auto now = [&] { return static_cast<double>(n) * motion.dt; };
    const auto cross = [&](const Line& h, const Line& v) {
        block.cross(now(), motion.dt, h, v);
        ++n;
        static_rests.look(h.end, v.end);
        if (history) block.add_sample(now(), h.end, v.end, *history);
    };
    const std::size_t events = std::max<std::size_t>(1, motion.events.size());
    for (std::size_t e = 0; e < events; ++e) {
        const std::size_t first = e == 0 ? 0 : motion.events[e].first, last = motion.last_of(e);
        if (e > 0) cross({0.0, a_h(first)}, {0.0, a_v(first)});
        if (motion.is_sequence()) result.events.push_back({motion.events[e].name, now(), now(), 0.0, 0.0});
        for (std::size_t k = first; k < last && !block.unresolved(); ++k) {
            if (!history && !between) {
                std::size_t next = block.at_rest() ? std::min(blocks.skip(k, rests), last) : k;
                n += next - k;
                k = next;
                if (k < last) next = block.pass(blocks, polarity, k, last, n);
                n += next - k;
                k = next;
            }
            if (k == last || block.unresolved()) break;
            cross({a_h(k), a_h(k + 1)}, {a_v(k), a_v(k + 1)});
        }
        if (!motion.is_sequence()) break;
        result.events.back().end = now();
        const bool rests_then =
            e + 1 < events && stands &&
            pause(block, motion, options.sliding.run_out_max, {a_h(last), 0.0}, {a_v(last), 0.0}, cross);
        result.events.back().slip = block.slip();
        if (!rests_then || !static_rests.take(block, result)) break;
    }
    const double end = now();
    run_out(block, stages, end, motion.dt, options.sliding.run_out_max, history);
    conclude(block, stages, options, end, result);
    if (static_rests.state() != StaticState::at_rest && !block.unresolved())
        result.status = status_of(static_rests.state());
    add_changes(motion, block.slip(), result);
    return result;
}

/// With the error of the table of water on its way: the difference to a table of half the resolution.
SlideResult slide_with_error(const SkippingMotion& motion, const SlipStages& stages, const SlideOptions& options,
                             const RestBetweenEvents* between = nullptr)
{
    SlideResult result = slide_exact(motion, stages, options, between);
    const OpeningUplift* opening = stages.front().block.opening.get();
    if (!opening || !opening->slow || !opening->slow->coarser()) return result;
    SlipStages coarser = stages;
    for (SlipStage& stage : coarser) {
        OpeningUplift copy = *stage.block.opening;
        copy.slow = copy.slow->coarser();
        stage.block.opening = std::make_shared<const OpeningUplift>(std::move(copy));
    }
    SlideOptions plain = options;
    plain.history = HistoryOutput::none;
    result.slip_error = std::abs(slide_exact(motion, coarser, plain, between).max_slip - result.max_slip);
    result.notes.push_back({NoteKind::known_to, {1e3 * std::exp2(std::round(std::log2(result.slip_error)))}});
    return result;
}

void check_anchors(const SlideOptions& options)
{
    if (options.anchors.empty()) return;
    Diagnostic diagnostic;
    if (options.sliding.scheme == SlidingScheme::slammer) {
        diagnostic.problem = "SLAMMER's scheme with anchors is not allowed.";
        diagnostic.expected = "the exact scheme: SLAMMER's has no force that grows with slip";
        diagnostic.fix = "use  scheme = \"exact\"";
    } else if (options.sliding.lift_off == LiftOff::ballistic) {
        diagnostic.problem = "ballistic lift-off with anchors is not allowed.";
        diagnostic.expected = "lift_off = \"no-friction\": the block's flight knows no anchor";
        diagnostic.fix = "use  lift_off = \"no-friction\"";
    } else {
        return;
    }
    throw InputError(diagnostic);
}

} // namespace

void run_out(SlipMotion& block, const SlipStages& stages, double start, double dt, double longest,
             SlideHistory* history)
{
    if (static_state(stages.front().block) != StaticState::at_rest) return;
    for (double elapsed = 0.0; elapsed < longest && !block.unresolved(); elapsed += dt) {
        const double step = std::min(dt, longest - elapsed);
        block.cross(start + elapsed, step, {}, {});
        if (history) block.add_sample(start + elapsed + step, 0.0, 0.0, *history);
        if (block.at_rest()) return;
    }
}

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
    return slide(SkippingMotion(motion), stages, options);
}

SlideResult slide(const GroundMotion& motion, const SlipStages& stages, const SlideOptions& options,
                  const RestBetweenEvents* rests)
{
    const SkippingMotion blocks(motion);
    if (!rests || !motion.is_sequence() || options.sliding.scheme == SlidingScheme::slammer)
        return slide(blocks, stages, options);
    check_stages(stages);
    check_anchors(options);
    return slide_with_error(blocks, stages, options, rests);
}

SlideResult slide(const SkippingMotion& motion, const SlipStages& stages, const SlideOptions& options)
{
    check_stages(stages);
    check_anchors(options);
    if (options.sliding.scheme == SlidingScheme::slammer) return slide_slammer(motion.motion(), stages, options);
    return slide_with_error(motion, stages, options);
}

SlideResult slide(const GroundMotion& motion, const RigidBlock& block, const SlideOptions& options)
{
    return slide(motion, SlipStages{{0.0, block, 0.0}}, options);
}

namespace {

/// @param stages  of at most batch_size blocks @returns false where they have to go one by one
bool slide_batched(const SkippingMotion& motion, std::span<const SlipStages* const> stages, const SlideOptions& options,
                   std::span<SlideResult> results)
{
    std::vector<SlipMotion> blocks;
    std::array<SlipMotion*, batch_size> batch;
    blocks.reserve(batch_size);
    for (std::size_t i = 0; i < batch_size; ++i) { // the last one fills up
        blocks.emplace_back(*stages[std::min(i, stages.size() - 1)], options);
        batch[i] = &blocks[i];
    }
    if (!SlipMotion::pass_together(motion, options.polarity, batch)) return false;
    const double dt = motion.motion().dt, end = static_cast<double>(motion.intervals()) * dt;
    for (std::size_t i = 0; i < results.size(); ++i) {
        SlipMotion& block = blocks[i];
        run_out(block, *stages[i], end, dt, options.sliding.run_out_max, nullptr);
        conclude(block, *stages[i], options, end, results[i]);
    }
    return true;
}

} // namespace

std::vector<SlideResult> slide_together(const SkippingMotion& motion, std::span<const SlipStages* const> blocks,
                                        const SlideOptions& options)
{
    std::vector<SlideResult> results(blocks.size());
    SlideOptions plain = options;
    plain.history = HistoryOutput::none;
    const bool together = has_batched_runs() && !motion.motion().is_sequence() &&
                          options.sliding.scheme == SlidingScheme::exact && options.anchors.empty();
    for (std::size_t first = 0; first < blocks.size(); first += batch_size) {
        const std::size_t count = std::min(batch_size, blocks.size() - first);
        const auto here = blocks.subspan(first, count);
        if (together && count > 1 && std::ranges::all_of(here, [](const SlipStages* s) { return s->size() == 1; })) {
            for (const SlipStages* stages : here) check_stages(*stages);
            if (slide_batched(motion, here, plain, std::span(results).subspan(first, count))) continue;
        }
        for (std::size_t i = 0; i < count; ++i) results[first + i] = slide(motion, *here[i], plain);
    }
    return results;
}

} // namespace damslip::sliding
