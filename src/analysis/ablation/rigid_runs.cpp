#include "analysis/ablation/ablation_runs.hpp"

#include "core/processor_clock.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

/// Runs of milliseconds are made so often that the shortest says what they cost.
constexpr int repetitions = 5;
constexpr double long_run = 0.005; ///< not repeated [s]

/// The shortest time of the task, made at least once [s].
template <class Task>
double shortest_time(Task&& task)
{
    double least = 0.0;
    for (int k = 0; k < repetitions; ++k) {
        const ProcessorClock clock;
        task();
        const double seconds = clock.seconds();
        least = k == 0 ? seconds : std::min(least, seconds);
        if (seconds > long_run) break;
    }
    return least;
}

std::string sentence(const sliding::SlideResult& r, const RigidModel& model)
{
    if (fails_statically(r.status)) return model.why_it_fails();
    if (reported(r.status, r.slip) || r.notes.empty()) return "";
    return r.status == Status::runs_away || r.status == Status::rocks_first ? r.notes.back() : r.notes.front();
}

RecordOutcome outcome(const sliding::SlideResult& r, const RigidModel& model)
{
    RecordOutcome o;
    o.status = r.status;
    o.message = sentence(r, model);
    o.still_sliding = r.status == Status::sliding_at_end;
    if (r.status == Status::at_rest || r.status == Status::sliding_at_end) o.slip = r.slip;
    return o;
}

} // namespace

SceneRuns run_rigid(const Ready& ready, const Watch& watch)
{
    SceneRuns runs;
    RigidModel model;
    runs.set_up_seconds = shortest_time([&] {
        model = ready.with(ready.scene).rigid_model(); // seepage solved anew: what a run of this scene alone costs
    });
    runs.yield_acceleration = model.downstream.law.constant;
    runs.critical_friction = model.critical_friction;
    for (const RecordPair& pair : ready.records()) {
        runs.records.emplace_back();
        if (watch.stop_asked()) continue;
        const GroundMotion motion = ready.motion(pair, 1.0, polarities_of(ready.scene).front());
        sliding::SlideResult result;
        const double seconds = shortest_time([&] { result = slide_model(ready.scene, model, motion, 1); });
        runs.records.back() = outcome(result, model);
        runs.records.back().seconds = seconds;
    }
    return runs;
}

} // namespace damslip
