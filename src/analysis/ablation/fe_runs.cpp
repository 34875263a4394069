#include "analysis/ablation/ablation_runs.hpp"

#include "core/processor_clock.hpp"
#include "fe2d/run/earthquake_run.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

namespace {

/// Where the step is chosen: the full scene may do with a longer one, but simpler scenes slip more, or less damped.
constexpr int least_halvings = 3;

/// Largest distance of the crest from where it stood over the base [m].
std::optional<double> crest_motion(const fe2d::RunHistory& history)
{
    if (history.time.empty()) return std::nullopt;
    double largest = 0.0;
    for (std::size_t i = 0; i < history.time.size(); ++i)
        largest = std::max(largest, std::abs(history.crest_x[i] - history.slip[i]));
    return largest;
}

/// @param run_out  the scene's sliding.run_out_max [s]; without one nothing is known to rest
RecordOutcome outcome(const fe2d::RunResult& r, double run_out)
{
    RecordOutcome o;
    o.status = r.status;
    if (r.status != Status::at_rest && r.status != Status::sliding_at_end) {
        o.message = r.message;
        return o;
    }
    o.still_sliding = r.status == Status::sliding_at_end && run_out > 0.0;
    o.slip = r.slip;
    o.crest = crest_motion(r.history);
    for (const fe2d::LiftResult& lift : r.lifts) o.lift_slips.push_back(lift.slip);
    return o;
}

/// Passes of all records at both steps.
double whole_work(const AblationStep& step, std::size_t records)
{
    return static_cast<double>(records) * (std::exp2(step.halvings) + std::exp2(step.other));
}

} // namespace

SceneRuns run_fe(const Ready& ready, const AblationStep& step, const Watch& watch,
                 const std::function<void(double fraction)>& done)
{
    SceneRuns runs;
    Scene scene = ready.scene;
    const std::vector<RecordPair>& records = ready.records();
    const ProcessorClock clock;
    fe2d::RunOptions options = ready.run_options(watch);
    double before = 0.0, weight = std::exp2(step.halvings);
    options.progress = [&](const fe2d::RunProgress& p) {
        done((before + weight * std::min(1.0, p.time / p.end)) / whole_work(step, records.size()));
        return watch.stop_asked() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
    };
    scene.time.substeps = step.halvings;
    const fe2d::EarthquakeRun model(scene, options);
    runs.set_up_seconds = clock.seconds();
    runs.unknowns = model.model().dofs.count + (model.water() ? model.water()->water.unknowns() : 0);
    scene.time.substeps = step.other;
    const fe2d::EarthquakeRun other(scene, options);
    const auto run = [&](const fe2d::EarthquakeRun& at, const GroundMotion& motion, int halvings) {
        weight = std::exp2(halvings);
        fe2d::RunResult result = at.run(motion);
        before += weight;
        return result;
    };
    for (const RecordPair& pair : records) {
        runs.records.emplace_back();
        if (watch.stop_asked()) continue;
        const GroundMotion motion = ready.motion(pair, 1.0, polarities_of(ready.scene).front());
        const ProcessorClock run_clock;
        const fe2d::RunResult result = run(model, motion, step.halvings);
        const double seconds = run_clock.seconds();
        if (!result.stages.empty()) runs.critical_friction = result.stages.back().critical_friction;
        runs.records.back() = outcome(result, scene.sliding.run_out_max);
        runs.records.back().seconds = seconds;
        if (runs.records.back().slip)
            runs.records.back().slip_other_step =
                outcome(run(other, motion, step.other), scene.sliding.run_out_max).slip;
    }
    return runs;
}

AblationStep choose_step(const Ready& full, const Watch& watch)
{
    AblationStep step;
    step.chosen = !full.scene.time.substeps;
    double dt = 0.0;
    for (const RecordPair& pair : full.records()) dt = std::max(dt, full.scene.time.dt.value_or(full.motion(pair).dt));
    step.halvings = full.scene.time.substeps.value_or(0);
    if (step.chosen) {
        const fe2d::EarthquakeRun model(full.scene, full.run_options(watch));
        for (const RecordPair& pair : full.records()) {
            const fe2d::RunResult r = model.run(full.motion(pair, 1.0, polarities_of(full.scene).front()));
            step.halvings = std::max({step.halvings, least_halvings, r.halvings});
            step.missed = step.missed || r.status == Status::tolerance_missed;
            if (watch.stop_asked()) break;
        }
    }
    step.other = step.halvings > 0 ? step.halvings - 1 : 1;
    step.largest_dt = dt / std::exp2(step.halvings);
    return step;
}

} // namespace damslip
