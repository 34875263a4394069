#include "analysis/ablation/ablation_runs.hpp"

#include "analysis/prepare/seepage_source.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/processor_clock.hpp"
#include "core/status.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace damslip {

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
SceneRuns without_model(Status status, const std::string& why, std::size_t records)
{
    RecordOutcome none;
    none.status = status;
    none.message = why;
    SceneRuns runs;
    runs.records.assign(records, none);
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
            runs.scenes[i] = without_model(Status::not_resolved, error.diagnostic().problem, records->size());
        } catch (const Interrupted& stopped) { // in its set-up
            runs.scenes[i] = without_model(Status::interrupted, stopped.what(), records->size());
        }
        watch.results_at_hand();
        done(1.0);
    });
    watch.end();
    return runs;
}

} // namespace damslip
