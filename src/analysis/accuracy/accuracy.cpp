#include "analysis/accuracy/accuracy.hpp"

#include "analysis/accuracy/hierarchy.hpp"
#include "analysis/fe/mesh_error.hpp"
#include "core/parallel.hpp"
#include "scene/joint_bond.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip {

Accuracy measure_accuracy(const Scene& scene, double tolerance, Effort effort, const Watch& watch)
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    Records records = load_records(scene, Method::finite_elements);
    const ModelLevelRunner runner(scene, std::move(records), clock.seconds(), watch);
    HierarchyRunOptions options;
    options.hierarchy = {effort, tolerance};
    HierarchyCalls calls;
    calls.run = [&](const ModelLevel& model_level) { return runner.run(model_level); };
    calls.interrupted = watch.stop();
    Accuracy accuracy{run_hierarchy(runner.facts(), options, calls), {}};
    accuracy.judgement = judge_model_levels(accuracy.model_levels, tolerance);
    return accuracy;
}

namespace {

void set_element(std::string_view word, Scene& scene)
{
    if (word == "q8") scene.mesh.element = ElementKind::q8;
    if (word == "q9") scene.mesh.element = ElementKind::q9;
    if (word == "t6") scene.mesh.element = ElementKind::t6;
}

void set_water(ModelLevelWater water, Scene& scene)
{
    using enum ReservoirModel;
    constexpr ReservoirModel models[] = {hydrostatic, added_mass, acoustic}; // of ModelLevelWater after `dry`
    if (scene.reservoir && water != ModelLevelWater::dry) scene.reservoir->model = models[static_cast<std::size_t>(water) - 1];
}

} // namespace

Scene scene_of(const Scene& given, const ModelLevel& model_level)
{
    Scene scene = given;
    if (model_level.family == ModelLevelFamily::regression) return scene;
    if (model_level.family == ModelLevelFamily::rigid) {
        scene.sliding.scheme = model_level.scheme == RigidScheme::slammer ? SlidingScheme::slammer : SlidingScheme::exact;
        if (model_level.components == Components::horizontal) scene.motion.vertical = false;
        return scene;
    }
    set_water(model_level.water, scene);
    if (model_level.step == StepChoice::as_the_scene) return scene;
    scene = with_exact_contact(scene).value_or(scene);
    scene.time.substeps.reset();
    scene.time.stepping = model_level.step == StepChoice::adaptive ? Stepping::adaptive : Stepping::automatic;
    if (model_level.step == StepChoice::fixed) scene.time.substeps = model_level.halvings;
    if (model_level.mesh != 1.0) scale_mesh(model_level.mesh, scene);
    set_element(model_level.element, scene);
    if (model_level.tangential_stiffness) {
        scene.contact.enforcement = ContactEnforcement::penalty;
        scene.contact.tangential_stiffness = model_level.tangential_stiffness;
    }
    if (const OtherModel* other = find_other_model(model_level.other_model)) scene = other->change(scene);
    if (scene.foundation) scene.foundation->wave_box *= model_level.wave_box;
    if (model_level.alpha) {
        scene.time.scheme = TimeScheme::hht;
        scene.time.alpha = *model_level.alpha;
    }
    return scene;
}

namespace {

/// The finest row and the column of meshes, which cross.
struct Cross {
    std::vector<const ModelLevelResult*> row, column;
    const ModelLevelResult* corner = nullptr; ///< of the column, on the row's mesh; null: there is no column

    Cross(const std::vector<ModelLevelResult>& results, ModelLevelWater water)
        : row(fine_row(results, water)), column(mesh_column(results, water))
    {
        if (column.size() < 2 || row.empty()) return;
        for (const ModelLevelResult* r : column)
            if (r->model_level.mesh == row.front()->model_level.mesh) corner = r;
    }
};

/// The step's limit on the finest mesh that has a row, plus what the mesh still changes at the column's step.
std::optional<ModelLimit> limit_of(const std::vector<ModelLevelResult>& results, ModelLevelWater water, std::size_t motions)
{
    const Cross cross(results, water);
    ModelLimit limit;
    for (std::size_t motion = 0; motion < motions; ++motion) {
        const auto order = observed_order(slips_of(step_row(results, water), motion));
        const auto step = extrapolated(slips_of(cross.row, motion), 2.0, order);
        if (!step) return std::nullopt;
        limit.model = model_of(cross.row.front()->model_level);
        limit.slip.push_back(step->value);
        limit.open.push_back(0.5 * std::abs(step->correction));
        if (!cross.corner) continue;
        const auto mesh = extrapolated(slips_of(cross.column, motion));
        limit.slip.back() += mesh->value - cross.corner->slip(motion);
        limit.open.back() += 0.5 * std::abs(mesh->correction);
        limit.mesh_known = true;
    }
    return limit;
}

/// Errors against the plain model level with the same step, in the order of `size`, which falls.
template <class Size>
std::optional<double> order_of_variants(const std::vector<ModelLevelResult>& results, ModelLevelWater water, std::size_t motion,
                                        double ratio, Size&& size)
{
    std::vector<std::pair<double, double>> errors; // size, slip - exact
    for (const ModelLevelResult& r : results) {
        if (!r.done() || r.model_level.family != ModelLevelFamily::finite_elements || r.model_level.water != water || !size(r.model_level))
            continue;
        ModelLevel plain = r.model_level;
        plain.modes.reset();
        plain.tangential_stiffness.reset();
        for (const ModelLevelResult& p : results)
            if (p.done() && p.model_level == plain) errors.emplace_back(*size(r.model_level), r.slip(motion) - p.slip(motion));
    }
    std::sort(errors.begin(), errors.end());
    std::vector<double> falling;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const bool apart =
            i + 1 == errors.size() || std::abs(errors[i + 1].first / errors[i].first / ratio - 1.0) < 1e-9;
        if (apart) falling.push_back(errors[i].second);
    }
    return order_of_errors(falling, ratio);
}

void add_orders(const std::vector<ModelLevelResult>& results, ModelLevelWater water, std::size_t motion, ModelLimit& limit)
{
    const Cross cross(results, water);
    const auto row = cross.row.size() > 2 ? cross.row : step_row(results, water);
    limit.order_step = observed_order(slips_of(row, motion));
    if (cross.corner) limit.order_mesh = observed_order(slips_of(cross.column, motion));
    limit.order_penalty =
        order_of_variants(results, water, motion, 10.0, [](const ModelLevel& r) { return r.tangential_stiffness; });
    limit.order_modes = order_of_variants(results, water, motion, 2.0, [](const ModelLevel& r) {
        return r.modes ? std::optional<double>(*r.modes) : std::nullopt;
    });
}

const ModelLimit* find(const std::vector<ModelLimit>& models, const ModelLevel& model_level)
{
    const std::string model = model_of(model_level);
    const auto at = std::find_if(models.begin(), models.end(), [&](const ModelLimit& m) { return m.model == model; });
    return at == models.end() ? nullptr : &*at;
}

/// Estimate for one motion; nothing where the model has no limit.
std::optional<double> error_of(const ModelLevelResult& r, const ModelLimit* limit, std::size_t motion)
{
    if (r.model_level.family == ModelLevelFamily::rigid && r.model_level.scheme != RigidScheme::slammer)
        return 0.0; // events located exactly
    if (!limit) return std::nullopt;
    return std::max(std::abs(r.slip(motion) - limit->slip[motion]), limit->open[motion]);
}

void judge_model_level(const ModelLevelResult& r, const ModelLevelResult& top, const ModelLimit* limit, const ModelLimit* top_limit,
                std::size_t shown, ModelLevelVerdict& verdict)
{
    verdict.error = error_of(r, limit, shown);
    const double own = limit ? limit->slip[shown] : r.slip(shown);
    verdict.model_difference = own - (top_limit ? top_limit->slip[shown] : top.slip(shown));
    verdict.off_top = r.slip(shown) - top.slip(shown);
    double deviation = 0.0;
    for (std::size_t motion = 0; motion < r.motions.size(); ++motion) {
        const auto open = error_of(top, top_limit, motion);
        if (!open) return;
        const double size = std::max(std::abs(top.slip(motion)), least_slip);
        deviation = std::max(deviation, (std::abs(r.slip(motion) - top.slip(motion)) + *open) / size);
    }
    verdict.deviation = deviation;
}

/// The exact scheme's slip is the limit of SLAMMER's.
void add_rigid_limits(const std::vector<ModelLevelResult>& results, std::vector<ModelLimit>& models)
{
    for (const ModelLevelResult& r : results)
        if (r.done() && r.model_level.family == ModelLevelFamily::rigid && r.model_level.scheme != RigidScheme::slammer) {
            ModelLimit limit;
            limit.model = model_of(r.model_level);
            for (const MotionOutcome& o : r.motions) limit.slip.push_back(*o.slip);
            limit.open.assign(r.motions.size(), 0.0);
            models.push_back(std::move(limit));
        }
}

} // namespace

Judgement judge_model_levels(const std::vector<ModelLevelResult>& results, double tolerance)
{
    Judgement j;
    j.model_levels.resize(results.size());
    j.top = top_model_level(results);
    if (!j.top) return j;
    const ModelLevelResult& top = results[*j.top];
    for (std::size_t motion = 0; motion < top.motions.size(); ++motion)
        if (std::abs(top.slip(motion)) > std::abs(top.slip(j.motion))) j.motion = motion;
    add_rigid_limits(results, j.models);
    for (const ModelLevelWater water : {ModelLevelWater::dry, ModelLevelWater::hydrostatic, ModelLevelWater::added_mass, ModelLevelWater::acoustic})
        if (auto limit = limit_of(results, water, top.motions.size())) {
            add_orders(results, water, j.motion, *limit);
            j.models.push_back(std::move(*limit));
        }
    const ModelLimit* top_limit = find(j.models, top.model_level);
    std::vector<double> seconds;
    std::vector<std::optional<double>> deviation;
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (results[i].done())
            judge_model_level(results[i], top, find(j.models, results[i].model_level), top_limit, j.motion, j.model_levels[i]);
        seconds.push_back(results[i].seconds);
        deviation.push_back(j.model_levels[i].deviation);
    }
    j.top_error = j.model_levels[*j.top].deviation;
    for (std::size_t i = 0; i < results.size(); ++i)
        if (results[i].ran() && !results[i].done() && results[i].model_level.plain() && below(top.model_level, results[i].model_level))
            j.contradiction = i;
    if (!j.contradiction) j.choice = cheapest_within(seconds, deviation, tolerance);
    const std::vector<bool> front = pareto_front(seconds, deviation);
    for (std::size_t i = 0; i < results.size(); ++i) j.model_levels[i].front = front[i];
    return j;
}

std::optional<std::size_t> cheapest_within(std::span<const double> seconds,
                                           std::span<const std::optional<double>> deviation, double tolerance)
{
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < seconds.size(); ++i)
        if (deviation[i] && *deviation[i] <= tolerance && (!best || seconds[i] < seconds[*best])) best = i;
    return best;
}

std::vector<bool> pareto_front(std::span<const double> seconds, std::span<const std::optional<double>> deviation)
{
    std::vector<bool> front(seconds.size(), false);
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        if (!deviation[i]) continue;
        front[i] = true;
        for (std::size_t k = 0; k < seconds.size(); ++k)
            if (deviation[k] && seconds[k] <= seconds[i] && *deviation[k] <= *deviation[i] &&
                (seconds[k] < seconds[i] || *deviation[k] < *deviation[i]))
                front[i] = false;
    }
    return front;
}

std::optional<double> observed_order(std::span<const double> values, double ratio)
{
    if (values.size() < 3) return std::nullopt;
    const auto last = values.last(3);
    const double differences[] = {last[1] - last[0], last[2] - last[1]};
    return order_of_errors(differences, ratio);
}

std::optional<double> order_of_errors(std::span<const double> errors, double ratio)
{
    assert(ratio > 1.0);
    if (errors.size() < 2) return std::nullopt;
    const double before = std::abs(errors[errors.size() - 2]), now = std::abs(errors.back());
    if (!(before > 0.0 && now > 0.0)) return std::nullopt;
    return std::log(before / now) / std::log(ratio);
}

std::optional<Limit> extrapolated(std::span<const double> values, double ratio, const std::optional<double>& elsewhere)
{
    if (values.size() < 2) return std::nullopt;
    const double difference = values.back() - values[values.size() - 2];
    Limit limit;
    limit.order = observed_order(values, ratio);
    const std::optional<double> shown = values.size() > 2 ? limit.order : elsewhere;
    const double order = std::clamp(shown.value_or(least_order), least_order, largest_order);
    limit.correction = difference / (std::pow(ratio, order) - 1.0);
    limit.value = values.back() + limit.correction;
    return limit;
}

} // namespace damslip
