#include "analysis/fragility/fragility_study.hpp"

#include "analysis/fragility/capacity_roots.hpp"
#include "analysis/fragility/hazard_file.hpp"
#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/record_list.hpp"
#include "analysis/prepare/reducible.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "records/measure/measures.hpp"
#include "records/read/header.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"
#include "scene/effect_plan.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

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
        if (method.kind != SweepKind::rigid && method.kind != SweepKind::rigid_vertical)
            refuse(file, fmt::format("limit.plane = \"{}\" by {}.", plane, method.id),
                   "rigid or rigid-v: lifts and seams are rigid blocks", "write  --method rigid-v , or delete plane");
        if (plane != any_plane && std::find(names.begin(), names.end(), plane) == names.end())
            refuse(file, fmt::format("limit.plane = \"{}\" names no plane of the scene.", plane),
                   fmt::format("{}, any", fmt::join(names, ", ")), "take one of these");
    }
    const bool full = method.kind == SweepKind::finite_elements && !method.reduced;
    for (const LimitInput& limit : input.limits) {
        if (is_of_slip(limit)) continue;
        if (!full)
            refuse(file, fmt::format("limit \"{}\" is not computed by {}.", limit.text, method.id),
                   "a method that follows the base point by point: a rigid block has no opening before "
                   "it lifts off whole, few modes keep no state after the earthquake",
                   "write  --method fe , or limit.quantity = \"slip\"");
        if (input.intensity.design == FragilityDesign::cloud)
            refuse(file, fmt::format("limit \"{}\" with design = \"cloud\".", limit.text),
                   "slip: the cloud is a regression of slips",
                   "write  design = \"stripes\" , or limit.quantity = \"slip\"");
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
        refuse(input.hazard->curve,
               fmt::format("the hazard curve goes from {}, the levels from {}: no rate comes of them.",
                           range(x.front(), x.back()), range(levels.front(), levels.back())),
               "levels within the hazard curve, at least in part",
               "change the levels of [intensity], or take a curve that reaches them");
    }
    return std::move(file.curve);
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
                for (IntervalPoint& point : own_prefixes(plan, runs, limit.limit, level_nearest(limit.levels, 0.1)))
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

double first_period_of(const Scene& scene)
{
    Scene with_modes = scene;
    with_modes.flexible_block.emplace();
    with_modes.flexible_block->of_modes = true;
    resolve_flexible_modes(with_modes);
    return with_modes.flexible_block->period.value();
}

namespace {

Record horizontal_of(const GroundMotion& motion)
{
    Record record;
    record.name = motion.name;
    record.dt = motion.dt;
    record.acceleration = motion.accel_h;
    return record;
}

/// The other horizontal component with the factor that the first one has.
Record other_horizontal(const RecordPair& pair, const Record& first)
{
    records::ReadOptions options;
    options.unit = pair.files.unit;
    options.dt = pair.files.dt;
    if (*pair.files.other_horizontal ==
        pair.files.horizontal) // of one file: the horizontal channel that is not the first
        for (const Record& channel :
             records::parse_record(read_file(pair.files.horizontal), pair.files.horizontal.string(), options))
            if (records::component_in(channel.source.component) == records::Component::horizontal &&
                channel.source.component != pair.horizontal.source.component)
                options.column = channel.source.component;
    const Record other = records::read_record(*pair.files.other_horizontal, options);
    const double read = records::measure(pair.horizontal).pga;
    return records::scaled(other, read > 0.0 ? records::measure(first).pga / read : 1.0);
}

/// Intensity of one horizontal component as it shakes the dam [SI]. @param first_period  T_1 of the dam [s], for SA(T1)
/// @param index  asked first; what it lacks is added
double intensity_of(const Record& horizontal, const IntensityInput& intensity, double first_period,
                    records::SuiteIndex& index)
{
    const auto spectral = [&](std::span<const double> periods) {
        double sum = 0.0;
        for (const double value : index.spectrum(horizontal, periods)) sum += std::log(value);
        return std::exp(sum / static_cast<double>(periods.size()));
    };
    switch (intensity.measure) {
    case IntensityMeasure::sa:
        if (intensity.first_period) return spectral({&first_period, 1});
        return spectral(intensity.periods);
    case IntensityMeasure::avg_sa:
        return spectral(intensity.periods);
    case IntensityMeasure::pga:
        return index.measures(horizontal).pga;
    case IntensityMeasure::pgv:
        return index.measures(horizontal).pgv;
    case IntensityMeasure::arias:
        return index.measures(horizontal).arias_intensity;
    case IntensityMeasure::cav:
        break;
    }
    return index.measures(horizontal).cumulative_velocity;
}

} // namespace

ShakingSuite suite_of_input(const Scene& scene, const FragilityInput& input)
{
    Scene of = scene;
    RecordList files;
    std::filesystem::path index; // of the scene's own records none: few, and a folder may hold others
    if (input.suite && !input.suite->files.empty()) {
        files = record_list(input.suite->files);
        index = files.folder;
        of.motion.records = files.records;
        of.motion.sequence.clear();
    }
    if (of.motion.records.empty())
        throw InputError(Diagnostic{scene.file.string(), static_cast<int>(input.suite ? input.suite->where.line : 0), 0,
                                    input.suite && !input.suite->files.empty()
                                        ? fmt::format("suite.files = \"{}\" names no record.", input.suite->files)
                                        : std::string("there is no record."),
                                    "a folder, a pattern or a list of records that are there, or [[motion.record]]",
                                    "make or fetch the records first, or correct the path:  files = \"suite/*.AT2\""});
    const IntensityInput& intensity = input.intensity;
    records::SuiteIndex measures(index);
    ShakingSuite suite;
    suite.pairs = load_records(of, Method::rigid_block);
    suite.event = std::move(files.events);
    suite.weight = std::move(files.weights);
    suite.made = files.made;
    suite.notes = files.notes;
    suite.power = power_of_scale(intensity.measure);
    const Ready ready = prepare(of, Method::rigid_block, suite.pairs);
    const double period = intensity.first_period ? first_period_of(of) : 0.0;
    std::map<std::string, std::string> seen; // checksum to name
    const bool events = !suite.event.empty(), weights = !suite.weight.empty();
    const bool both = intensity.component == IntensityComponent::geomean;
    std::size_t alone = 0;
    for (const RecordPair& pair : *suite.pairs) {
        const std::string& name = pair.files.name;
        if (!events) suite.event.push_back(name);
        if (!weights) suite.weight.push_back(1.0);
        const Record horizontal = horizontal_of(ready.motion(pair));
        suite.intensity.push_back(intensity_of(horizontal, intensity, period, measures));
        if (both && pair.files.other_horizontal)
            suite.intensity.back() = std::sqrt(
                suite.intensity.back() * intensity_of(other_horizontal(pair, horizontal), intensity, period, measures));
        else if (both)
            ++alone;
        if (!(suite.intensity.back() > 0.0))
            refuse(pair.files.horizontal, fmt::format("{} of this record is 0.", intensity.text),
                   "a record that shakes", "leave it out");
        const std::string& sum = pair.horizontal.source.sha256;
        if (const auto [at, fresh] = seen.emplace(sum + " " + pair.files.column, name); !sum.empty() && !fresh)
            refuse(pair.files.horizontal, fmt::format("the records \"{}\" and \"{}\" are the same.", at->second, name),
                   "each record once; how often one is met is its weight", "leave one out");
    }
    if (both)
        suite.notes.push_back(fmt::format(
            "{} is the geometric mean of both horizontal components{}.", intensity.text,
            alone == 0 ? ""
                       : fmt::format("; of {} of {} records that of the one there is", alone, suite.pairs->size())));
    measures.keep();
    return suite;
}

} // namespace damslip
