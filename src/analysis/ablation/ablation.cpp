#include "analysis/ablation/ablation.hpp"

#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>
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
            ablations.removals.push_back(
                {e.effect, e.name, removal->instead, row.whole(plan), std::move(removal->scene)});
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

namespace {

Ready ready_for(const AblationPlan& plan, const Scene& scene, const Records& records, const Watch& watch)
{
    const bool finite_elements = plan.method == Method::finite_elements; // rigid blocks know [lifts] as planes
    return prepare(scene, plan.method, records, {.joints_of_lifts = finite_elements, .stop = watch.stop()});
}

/// The step of the full scene at its own accuracy, dt/8 at least; or that of time.substeps.
AblationStep choose_step(const Ready& full, const Watch& watch)
{
    constexpr int least_halvings = 3; // the full scene may do with longer ones, but simpler scenes slip more, or less damped
    AblationStep step;
    step.chosen = !full.scene.time.substeps;
    double dt = 0.0;
    for (const RecordPair& pair : full.records()) dt = std::max(dt, full.scene.time.dt.value_or(full.motion(pair).dt));
    step.halvings = full.scene.time.substeps.value_or(0);
    if (step.chosen)
        for (const MotionOutcome& o : run_variant(full, {}, watch).motions) {
            step.halvings = std::max({step.halvings, least_halvings, o.halvings});
            step.missed = step.missed || o.status == Status::tolerance_missed;
        }
    step.other = step.halvings > 0 ? step.halvings - 1 : 1;
    step.largest_dt = dt / std::exp2(step.halvings);
    return step;
}

/// @param done  called with how much of the scene's runs is done, 0 ... 1
VariantRuns run_at(int halvings, Ready ready, const std::function<void(double)>& done, const Watch& watch)
{
    ready.scene.time.substeps = halvings;
    return run_variant(ready, {.done = done}, watch);
}

} // namespace

AblationRuns run_ablations(const AblationPlan& plan, const Records& records, int jobs, Watch& watch)
{
    const std::vector<const Scene*> scenes = scenes_of(plan);
    AblationRuns runs;
    runs.motions = motion_names(plan.full, *records);
    runs.jobs = thread_count(jobs);
    runs.scenes.resize(scenes.size());
    runs.other_step.resize(scenes.size());
    if (plan.method == Method::finite_elements)
        runs.step = choose_step(ready_for(plan, plan.full, records, watch), watch);
    const double first_share = runs.step ? 1.0 / (1.0 + std::exp2(runs.step->other - runs.step->halvings)) : 1.0;
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
            const Ready ready = ready_for(plan, *scenes[i], records, watch);
            const double seconds = clock.seconds();
            if (runs.step) {
                runs.scenes[i] = run_at(runs.step->halvings, ready, [&](double s) { done(first_share * s); }, watch);
                runs.scenes[i].set_up_seconds += seconds; // of a dam's own period
                runs.other_step[i] = run_at(
                    runs.step->other, ready, [&](double s) { done(first_share + (1.0 - first_share) * s); }, watch);
            } else
                runs.scenes[i] = run_variant(ready, {.all_planes = true, .repetitions = 5}, watch);
        } catch (const NotConverged& error) {
            runs.scenes[i] = without_model(Status::not_resolved, error.diagnostic().problem, runs.motions);
        } catch (const Interrupted& stopped) { // in its set-up
            if (runs.scenes[i].motions.empty())
                runs.scenes[i] = without_model(Status::interrupted, stopped.what(), runs.motions);
        }
        watch.results_at_hand();
        done(1.0);
    });
    watch.end();
    return runs;
}

namespace {

std::string remark_of(const AblationRow& row, const MotionOutcome& full, const MotionOutcome& own)
{
    if (!own.slip && !own.message.empty()) return own.reason();
    if (!full.slip && own.slip) return "the full scene has no slip to compare with";
    if (row.still_sliding) return "still sliding after the run-out: a lower bound";
    if (row.within_step_error) return "within the step error";
    return "";
}

/// The slip with AblationStep::other; empty where the one with AblationStep::halvings is.
std::optional<double> slip_at_other_step(const AblationRuns& runs, std::size_t scene, std::size_t motion)
{
    const bool both = runs.scenes[scene].motions[motion].slip && motion < runs.other_step[scene].motions.size();
    return both ? runs.other_step[scene].motions[motion].slip : std::nullopt;
}

AblationRow row_of(const std::string& name, const AblationRuns& runs, std::size_t scene, std::size_t motion)
{
    const MotionOutcome &full = runs.scenes.front().motions[motion], &own = runs.scenes[scene].motions[motion];
    const bool is_full = scene == 0;
    AblationRow row{runs.motions[motion], name, word(own.status)};
    row.still_sliding = own.still_sliding;
    row.slip = change_from(full.slip, own.slip);
    row.crest = change_from(full.crest, own.crest);
    for (std::size_t k = 0; k < full.lift_slips.size(); ++k)
        row.lifts.push_back(change_from(full.lift_slips[k],
                                        k < own.lift_slips.size() ? std::optional(own.lift_slips[k]) : std::nullopt));
    if (const std::optional<double> other = slip_at_other_step(runs, scene, motion)) {
        row.slip_error = difference_error(*runs.step, *own.slip, *other);
        if (const std::optional<double> full_other = slip_at_other_step(runs, 0, motion)) {
            row.change_error = difference_error(*runs.step, *own.slip - *full.slip, *other - *full_other);
            row.within_step_error =
                !is_full && *row.slip.change != 0.0 && std::abs(*row.slip.change) <= *row.change_error;
        }
    }
    row.remark = remark_of(row, full, own);
    if (is_full) {
        row.slip.change.reset();
        row.slip.percent.reset();
        row.crest.change.reset();
        row.crest.percent.reset();
        row.change_error.reset();
        for (Change& lift : row.lifts) lift.change.reset(), lift.percent.reset();
    }
    return row;
}

} // namespace

Change change_from(const std::optional<double>& full, const std::optional<double>& value)
{
    Change c{value, {}, {}};
    if (!full || !value) return c;
    c.change = *value - *full;
    if (*full != 0.0) c.percent = 100.0 * *c.change / std::abs(*full);
    return c;
}

std::vector<std::string> scene_names(const AblationPlan& plan)
{
    std::vector<std::string> names{full_name};
    for (const Ablation& a : plan.removals) names.push_back(a.name);
    if (plan.simplest) names.emplace_back(simplest_name);
    return names;
}

std::vector<AblationRow> rows_of(const AblationPlan& plan, const AblationRuns& runs, std::size_t motion)
{
    const std::vector<std::string> names = scene_names(plan);
    std::vector<AblationRow> rows;
    for (std::size_t i = 0; i < runs.scenes.size(); ++i) rows.push_back(row_of(names[i], runs, i, motion));
    return rows;
}

std::optional<double> sum_of_changes(const AblationPlan& plan, const std::vector<AblationRow>& rows)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < plan.removals.size(); ++i) {
        if (plan.removals[i].part_of) continue;
        const std::optional<double>& change = rows[i + 1].slip.change;
        if (!change || rows[i + 1].still_sliding) return std::nullopt;
        sum += *change;
    }
    return sum;
}

std::optional<double> saved_seconds(const VariantRuns& full, const VariantRuns& own)
{
    const auto whole = [](const VariantRuns& s) {
        return std::all_of(s.motions.begin(), s.motions.end(), [](const MotionOutcome& r) { return r.slip; });
    };
    if (!whole(full) || !whole(own)) return std::nullopt;
    return full.all_seconds() - own.all_seconds();
}

} // namespace damslip
