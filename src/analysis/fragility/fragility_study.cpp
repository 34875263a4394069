#include "analysis/fragility/fragility_study.hpp"

#include "analysis/fragility/capacity_roots.hpp"
#include "analysis/fragility/fragility_estimate.hpp"
#include "analysis/fragility/hazard_file.hpp"
#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/record_list.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "records/measure/measures.hpp"
#include "records/read/header.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"
#include "scene/effect_plan.hpp"
#include "scene/plausible.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace damslip {

namespace {

bool all_kept(const FragilitySample&, std::size_t)
{
    return true;
}

/// The estimate of one level from its first samples, as long as they are kept.
IntervalPoint point_of(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit, std::size_t level,
                       std::size_t replicates, const std::string& estimator,
                       const std::function<bool(const FragilitySample&, std::size_t place)>& kept)
{
    IntervalPoint point;
    point.estimator = estimator;
    const LevelEstimate e =
        estimate_first(plan, runs, limit, level, replicates, [&](const FragilitySample& s, std::size_t place) {
            const bool counts = kept(s, place);
            point.runs += counts;
            return counts;
        });
    point.seconds = runs.seconds * (static_cast<double>(point.runs) / static_cast<double>(plan.samples.size()));
    point.p = e.p;
    point.interval = e.sampling;
    if (e.n <= 0.0) point.remark = "no draw stands without an earthquake";
    return point;
}

/// The estimates of one scene at one level.
class IntervalCosts {
public:
    IntervalCosts(FragilityInput input, const ShakingSuite& suite, const SceneText& text, const NumberInFile& written,
                  const IntervalCostOptions& options, Watch& watch)
        : input_(std::move(input)), suite_(suite), text_(text), written_(written), options_(options), watch_(watch)
    {
    }

    std::vector<IntervalPoint> all()
    {
        plain();
        for (const auto& [sampling, name] :
             {std::pair{SamplingInput::latin_hypercube, "Latin hypercube"}, {SamplingInput::sobol, "Sobol'"}})
            for (const std::size_t n : sizes()) points_.push_back(replicated(sampling, name, n));
        compare_with_plain(points_);
        return std::move(points_);
    }

private:
    std::vector<std::size_t> sizes() const
    {
        std::vector<std::size_t> sizes;
        std::size_t n = options_.runs;
        for (std::size_t i = 0; i < options_.sizes && n >= 8; ++i, n /= options_.step) sizes.push_back(n);
        std::reverse(sizes.begin(), sizes.end());
        return sizes;
    }
    FragilityPlan plan_of(SamplingInput sampling, std::size_t samples, std::uint32_t stream) const
    {
        FragilityInput input = input_;
        input.probability.sampling = sampling;
        input.probability.replicates =
            sampling == SamplingInput::random ? 1 : static_cast<int>(std::min(options_.replicates, samples / 2));
        return plan_fragility(input, suite_, {samples, stream}, text_.file(), written_);
    }
    /// Processor time is read by the process' own clock, so that set-ups count. Short ones are run three times, the fastest counts.
    FragilityRuns run(const FragilityPlan& plan, const std::string& method)
    {
        constexpr double short_run = 0.3; // [s]
        FragilityRuns best;
        for (int repeat = 0; repeat < 3; ++repeat) {
            FragilityRuns runs =
                run_fragility(plan, text_, sweep_method(method), wanted_samples(plan), nullptr, options_.jobs, watch_);
            spent_ += runs.seconds;
            if (repeat == 0 || runs.seconds < best.seconds) best = std::move(runs);
            if (best.seconds > short_run) break;
        }
        return best;
    }
    bool stopped(IntervalPoint& point)
    {
        if (watch_.stop_asked()) point.remark = "interrupted";
        return watch_.stop_asked();
    }
    /// Whether so many runs still fit into the budget.
    bool too_dear(std::size_t runs, IntervalPoint& point)
    {
        point.runs = runs;
        const double expected = per_run_ * static_cast<double>(runs);
        if (spent_ + expected <= options_.budget) return false;
        point.remark = fmt::format("left out: {:.3g} s expected, {:.3g} s of the budget are left", expected,
                                   std::max(0.0, options_.budget - spent_));
        return true;
    }

    void plain()
    {
        std::vector<std::size_t> wanted = sizes();
        // A small run first where its price is not known, so that the budget holds.
        IntervalPoint none;
        none.estimator = "plain";
        {
            const FragilityPlan few = plan_of(SamplingInput::random, wanted.front(), 5);
            const FragilityRuns runs = run_fragility(few, text_, sweep_method(options_.method), wanted_samples(few),
                                                     nullptr, options_.jobs, watch_);
            spent_ += runs.seconds;
            per_run_ = runs.seconds / static_cast<double>(few.samples.size());
        }
        while (!wanted.empty() && too_dear(wanted.back(), none)) {
            left_out_.insert(left_out_.begin(), none);
            wanted.pop_back();
        }
        if (!wanted.empty()) {
            const FragilityPlan longest = plan_of(SamplingInput::random, wanted.back(), 0);
            const FragilityRuns runs = run(longest, options_.method);
            if (runs.complete()) per_run_ = runs.seconds / static_cast<double>(longest.samples.size());
            for (const std::size_t n : wanted) {
                if (options_.method == options_.rigid && n < wanted.back()) { // cheap enough to be run by itself
                    points_.push_back(replicated(SamplingInput::random, "plain", n));
                    continue;
                }
                IntervalPoint point =
                    point_of(longest, runs, longest.input.limits.front(), 0, longest.replicates, "plain",
                             [n](const FragilitySample&, std::size_t place) { return place < n; });
                if (!runs.complete()) point.remark = "interrupted";
                points_.push_back(std::move(point));
            }
        }
        points_.insert(points_.end(), left_out_.begin(), left_out_.end());
    }
    IntervalPoint replicated(SamplingInput sampling, const std::string& name, std::size_t n)
    {
        IntervalPoint point;
        point.estimator = name;
        if (stopped(point) || too_dear(n, point)) return point;
        const FragilityPlan plan = plan_of(sampling, n, 0);
        const FragilityRuns runs = run(plan, options_.method);
        if (stopped(point)) return point;
        return point_of(plan, runs, plan.input.limits.front(), 0, plan.replicates, name, all_kept);
    }

    FragilityInput input_;
    const ShakingSuite& suite_;
    const SceneText& text_;
    const NumberInFile& written_;
    const IntervalCostOptions& options_;
    Watch& watch_;
    double spent_ = 0.0, per_run_ = 0.0; ///< processor time so far; of a run
    std::vector<IntervalPoint> points_, left_out_;
};

/// Where P is nearest to 0.1 by the rigid block, 256 random draws a level.
double level_near_a_tenth(const FragilityInput& input, const ShakingSuite& suite, const SceneText& text,
                          const NumberInFile& written, const IntervalCostOptions& options, Watch& watch)
{
    constexpr std::size_t draws = 256;
    FragilityInput random = input;
    random.probability.sampling = SamplingInput::random;
    random.probability.replicates = 1;
    const FragilityPlan plan = plan_fragility(random, suite, {draws, 6}, text.file(), written);
    const FragilityRuns runs =
        run_fragility(plan, text, sweep_method(options.rigid), wanted_samples(plan), nullptr, options.jobs, watch);
    const FragilityEstimate estimate = estimate_fragility(plan, runs, nullptr, {});
    const std::vector<LevelEstimate>& levels = estimate.limits.front().levels;
    return levels[level_nearest(levels, 0.1)].x;
}

} // namespace

void compare_with_plain(std::vector<IntervalPoint>& points)
{
    const IntervalPoint* plain = nullptr;
    for (const IntervalPoint& point : points)
        if (point.estimator == "plain" && point.done() && (!plain || point.runs > plain->runs)) plain = &point;
    if (!plain) return;
    const double price = plain->seconds * std::pow(plain->interval.half_width(), 2); // of half-width 1 [s]
    for (IntervalPoint& point : points) {
        const double half = point.interval.half_width();
        if (point.estimator != "plain" && point.done() && half > 0.0 && point.seconds > 0.0)
            point.gain = price / (point.seconds * half * half);
    }
}

IntervalCost interval_cost(const FragilityInput& given, const ShakingSuite& suite, const SceneText& text,
                           const NumberInFile& written, const IntervalCostOptions& options, Watch& watch)
{
    if (given.probability.variables.empty())
        refuse(text.file(), "nothing is drawn: the scene has no [[probability.variable]].",
               "a variable at least: of records alone P is exact", "add a [[probability.variable]]");
    FragilityInput input = given;
    input.limits.resize(1);
    input.intensity.design = FragilityDesign::stripes;
    input.probability.samples.reset();
    for (RandomVariable& v : input.probability.variables) v.kind = VariableKind::aleatory;
    IntervalCost cost;
    cost.limit = input.limits.front();
    cost.method = options.method;
    cost.level = options.level ? *options.level : level_near_a_tenth(input, suite, text, written, options, watch);
    input.intensity.levels = {cost.level};
    cost.points = IntervalCosts(input, suite, text, written, options, watch).all();
    return cost;
}

std::vector<IntervalPoint> own_prefixes(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit,
                                        std::size_t level)
{
    std::vector<IntervalPoint> points;
    if (plan.input.intensity.design == FragilityDesign::cloud || (plan.whole_suite && !plan.epistemic)) return points;
    const bool independent = plan.input.probability.sampling == SamplingInput::random && !plan.epistemic;
    const std::size_t at_level = plan.samples.size() / plan.levels;
    const std::size_t all = independent ? at_level : plan.replicates, least = independent ? 16 : 2;
    for (std::size_t n = all; n >= least; n /= 2)
        points.push_back(point_of(
            plan, runs, limit, level, independent ? plan.replicates : n, limit.text,
            [&](const FragilitySample& s, std::size_t place) { return independent ? place < n : s.replicate < n; }));
    std::reverse(points.begin(), points.end());
    return points;
}

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
    if (study.hazard && input.intensity.design == FragilityDesign::cloud)
        answer.notes.push_back("no rate per year: rates are made of the P of stripes; write  design = \"stripes\"  in [intensity].");
    if (conditioned && static_cast<double>(conditioned->exceptions) > 0.05 * static_cast<double>(conditioned->motions))
        answer.answered = false;
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
