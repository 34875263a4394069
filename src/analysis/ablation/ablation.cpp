#include "analysis/ablation/ablation.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/reservoir.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/status.hpp"
#include "core/watch.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "scene/effect_plan.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <mutex>

namespace damslip {

namespace {

/// All removals one after the other, as far as the effects are still there.
Scene without_all(const AblationPlan& ablations, const std::vector<Point>& seepage_points)
{
    Scene scene = ablations.full;
    for (const Ablation& a : ablations.removals) {
        if (!make_effect_plan(scene, ablations.method).on(a.effect)) continue;
        auto answer = effect_row(a.effect).remove(scene, seepage_points);
        if (auto* removal = std::get_if<Removal>(&answer)) scene = std::move(removal->scene);
    }
    return scene;
}

} // namespace

AblationPlan make_ablations(const Scene& scene, Method method, const std::vector<Point>& seepage_points)
{
    AblationPlan ablations;
    ablations.method = method;
    ablations.full = scene;
    const EffectPlan plan = make_effect_plan(scene, method);
    for (const PlannedEffect& e : plan.effects) {
        if (!e.on) continue;
        const EffectRow& row = effect_row(e.effect);
        auto answer = row.remove(scene, seepage_points);
        if (auto* removal = std::get_if<Removal>(&answer))
            ablations.removals.push_back({e.effect, e.name, removal->instead,
                                          row.part_of ? std::optional(row.part_of(plan)) : std::nullopt,
                                          std::move(removal->scene)});
        else
            ablations.kept.push_back({e.name, std::get<Stays>(answer).why});
    }
    for (Ablation& a : ablations.removals)
        if (a.part_of && std::none_of(ablations.removals.begin(), ablations.removals.end(),
                                      [&a](const Ablation& other) { return other.effect == *a.part_of; }))
            a.part_of.reset();
    if (ablations.removals.size() > 1) ablations.simplest = without_all(ablations, seepage_points);
    return ablations;
}

namespace {

std::vector<const Scene*> scenes_of(const AblationPlan& plan)
{
    std::vector<const Scene*> scenes{&plan.full};
    for (const Ablation& a : plan.removals) scenes.push_back(&a.scene);
    if (plan.simplest) scenes.push_back(&*plan.simplest);
    return scenes;
}

constexpr std::size_t bar_parts = 1000; ///< of one scene

/// Runs of a scene whose model could not be made.
SceneRuns without_model(Status status, const std::string& why, std::size_t motions)
{
    MotionOutcome none;
    none.status = status;
    none.message = why;
    SceneRuns runs;
    runs.motions.assign(motions, none);
    return runs;
}

} // namespace

double difference_error(const AblationStep& step, double at_step, double at_other)
{
    const double halved = std::exp2(std::abs(step.halvings - step.other));
    const double finer = std::abs(at_step - at_other) / (halved - 1.0);
    return step.other < step.halvings ? finer : halved * finer;
}

std::vector<Point> seepage_points(const Scene& scene)
{
    if (!scene.uplift || scene.uplift->model != UpliftModel::seepage || !scene.reservoir) return {};
    const double heel = scene.reservoir->density * scene.gravity * scene.reservoir->level;
    if (!(heel > 0.0)) return {};
    SeepageSource seepage;
    std::vector<Point> points;
    for (const ProfilePoint& p : seepage.profile_of(scene)(scene_uplift_state(scene)).points)
        points.push_back({p.distance, std::max(0.0, p.pressure / heel)});
    return points;
}

AblationRuns run_ablations(const AblationPlan& plan, const Records& records, int jobs, Watch& watch)
{
    const std::vector<const Scene*> scenes = scenes_of(plan);
    AblationRuns runs;
    runs.motions = motion_names(plan.full, *records);
    runs.jobs = thread_count(jobs);
    runs.scenes.resize(scenes.size());
    if (plan.method == Method::finite_elements)
        runs.step = choose_step(prepare(plan.full, plan.method, records, {.stop = watch.stop()}), watch);
    std::vector<double> shares(scenes.size(), 0.0);
    std::mutex mutex;
    watch.begin("ablate", static_cast<double>(bar_parts * scenes.size()));
    parallel_for(scenes.size(), jobs, [&](std::size_t i) {
        const auto done = [&](double share) {
            const std::lock_guard lock(mutex);
            shares[i] = share;
            double sum = 0.0;
            for (const double s : shares) sum += s;
            watch.at(bar_parts * sum);
        };
        try {
            const ProcessorClock clock;
            const Ready ready = prepare(*scenes[i], plan.method, records, {.stop = watch.stop()});
            const double seconds = clock.seconds();
            runs.scenes[i] = runs.step ? run_fe(ready, *runs.step, watch, done) : run_rigid(ready, watch);
            if (runs.step) runs.scenes[i].set_up_seconds += seconds; // of a dam's own period
        } catch (const NotConverged& error) {
            runs.scenes[i] = without_model(Status::not_resolved, error.diagnostic().problem, runs.motions.size());
        } catch (const Interrupted& stopped) { // in its set-up
            runs.scenes[i] = without_model(Status::interrupted, stopped.what(), runs.motions.size());
        }
        watch.results_at_hand();
        done(1.0);
    });
    watch.end();
    return runs;
}

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
MotionOutcome outcome(const fe2d::RunResult& r, double run_out)
{
    MotionOutcome o;
    o.status = r.status;
    if (r.status != Status::at_rest && r.status != Status::sliding_at_end) {
        o.message = text_of(r.notes);
        return o;
    }
    o.still_sliding = r.status == Status::sliding_at_end && run_out > 0.0;
    o.slip = r.slip;
    o.crest = crest_motion(r.history);
    for (const fe2d::LiftResult& lift : r.lifts) o.lift_slips.push_back(lift.slip);
    return o;
}

/// Passes of all motions at both steps.
double whole_work(const AblationStep& step, std::size_t motions)
{
    return static_cast<double>(motions) * (std::exp2(step.halvings) + std::exp2(step.other));
}

} // namespace

SceneRuns run_fe(const Ready& ready, const AblationStep& step, const Watch& watch,
                 const std::function<void(double fraction)>& done)
{
    SceneRuns runs;
    Scene scene = ready.scene;
    const std::size_t motions = motion_names(scene, ready.records()).size();
    const ProcessorClock clock;
    fe2d::RunOptions options = ready.run_options(watch);
    double before = 0.0, weight = std::exp2(step.halvings);
    options.progress = [&](const fe2d::RunProgress& p) {
        done((before + weight * std::min(1.0, p.time / p.end)) / whole_work(step, motions));
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
    for (const RecordPair& pair : ready.records())
        for (const GroundMotion& motion : ready.motions(pair)) {
            MotionOutcome& of_motion = runs.motions.emplace_back();
            if (watch.stop_asked()) continue;
            const ProcessorClock run_clock;
            const fe2d::RunResult result = run(model, motion, step.halvings);
            const double seconds = run_clock.seconds();
            if (!result.stages.empty()) runs.critical_friction = result.stages.back().critical_friction;
            of_motion = outcome(result, scene.sliding.run_out_max);
            of_motion.seconds = seconds;
            if (of_motion.slip)
                of_motion.slip_other_step = outcome(run(other, motion, step.other), scene.sliding.run_out_max).slip;
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
        for (const RecordPair& pair : full.records())
            for (const GroundMotion& motion : full.motions(pair)) {
                if (watch.stop_asked()) break;
                const fe2d::RunResult r = model.run(motion);
                step.halvings = std::max({step.halvings, least_halvings, r.halvings});
                step.missed = step.missed || r.status == Status::tolerance_missed;
            }
    }
    step.other = step.halvings > 0 ? step.halvings - 1 : 1;
    step.largest_dt = dt / std::exp2(step.halvings);
    return step;
}

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
    return reported(r.status, r.slip) ? "" : ending_of(r);
}

MotionOutcome outcome(const sliding::SlideResult& r, const RigidModel& model)
{
    MotionOutcome o;
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
    std::vector<RigidModel> models; // of all planes: what an effect of one is worth shows where that one governs
    runs.set_up_seconds = shortest_time([&] {
        models = all_models(ready.with(ready.scene)); // seepage solved anew: what a run of this scene alone costs
    });
    runs.yield_acceleration = models.front().downstream.law.constant;
    runs.critical_friction = models.front().critical_friction;
    for (const RigidModel& model : models) {
        runs.yield_acceleration = std::min(*runs.yield_acceleration, model.downstream.law.constant / model.amplification);
        runs.critical_friction = std::max(*runs.critical_friction, model.critical_friction);
    }
    for (const RecordPair& pair : ready.records())
        for (const GroundMotion& motion : ready.motions(pair)) {
            MotionOutcome& of_motion = runs.motions.emplace_back();
            if (watch.stop_asked()) continue;
            std::vector<sliding::SlideResult> results(models.size());
            const double seconds = shortest_time([&] {
                for (std::size_t i = 0; i < models.size(); ++i)
                    results[i] = slide_model(ready.scene, models[i], motion, 1);
            });
            const auto worst = std::max_element(results.begin(), results.end(), [](const auto& a, const auto& b) {
                return a.max_slip < b.max_slip;
            });
            of_motion = outcome(*worst, models[std::size_t(worst - results.begin())]);
            of_motion.seconds = seconds;
        }
    return runs;
}

} // namespace damslip
