#include "analysis/fragility/fragility_study.hpp"

#include "analysis/fragility/capacity_roots.hpp"
#include "analysis/fragility/hazard_file.hpp"
#include "analysis/fragility/shaking_suite.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/reducible.hpp"
#include "core/input_error.hpp"
#include "scene/effect_plan.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace damslip {

namespace {

constexpr std::uint32_t pilot_stream = 2; // of FragilitySizes: draws of their own

const SweepMethod& method_of_fragility(const std::string& given, const Records& records, const Scene& scene)
{
    const bool vertical =
        scene.motion.vertical &&
        std::any_of(records->begin(), records->end(), [](const RecordPair& p) { return p.vertical.has_value(); });
    const std::string id = given.empty() ? vertical ? "rigid-v" : "rigid" : given;
    const std::vector<std::string> known = sweep_methods();
    const bool there = std::find(known.begin(), known.end(), id) != known.end();
    const auto kind = there ? sweep_method(id).kind : SweepKind::regression;
    if (kind == SweepKind::regression || is_flexible(kind) || id == "fe-penalty")
        refuse_usage(fmt::format("--method {} is not one of a fragility.", id),
                     "rigid, rigid-v, rocking, fe, fe-exact, fe-slip-tolerance, fe-whole-steps, fe-goldgruber-2015, "
                     "fe-radiating, fe-massless, fe-reduced",
                     "write  --method rigid-v  or  --method fe");
    const SweepMethod& method = sweep_method(id);
    if (kind == SweepKind::rocking && scene.wedge)
        refuse_usage("--method rocking of a rock wedge.", "a block with a section",
                     "write  --method rigid-v  or leave --method out");
    if (method.reduced) check_reducible(called_for(make_effect_plan(scene, Method::finite_elements), scene));
    return method;
}

/// Limits that a run of the method gives.
void check_limits(const FragilityInput& input, const Scene& scene, const SweepMethod& method, const std::filesystem::path& file)
{
    if (const std::string& plane = input.limits.front().plane; plane != base_plane) {
        const std::vector<std::string> names = plane_names(scene);
        const auto refuse = [&](const std::string& problem, const std::string& expected, const char* fix) {
            throw InputError(Diagnostic{file.string(), 0, 0, problem, expected, fix});
        };
        if (method.kind != SweepKind::rigid && method.kind != SweepKind::rigid_vertical)
            refuse(fmt::format("limit.plane = \"{}\" by {}.", plane, method.id), "rigid or rigid-v: lifts and seams are rigid blocks",
                   "write  --method rigid-v , or delete plane");
        if (plane != any_plane && std::find(names.begin(), names.end(), plane) == names.end())
            refuse(fmt::format("limit.plane = \"{}\" names no plane of the scene.", plane),
                   fmt::format("{}, any", fmt::join(names, ", ")), "take one of these");
    }
    const bool full = method.kind == SweepKind::finite_elements && !method.reduced;
    for (const LimitInput& limit : input.limits) {
        if (is_of_slip(limit)) continue;
        if (!full)
            throw InputError(Diagnostic{
                file.string(), 0, 0, fmt::format("limit \"{}\" is not computed by {}.", limit.text, method.id),
                "a method that follows the base point by point: a rigid block has no opening before "
                "it lifts off whole, few modes keep no state after the earthquake",
                "write  --method fe , or limit.quantity = \"slip\""});
        if (input.intensity.design == FragilityDesign::cloud)
            throw InputError(Diagnostic{file.string(), 0, 0,
                                        fmt::format("limit \"{}\" with design = \"cloud\".", limit.text),
                                        "slip: the cloud is a regression of slips",
                                        "write  design = \"stripes\" , or limit.quantity = \"slip\""});
    }
}

/// The hazard curve, what was said of it added to the notes. @throws InputError for one of another measure, or that no level lies within
probability::HazardCurve hazard_of(const FragilityInput& input, const Scene& scene, std::vector<std::string>& notes)
{
    const IntensityInput& of = input.intensity;
    HazardWish wish{
        {of.measure, of.first_period, of.periods}, 0.0, of.level_unit, of.level_unit_text, input.hazard->site};
    if (of.first_period) wish.first_period = first_period_of(scene);
    HazardFile file = read_hazard_file(input.hazard->curve, wish);
    notes.insert(notes.end(), file.notes.begin(), file.notes.end());
    const std::vector<double>&x = file.curve.x(), &levels = of.levels;
    const bool apart = !levels.empty() && (levels.back() < x.front() || levels.front() > x.back());
    if (apart && of.design != FragilityDesign::cloud) {
        const auto range = [&](double from, double to) {
            return fmt::format("{:g} to {:g} {}", from / of.level_unit, to / of.level_unit, of.level_unit_text);
        };
        throw InputError(
            Diagnostic{input.hazard->curve.string(), 0, 0,
                       fmt::format("the hazard curve goes from {}, the levels from {}: no rate comes of them.",
                                   range(x.front(), x.back()), range(levels.front(), levels.back())),
                       "levels within the hazard curve, at least in part",
                       "change the levels of [intensity], or take a curve that reaches them"});
    }
    return std::move(file.curve);
}

/// The limit's level with P nearest to 0.1.
std::size_t level_near_a_tenth(const LimitEstimate& limit)
{
    const auto nearest =
        std::min_element(limit.levels.begin(), limit.levels.end(), [](const LevelEstimate& a, const LevelEstimate& b) {
            return std::abs(a.p - 0.1) < std::abs(b.p - 0.1);
        });
    return static_cast<std::size_t>(nearest - limit.levels.begin());
}

} // namespace

FragilityPlan FragilityStudy::plan(std::size_t samples, std::uint32_t stream) const
{
    return plan_fragility(input, suite, {samples, stream}, text.file(), written);
}

const SweepMethod& FragilityStudy::rigid() const
{
    return method_of_fragility("", suite.pairs, scene);
}

void check_fragility(const FragilityInput& input, const SceneText& text)
{
    check_supports(input, text, [&text](const std::string& key) { return text.written(key); });
}

FragilityStudy open_fragility(SceneText text, Scene scene, FragilityInput input, const std::string& method)
{
    check_fragility(input, text);
    ShakingSuite suite = suite_of_input(scene, input);
    const SweepMethod& of = method_of_fragility(method, suite.pairs, scene);
    check_limits(input, scene, of, text.file());
    const NumberInFile written = [text](const std::string& key) { return text.written(key); };
    std::optional<probability::HazardCurve> hazard;
    if (input.hazard) hazard = hazard_of(input, scene, suite.notes);
    return {std::move(text), std::move(scene), std::move(input), std::move(suite), of, written, std::move(hazard)};
}

void allow_any_scaling(FragilityInput& input)
{
    if (!input.suite) input.suite.emplace();
    input.suite->allow_scaling = true;
}

BudgetPilot pilot_of_budget(const FragilityStudy& study, double budget, int jobs, Watch& watch)
{
    const FragilityPlan plan = study.plan(1, pilot_stream);
    const std::size_t few = std::min<std::size_t>(plan.samples.size(), 2 * plan.levels);
    std::vector<std::size_t> wanted; // spread over levels and draws
    for (std::size_t i = 0; i < few; ++i) wanted.push_back(i * plan.samples.size() / few);
    const FragilityRuns runs = run_fragility(plan, study.text, study.method, wanted, nullptr, jobs, watch);
    BudgetPilot pilot;
    pilot.runs = runs.finished();
    pilot.seconds_per_run = runs.seconds / static_cast<double>(std::max<std::size_t>(1, pilot.runs));
    const double left = std::max(0.9 * budget, budget - runs.seconds);
    pilot.samples =
        static_cast<std::size_t>(std::max(1.0, left / (pilot.seconds_per_run * static_cast<double>(plan.levels))));
    return pilot;
}

std::optional<ConditionedPlan> condition_on_friction(const FragilityStudy& study, Conditioning asked,
                                                     std::size_t samples, int jobs, Watch& watch,
                                                     std::optional<double> aim)
{
    const FragilityInput& input = study.input;
    if (aim && (asked == Conditioning::off || !study.finite_elements()))
        refuse_usage(fmt::format("--aim-at {} where no runs are shared out among the levels.", *aim),
                     "finite elements whose friction is conditioned on: --method fe, without --conditioning off",
                     "leave out  --aim-at");
    if (asked == Conditioning::off) return std::nullopt;
    const std::string why_not = why_not_conditioned(input);
    if (asked == Conditioning::on && !why_not.empty())
        refuse_usage(fmt::format("--conditioning on: {}.", why_not),
                     "contact.friction drawn by a continuous law of its own, and stripes", "leave out  --conditioning");
    const auto& variables = input.probability.variables;
    const bool bands = std::any_of(variables.begin(), variables.end(),
                                   [](const RandomVariable& v) { return v.kind == VariableKind::epistemic; });
    if (asked == Conditioning::automatic && (!why_not.empty() || !study.finite_elements() || bands)) {
        if (aim)
            refuse_usage(fmt::format("--aim-at {}, but friction is not conditioned on{}{}.", *aim,
                                     why_not.empty() ? "" : ": ", why_not),
                         "contact.friction drawn by a continuous law of its own, stripes, no epistemic variable",
                         "leave out  --aim-at , or add  --conditioning on");
        return std::nullopt;
    }

    ConditioningSizes sizes;
    sizes.jobs = jobs;
    sizes.aim = aim;
    if (!study.finite_elements()) {
        const auto replicates = static_cast<std::size_t>(std::max(1, input.probability.replicates));
        sizes.motions = (samples + replicates - 1) / replicates;
        return condition_rigid(input, study.suite, study.text, study.written, study.method, sizes, watch);
    }
    const std::size_t all = samples * input.intensity.levels.size();
    sizes.pilot = std::max<std::size_t>(48, all / 10);
    sizes.runs = all > 2 * sizes.pilot ? all - sizes.pilot : all;
    if (study.hazard) sizes.weight_of_level = rate_of_levels(*study.hazard, input.intensity.levels);
    return condition_finite_elements(input, study.suite, study.text, study.written, study.rigid(), study.method, sizes,
                                     watch);
}

FragilityAnswer answer_fragility(const FragilityStudy& study, const FragilityPlan& plan, const FragilityRuns& runs,
                                 const FragilityExtras& extras, Watch& watch, const ConditionedPlan* conditioned)
{
    const FragilityInput& input = study.input;
    FragilityAnswer answer;
    answer.estimate = estimate_fragility(plan, runs, study.hazard ? &*study.hazard : nullptr,
                                         input.hazard ? input.hazard->all_events : std::nullopt, conditioned);
    answer.conditioned = conditioned;
    answer.notes = study.suite.notes;
    for (std::string& note : note_texts(not_honoured(study.text.scene(), methods_of({study.method}))))
        answer.notes.push_back(std::move(note));
    if (conditioned) answer.notes.insert(answer.notes.end(), conditioned->notes.begin(), conditioned->notes.end());
    if (runs.complete()) {
        capacities_by_roots(answer.estimate, plan, runs, study.text, study.method, extras.jobs);
        const bool cloud = input.intensity.design == FragilityDesign::cloud;
        if (!conditioned && !cloud)
            for (const LimitEstimate& limit : answer.estimate.limits)
                for (IntervalPoint& point : own_prefixes(plan, runs, limit.limit, level_near_a_tenth(limit)))
                    answer.own_cost.push_back(std::move(point));
        if (extras.rows > 0 && is_of_slip(input.limits.front()))
            answer.causes = fragility_causes(plan, answer.estimate, study.text, study.written, study.rigid(),
                                             extras.rows, extras.jobs, watch);
        for (const LimitInput& limit : input.limits)
            if (is_of_slip(limit) && limit.plane == base_plane)
                answer.needed_yields.emplace_back(limit, needed_yield(plan, study.text, limit.value));
    }
    for (const std::string& far : plan.scaled_far) answer.notes.push_back("scaled beyond suite.max_scale: " + far);
    for (const std::string& failure : runs.failures) answer.notes.push_back("not resolved: " + failure);
    for (const LimitEstimate& limit : answer.estimate.limits)
        for (const LevelEstimate& level : limit.levels)
            if (level.z < 0.0 || level.z > level.n)
                answer.notes.push_back(fmt::format("{} at {:.4g} {}: the estimate lies outside 0 ... 1 and is printed "
                                                   "clipped; the runs there are too few.",
                                                   limit.limit.text, level.x / input.intensity.level_unit,
                                                   input.intensity.level_unit_text));
    for (const LimitEstimate& limit : answer.estimate.limits)
        if (limit.missing_share() > 0.05) {
            answer.answered = false;
            answer.notes.push_back(fmt::format("{}: {:.1f} % of the runs have no answer; P lies between both bounds.",
                                               limit.limit.text, 100.0 * limit.missing_share()));
        }
    return answer;
}

} // namespace damslip
