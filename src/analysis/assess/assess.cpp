#include "analysis/assess/assess.hpp"

#include "analysis/fe/mesh_error.hpp"
#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "core/input_error.hpp"
#include "scene/rock_mass.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace damslip {

namespace {

constexpr double stiffer = 1e3; ///< factor on the dam's modulus of a dam that is rigid in all but name [-]

std::string why_ended(const BudgetWatch& watch)
{
    return watch.interrupted() ? "interrupted" : "the time was over";
}

/// Runs a part; what it cannot do is left out with its reason.
void try_part(const std::string& what, const BudgetWatch& watch, std::vector<LeftOut>& left_out,
              const std::function<void()>& part)
{
    try {
        part();
    } catch (const InputError& e) {
        left_out.push_back({what, e.diagnostics().empty() ? e.what() : e.diagnostics().front().problem});
    } catch (const NotConverged& e) {
        left_out.push_back({what, e.diagnostic().problem});
    } catch (const Interrupted&) {
        left_out.push_back({what, why_ended(watch)});
    }
}

/// The same while there is time.
void try_in_time(const std::string& what, const BudgetWatch& watch, std::vector<LeftOut>& left_out,
                 const std::function<void()>& part)
{
    if (watch.stop_asked())
        left_out.push_back({what, why_ended(watch)});
    else
        try_part(what, watch, left_out, part);
}

/// The scene in both polarities, on its rock or on rock that radiates where it is massless.
Scene scene_of_finite_elements(Scene given, std::string& change)
{
    given.motion.polarity.reset();
    if (rock_kind(given) != RockKind::massless || given.time.scheme == TimeScheme::central_difference) return given;
    change = "The scene says massless rock, which keeps every wave; the finite elements run on radiating rock, and on "
             "massless rock beside it.";
    return with_radiating_rock(given);
}

Scene with_flexible_block(Scene scene)
{
    if (scene.flexible_block) return scene;
    scene.flexible_block.emplace();
    scene.flexible_block->of_modes = true;
    return scene;
}

/// Effects without which the model spread has run already.
bool in_spread(Effect effect, const Assessment& a)
{
    return std::ranges::any_of(a.spread.runs, [&](const MotionOutcome& o) { return o.without == effect; });
}

/// What tells the levels apart first: 0, 1; what follows from it is left for the end of the time.
int rank_of(Effect effect)
{
    switch (effect) {
    case Effect::vertical_motion:
    case Effect::uplift:
        return 0;
    case Effect::rock_flexibility:
    case Effect::separation:
    case Effect::structural_damping:
        return 1;
    default:
        return 2;
    }
}

/// @param in_spread  effects without which the model spread has run already
std::vector<Variant> assumptions_of(const Ready& fe, const std::function<bool(Effect)>& in_spread)
{
    std::vector<Variant> list;
    Scene rigid = fe.given;
    let_floor_absorb(rigid);
    rigid.foundation.reset();
    rigid.curtain.reset();
    if (rigid.dam.young_modulus) rigid.dam.young_modulus = *rigid.dam.young_modulus * stiffer;
    // The seepage's uplift needs the rock: the profile that it gave takes its place.
    const std::vector<Point> seepage = seepage_points(fe.given);
    if (rigid.uplift && !seepage.empty()) {
        rigid.uplift->model = UpliftModel::points;
        rigid.uplift->points = seepage;
    }
    list.push_back({rigid_dam, rigid});
    AblationPlan plan = make_ablations(fe.given, Method::finite_elements, seepage);
    std::stable_sort(plan.removals.begin(), plan.removals.end(),
                     [](const Ablation& x, const Ablation& y) { return rank_of(x.effect) < rank_of(y.effect); });
    for (const Ablation& removal : plan.removals)
        if (!in_spread(removal.effect))
            list.push_back({"without " + removal.name, removal.scene, removal.effect});
    return list;
}

/// The strongest part of a motion: `samples` about its largest acceleration.
GroundMotion strongest_part(GroundMotion motion, std::size_t samples)
{
    const auto stronger = [](double x, double y) { return std::abs(x) < std::abs(y); };
    const auto peak = std::max_element(motion.accel_h.begin(), motion.accel_h.end(), stronger) - motion.accel_h.begin();
    const std::size_t n = motion.accel_h.size(), half = std::min(samples / 2, static_cast<std::size_t>(peak)),
                      first = std::min(static_cast<std::size_t>(peak) - half, n - std::min(n, samples));
    for (std::vector<double>* accel : {&motion.accel_h, &motion.accel_v})
        if (!accel->empty()) {
            accel->erase(accel->begin(), accel->begin() + static_cast<std::ptrdiff_t>(first));
            accel->resize(std::min(samples, accel->size()));
        }
    return motion;
}

/// What all records take in both polarities [s], by longer and longer strongest parts of the first until one of them tells.
double price_of(const Ready& ready, const std::function<void(const GroundMotion&)>& slide)
{
    constexpr double telling = 0.02; // [s]
    if (ready.records().empty()) return 0.0;
    std::size_t samples = 0;
    for (const RecordPair& pair : ready.records()) samples += pair.horizontal.acceleration.size();
    const GroundMotion motion = ready.motion(ready.records().front());
    for (std::size_t n = 8;; n *= 2) {
        const Stopwatch clock;
        slide(strongest_part(motion, n));
        const std::size_t slid = std::min(n, motion.accel_h.size());
        if (clock.seconds() > telling || n >= motion.accel_h.size())
            return 2.0 * clock.seconds() * static_cast<double>(samples) / static_cast<double>(slid);
    }
}

double price_of_flexible(const Ready& ready)
{
    const std::optional<sliding::FlexibleBlock> block = flexible_block(ready.scene);
    if (!block) return 0.0;
    const RigidModel model = ready.rigid_model();
    return price_of(ready, [&](const GroundMotion& motion) { slide_flexible(ready.scene, *block, model, motion, 1); });
}

/// Of the base, and of the lifts and seams that the scene names.
double price_of_rigid(const Ready& ready)
{
    const std::vector<RigidModel> models = all_models(ready);
    return price_of(ready, [&](const GroundMotion& motion) {
        for (const RigidModel& model : models) slide_model(ready.scene, model, motion, 1);
    });
}

constexpr double cheap =
    0.1; ///< share of the budget up to which the flexible block comes before the finite elements [-]

/// The flexible block where it takes at most `most` seconds. @returns whether it is settled, run or not to be had
bool run_flexible(const Scene& given, const AssessOptions& options, double most, const BudgetWatch& watch,
                  Assessment& a)
{
    bool fits = true;
    try_in_time("flexible block", watch, a.left_out, [&] {
        const Ready flexible = prepare(with_flexible_block(given), Method::rigid_block, a.ready.pairs,
                                       {.flexible_modes = true, .stop = watch.stop()});
        fits = price_of_flexible(flexible) <= most;
        if (fits) a.flexible = run_screening(flexible, options.jobs);
    });
    return fits;
}

void run_rigid_block(const Scene& given, const AssessOptions& options, const BudgetWatch& watch, Assessment& a)
{
    a.ready = prepare(given, Method::rigid_block, {.flexible_modes = true, .stop = watch.stop()});
    a.screening = run_screening(a.ready, options.jobs, RockingRuns::where_sliding_does_not_hold, FlexibleRuns::none);
}

/// Those first that move the block furthest, so that a time too short leaves out the harmless ones. As they are where the
/// first record has a part in the damping of all.
Records worst_first(const Records& records, const Assessment& a)
{
    if (a.ready.scene.damping.method == DampingMethod::modified_rayleigh) return records;
    std::vector<std::pair<double, const RecordPair*>> order;
    for (std::size_t i = 0; i < records->size(); ++i)
        order.emplace_back(2 * i < a.screening.slips.size() ? worse_judged(a.screening, i).judged().max_slip : 0.0,
                           &(*records)[i]);
    std::stable_sort(order.begin(), order.end(), [](const auto& x, const auto& y) { return x.first > y.first; });
    std::vector<RecordPair> sorted;
    for (const auto& [slip, pair] : order) sorted.push_back(*pair);
    return std::make_shared<const std::vector<RecordPair>>(std::move(sorted));
}

/// The worst record on elements of twice the size, an eighth of the time or so: the slip where the time does not hold the scene's own.
/// Empty: there is no such mesh. @throws Interrupted
std::vector<ContactRun> runs_on_coarser_mesh(const Ready& fe, Watch& watch)
{
    constexpr double twice = 2.0;
    if (fe.scene.mesh.file || elements_on_base(fe.scene) < twice * least_elements) return {};
    Scene scene = fe.given;
    scale_mesh(twice, scene);
    std::vector<ContactRun> runs = run_record(scene, fe.records().front(), {}, watch);
    for (ContactRun& r : runs) {
        r.mesh.check = MeshCheck::no_answer;
        r.mesh.reason = "the mesh's part of the error is not known: the time held elements of twice the size alone";
    }
    return runs;
}

bool has_run(const std::vector<ContactRun>& runs, const std::string& record, int polarity)
{
    return std::any_of(runs.begin(), runs.end(),
                       [&](const ContactRun& r) { return r.record == record && r.polarity == polarity; });
}

/// Records and polarities that the time did not hold.
void name_missing_runs(const BudgetWatch& watch, Assessment& a)
{
    const std::vector<int> both = polarities_of(a.fe->scene);
    for (const RecordPair& pair : a.fe->records()) {
        const std::string& name = pair.files.name;
        std::vector<std::string> missing;
        for (const int polarity : both)
            if (!has_run(a.runs, name, polarity)) missing.push_back(fmt::format(", polarity {:+d}", polarity));
        const bool whole = missing.size() == both.size();
        for (const std::string& of : whole ? std::vector<std::string>{""} : missing)
            a.left_out.push_back({"finite elements, record " + name + of, why_ended(watch)});
    }
}

void run_finite_elements(const Scene& given, BudgetWatch& watch, Assessment& a)
{
    std::vector<ContactRun> coarse;
    try_in_time("finite elements", watch, a.left_out, [&] {
        const Records records = worst_first(load_records(given, Method::finite_elements), a);
        a.fe = prepare(scene_of_finite_elements(given, a.rock_change), Method::finite_elements, records,
                       {.joints_of_lifts = true, .stop = watch.stop()});
        coarse = runs_on_coarser_mesh(*a.fe, watch);
        ContactRuns all(*a.fe, {}, watch);
        std::vector<ContactRun> runs = all.run([](ContactRun& r, const GroundMotion&) { r.fe.history = {}; });
        std::erase_if(runs, [](const ContactRun& r) { return r.fe.status == Status::interrupted; });
        a.runs = std::move(runs);
    });
    if (!watch.stop_asked()) return;
    for (ContactRun& r : coarse) {
        if (has_run(a.runs, r.record, r.polarity)) continue;
        a.left_out.push_back({"finite elements, " + r.label() +
                                  ", on the scene's own elements (those of twice the size stand in their place)",
                              why_ended(watch)});
        a.runs.push_back(std::move(r));
    }
    if (!a.runs.empty()) name_missing_runs(watch, a);
}

void run_spectrum(const Scene& given, const BudgetWatch& watch, Assessment& a)
{
    try_in_time("response spectrum", watch, a.left_out, [&] {
        a.spectrum = spectrum_level(prepare(given, Method::finite_elements, a.ready.pairs, {.stop = watch.stop()}));
    });
}

void run_rigid_effects(const AssessOptions& options, BudgetWatch& watch, Assessment& a)
{
    try_in_time("effects in turn, rigid block", watch, a.left_out, [&] {
        a.rigid_plan = make_ablations(a.ready.given, Method::rigid_block, seepage_points(a.ready.given));
        a.rigid_ablation = run_ablations(*a.rigid_plan, a.ready.pairs, options.jobs, watch);
    });
}

/// Variants on the worst record, each if its time, judged by those before it, is there.
void run_variants(BudgetWatch& watch, Assessment& a)
{
    if (a.runs.empty() || !all_answered(a.runs) || !has_slip(worst_of(a.runs))) return;
    // What a variant takes, at first that of the worst run, then the mean of those that ran; the watch ends one that
    // takes longer.
    double expected = worst_of(a.runs).fe.seconds.dynamics + worst_of(a.runs).fe.seconds.model, sum = 0.0;
    int done = 0;
    const auto fits = [&](const std::string& what, double share) {
        if (watch.left() > share * expected) return true;
        a.left_out.push_back({what, "the budget does not hold it"});
        return false;
    };
    const bool spread_fits = fits("massless rock and other water, finite elements", 2.0);
    try_part("model spread", watch, a.left_out, [&] { a.spread = model_spread(*a.fe, a.runs, spread_fits, watch); });
    for (const MotionOutcome& choice : a.spread.runs) {
        if (choice.status == Status::interrupted)
            a.left_out.push_back({"finite elements, " + choice.what, why_ended(watch)});
        else if (choice.what != "other polarity")
            a.assumptions.push_back(choice);
    }
    std::vector<Variant> list;
    try_part("effects in turn, finite elements", watch, a.left_out, [&] { list = assumptions_of(*a.fe, [&](Effect effect) { return in_spread(effect, a); }); });
    for (const Variant& assumption : list) {
        if (!fits("finite elements, " + assumption.what, 1.0)) continue;
        const double before = watch.spent();
        try_part("finite elements, " + assumption.what, watch, a.left_out, [&] {
            const MotionOutcome outcome = run_worst(assumption, *a.fe, worst_of(a.runs), watch);
            if (outcome.status == Status::interrupted) throw Interrupted("a variant");
            a.assumptions.push_back(outcome);
        });
        sum += watch.spent() - before;
        expected = sum / ++done;
    }
}

constexpr double passes = 3.0;            ///< price of a run over that of its pass with whole steps: half steps cost twice as much
constexpr double with_coarser_mesh = 1.3; ///< price of the runs with that of the mesh error over their own

/// Wall time of one finite-element run without a second mesh, by its longest record [s].
double price_of_one(const ContactCost& cost)
{
    double longest = 0.0;
    for (const ContactCost::OfRecord& r : cost.records) longest = std::max(longest, passes * r.pass_seconds);
    return cost.set_up_seconds + longest;
}

/// Parts of the finite elements: the runs, then the variants of one of them.
void plan_finite_elements(const Scene& given, const Watch& watch, WorkPlan& plan)
{
    PlannedPart runs{AssessPart::finite_elements}, spectrum{AssessPart::spectrum}, variants{AssessPart::variants};
    try {
        plan.fe = prepare(scene_of_finite_elements(given, plan.rock_change), Method::finite_elements,
                          load_records(given, Method::finite_elements), {.joints_of_lifts = true, .stop = watch.stop()});
        const ContactCost cost = contact_cost(*plan.fe);
        const std::size_t polarities = polarities_of(plan.fe->scene).size();
        runs.runs = polarities * plan.fe->records().size();
        spectrum.runs = plan.fe->records().size();
        const auto replaced = [](Effect e) {
            return std::ranges::any_of(other_models(), [&](const OtherModel& other) { return other.without == e; });
        };
        variants.runs = assumptions_of(*plan.fe, replaced).size() + (has_water(plan.fe->scene) ? 2 : 1);
        if (cost.seconds_per_step) {
            double all = 0.0;
            for (const ContactCost::OfRecord& r : cost.records) all += passes * r.pass_seconds;
            runs.seconds = with_coarser_mesh * (cost.set_up_seconds + static_cast<double>(polarities) * all);
            variants.seconds = static_cast<double>(variants.runs) * price_of_one(cost);
        }
        spectrum.seconds = cost.set_up_seconds;
    } catch (const InputError& e) {
        runs.left_out = e.diagnostics().empty() ? e.what() : e.diagnostics().front().problem;
    } catch (const NotConverged& e) {
        runs.left_out = e.diagnostic().problem;
    }
    if (!runs.left_out.empty()) spectrum.left_out = variants.left_out = "it needs the finite elements";
    for (const PlannedPart& part : {runs, spectrum, variants}) plan.parts.push_back(part);
}

} // namespace

double WorkPlan::seconds() const
{
    double sum = 0.0;
    for (const PlannedPart& part : parts)
        if (part.fits && part.left_out.empty()) sum += part.seconds.value_or(0.0);
    return sum;
}

WorkPlan plan_work(const Scene& given, const AssessOptions& options, Watch& watch)
{
    WorkPlan plan{.ready = prepare(given, Method::rigid_block, {.flexible_modes = true, .stop = watch.stop()}),
                  .fe = {}, .rock_change = {}, .parts = {}, .budget = options.budget};
    const std::size_t motions = 2 * plan.ready.records().size();
    const double rigid = price_of_rigid(plan.ready);
    plan.parts.push_back({AssessPart::rigid_block, motions, rigid});
    PlannedPart flexible{AssessPart::flexible_block, motions};
    std::vector<LeftOut> refused;
    const BudgetWatch budget(watch, options.budget);
    try_part("", budget, refused, [&] {
        flexible.seconds = price_of_flexible(prepare(with_flexible_block(given), Method::rigid_block, plan.ready.pairs,
                                                     {.flexible_modes = true, .stop = watch.stop()}));
    });
    if (!refused.empty()) flexible.left_out = refused.front().why;
    const bool before = flexible.seconds.value_or(0.0) <= cheap * options.budget;
    if (before) plan.parts.push_back(flexible);
    plan_finite_elements(given, watch, plan);
    if (!before) plan.parts.insert(plan.parts.begin() + 2, flexible);
    const std::size_t removals =
        make_ablations(plan.ready.given, Method::rigid_block, seepage_points(plan.ready.given)).removals.size();
    plan.parts.insert(plan.parts.end() - 1, {AssessPart::rigid_effects, motions * removals, rigid * static_cast<double>(removals)});
    double sum = 0.0;
    for (PlannedPart& part : plan.parts)
        if (part.left_out.empty()) part.fits = (sum += part.seconds.value_or(0.0)) <= options.budget;
    return plan;
}

Assessment assess(const Scene& given, const AssessOptions& options, Watch& watch)
{
    BudgetWatch budget(watch, options.budget);
    Assessment a;
    const auto timed = [&](AssessPart part, const auto& run) {
        const double before = budget.spent();
        run();
        a.seconds_of[part] += budget.spent() - before;
    };
    timed(AssessPart::rigid_block, [&] { run_rigid_block(given, options, budget, a); });
    bool settled = false;
    timed(AssessPart::flexible_block, [&] { settled = run_flexible(given, options, cheap * options.budget, budget, a); });
    timed(AssessPart::finite_elements, [&] { run_finite_elements(given, budget, a); });
    if (!settled)
        timed(AssessPart::flexible_block, [&] { settled = run_flexible(given, options, budget.left(), budget, a); });
    if (!settled) a.left_out.push_back({"flexible block", "the budget does not hold it"});
    timed(AssessPart::spectrum, [&] { run_spectrum(given, budget, a); });
    timed(AssessPart::rigid_effects, [&] { run_rigid_effects(options, budget, a); });
    timed(AssessPart::variants, [&] { run_variants(budget, a); });
    a.interrupted = watch.stop_asked();
    a.seconds = budget.spent();
    judge_assessment(a);
    return a;
}

} // namespace damslip
