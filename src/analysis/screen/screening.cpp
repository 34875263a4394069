#include "analysis/screen/screening.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "analysis/prepare/reservoir.hpp"
#include "analysis/screen/regression_rows.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "core/status.hpp"
#include "core/units.hpp"
#include "scene/keys.hpp"
#include "scene/water.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace damslip {

Verdict ElasticScreening::verdict(const std::optional<double>& allowable) const
{
    const Verdict verdict = runs.empty() ? Verdict::undecided : verdict_of(runs, allowable);
    return verdict == Verdict::pass && !why_not.empty() ? Verdict::undecided : verdict;
}

namespace {

ElasticScreening screen_elastic(const Ready& ready, int jobs, Watch& watch)
{
    ElasticScreening out;
    if (const auto why_not = why_not_reducible(ready.given)) {
        out.why_not = why_not->problem;
        return out;
    }
    Scene given = ready.given;
    given.time.substeps.reset();
    given.time.slip_tolerance = std::numeric_limits<double>::infinity(); // one halving, for the error estimate
    try {
        const Ready elastic = prepare(std::move(given), Method::finite_elements, ready.pairs,
                                      {.seepage = ready.seepage, .stop = watch.stop()});
        ContactRuns all(elastic, {.mesh_error = false, .reduced = true, .jobs = jobs}, watch);
        out.why_not = text_of(all.why_not());
        if (!out.why_not.empty()) return out;
        out.runs = all.run([](ContactRun& run, const GroundMotion&) { run.fe.history = {}; });
        if (out.runs.size() < all.whole())
            out.why_not = fmt::format("Stopped after {} of {} runs.", out.runs.size(), all.whole());
    } catch (const InputError& error) {
        out.why_not = error.diagnostics().front().problem;
    } catch (const NotConverged& error) {
        out.why_not = error.diagnostic().problem;
    }
    return out;
}

void set_status(SlipRow& row, Status status)
{
    row.horizontal.status = status;
    if (row.with_vertical) row.with_vertical->status = status;
    if (!row.flexible) return;
    if (row.flexible->decoupled) row.flexible->decoupled->slide.status = status;
    if (row.flexible->coupled) row.flexible->coupled->slide.status = status;
}

/// Largest acceleration of the mass: that of the ground, or what a flexible mass makes of it [m/s^2].
double strongest_shaking(const SlipRow& row)
{
    double strongest = row.pga;
    if (row.flexible)
        for (const auto* slide : {&row.flexible->decoupled, &row.flexible->coupled})
            if (*slide) strongest = std::max(strongest, (*slide)->peak_acceleration);
    return strongest;
}

/// What all rows are made of.
struct RowsOf {
    const Scene& scene;
    const BaseRow& base;
    const std::optional<sliding::FlexibleBlock>& flexible;
    RockingRuns rocking;
    int jobs;
};

void add_rocking(const RowsOf& of, const std::vector<GroundMotion>& motions, std::vector<SlipRow>& rows)
{
    const bool does_not_hold = std::any_of(rows.begin(), rows.end(), [](const SlipRow& row) {
        return row.rigid().status == Status::rocks_first || (!row.flexible && !row.broken_premises.empty());
    });
    if (!of.base.model.rocking || !(does_not_hold || of.rocking == RockingRuns::always)) return;
    parallel_for(rows.size(), of.jobs, [&](std::size_t i) {
        rows[i].rocking = rock_model(of.scene, of.base.model, motions[i / 2], rows[i].polarity);
    });
}

std::vector<SlipRow> slip_rows(const RowsOf& of, const std::vector<RecordPair>& records,
                               std::vector<std::string>& warnings)
{
    const Scene& scene = of.scene;
    const BaseRow& base = of.base;
    const std::optional<sliding::FlexibleBlock>& flexible = of.flexible;
    const RigidModel& model = base.model;
    std::vector<GroundMotion> motions;
    std::vector<SlipRow> rows;
    for (const RecordPair& pair : records) {
        motions.push_back(ground_motion(scene, pair));
        for (const std::string& note : motions.back().notes) warnings.push_back(motions.back().name + ": " + note);
        for (const int polarity : {1, -1}) {
            SlipRow row;
            row.record = motions.back().name;
            row.polarity = polarity;
            row.pga = peak_of(motions.back().accel_h);
            row.vertical_pga = peak_of(motions.back().accel_v);
            rows.push_back(std::move(row));
        }
    }
    parallel_for(3 * rows.size(), of.jobs, [&](std::size_t task) {
        SlipRow& row = rows[task / 3];
        const GroundMotion& motion = motions[task / 6];
        if (task % 3 == 0)
            row.horizontal = slide_model(scene, model, horizontal_only(motion), row.polarity);
        else if (task % 3 == 1 && !motion.accel_v.empty())
            row.with_vertical = slide_model(scene, model, motion, row.polarity);
        else if (task % 3 == 2 && flexible)
            row.flexible = slide_flexible(scene, *flexible, model, motion, row.polarity);
    });
    for (SlipRow& row : rows) {
        if (overturns(base)) set_status(row, Status::overturns);
        row.broken_premises = broken_premises(base, strongest_shaking(row));
    }
    add_rocking(of, motions, rows);
    return rows;
}

/// Both polarities of one record.
struct RecordSlides {
    std::string record;
    const sliding::SlideResult *positive, *negative;
};

/// Records that fail over those that can be judged; nothing where none can.
std::optional<double> failing_share(const std::vector<RecordSlides>& records, const std::optional<double>& allowable)
{
    if (!allowable) return std::nullopt;
    std::size_t judged = 0, failing = 0;
    for (const RecordSlides& r : records) {
        if (!is_answer(worse(*r.positive, *r.negative).status)) continue;
        ++judged;
        const auto fails = [&](const sliding::SlideResult& slide) {
            return status_row(slide.status).judging == Judging::fails || slide.max_slip > *allowable;
        };
        failing += fails(*r.positive) || fails(*r.negative);
    }
    if (judged == 0) return std::nullopt;
    return static_cast<double>(failing) / static_cast<double>(judged);
}

SetStatistics statistics_of(const std::string& quantity, const std::vector<RecordSlides>& records,
                            const std::optional<double>& allowable)
{
    SetStatistics s;
    s.quantity = quantity;
    std::vector<double> values;
    s.largest = std::nan("");
    for (const RecordSlides& r : records) {
        const sliding::SlideResult& slide = worse(*r.positive, *r.negative);
        const std::optional<double> slip = reported(slide.status, slide.max_slip);
        if (!slip) {
            s.without_slip.add(slide.status);
            continue;
        }
        values.push_back(*slip);
        if (status_row(slide.status).slip == SlipMeaning::lower_bound) s.lower_bounds.add(slide.status);
        if (s.largest >= *slip) continue;
        s.largest = *slip;
        s.controlling_record = r.record;
    }
    s.n = values.size();
    s.median = percentile(values, 0.5);
    s.percentile_16 = percentile(values, 0.16);
    s.percentile_84 = percentile(values, 0.84);
    s.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    s.share_above_allowable = failing_share(records, allowable);
    return s;
}

/// Rows come in pairs of polarities. @param select  a row's slide; null: it has none of this kind
template <class Select>
std::vector<RecordSlides> slides_of(const std::vector<SlipRow>& rows, Select&& select)
{
    std::vector<RecordSlides> records;
    for (std::size_t i = 0; i + 1 < rows.size(); i += 2) {
        const sliding::SlideResult *a = select(rows[i]), *b = select(rows[i + 1]);
        if (a && b) records.push_back({rows[i].record, a, b});
    }
    return records;
}

const sliding::SlideResult* slide_of(const std::optional<sliding::FlexibleSlide>& flexible)
{
    return flexible ? &flexible->slide : nullptr;
}

std::vector<SetStatistics> statistics_rows(const std::vector<SlipRow>& rows, const std::optional<double>& allowable)
{
    std::vector<SetStatistics> out;
    const auto add = [&](const std::string& name, auto&& select) {
        const std::vector<RecordSlides> records = slides_of(rows, select);
        if (!records.empty()) out.push_back(statistics_of(name, records, allowable));
    };
    add("rigid, horizontal", [](const SlipRow& r) { return &r.horizontal; });
    add("rigid, with vertical", [](const SlipRow& r) { return r.with_vertical ? &*r.with_vertical : nullptr; });
    add("rocking and sliding", [](const SlipRow& r) { return r.rocking ? &r.rocking->slide : nullptr; });
    add("flexible, decoupled", [](const SlipRow& r) { return r.flexible ? slide_of(r.flexible->decoupled) : nullptr; });
    add("flexible, coupled", [](const SlipRow& r) { return r.flexible ? slide_of(r.flexible->coupled) : nullptr; });
    return out;
}

/// The block that rocks answers where the sliding one does not hold: it tips, or its bond goes with the crack. A flexible mass
/// keeps its own answer, unless the rigid one already tips.
bool answered_by_rocking(const SlipRow& row)
{
    return row.rocking &&
           (row.rigid().status == Status::rocks_first || (!row.flexible && !row.broken_premises.empty()));
}

/// All slides of a row that have to answer.
std::vector<const sliding::SlideResult*> all_slides(const SlipRow& row)
{
    if (answered_by_rocking(row)) return {&row.rocking->slide};
    std::vector<const sliding::SlideResult*> slides{&row.horizontal};
    if (row.with_vertical) slides.push_back(&*row.with_vertical);
    if (row.rocking) slides.push_back(&row.rocking->slide);
    if (row.flexible)
        for (const auto* slide : {slide_of(row.flexible->decoupled), slide_of(row.flexible->coupled)})
            if (slide) slides.push_back(slide);
    return slides;
}

void add_equilibrium(const Ready& ready, const sliding::SeepageProfile& seepage, Screening& s)
{
    const Scene& scene = ready.scene;
    s.combinations = ready.combinations();
    if (scene.reservoir || scene.tailwater)
        s.uplifts = sliding::compare_uplift(scene, s.plan.on(Effect::seepage) ? seepage : sliding::SeepageProfile{});
}

/// Drains whose head lies above that of the rock behind the curtain would give it water: they are left out.
bool drains_change_nothing(const Screening& s)
{
    const auto uplift = [&](std::string_view name) -> std::optional<double> {
        for (const sliding::Equilibrium& e : s.combinations)
            if (e.name == name) return e.base.uplift.force;
        return std::nullopt;
    };
    const auto with = uplift("usual"), without = uplift("drains ineffective");
    return s.plan.on(Effect::seepage) && with && without && std::abs(*with - *without) <= 1e-3 * *without;
}

void add_flexible_warnings(const SlipRow& row, std::vector<std::string>& warnings)
{
    const auto& decoupled = row.flexible->decoupled;
    const auto& coupled = row.flexible->coupled;
    for (const auto& [name, result] : {std::pair("decoupled", &decoupled), std::pair("coupled", &coupled)}) {
        if (!*result || (*result)->slide.status == Status::at_rest || fails_statically((*result)->slide.status))
            continue;
        for (const Note& note : (*result)->slide.notes)
            warnings.push_back(fmt::format("{}, polarity {:+d}, {}: {}", row.record, row.polarity, name, text_of(note)));
    }
    if (row.rigid().lift_offs > 0 && !decoupled)
        warnings.push_back(
            fmt::format("{}, polarity {:+d}: the base opens, which the coupled analysis does not follow; "
                        "flexible_block.mode = \"both\" gives the decoupled slip to judge by.",
                        row.record, row.polarity));
}

void add_warnings(const Scene& scene, const Screening& s, std::vector<std::string>& warnings)
{
    if (overturns(s.bases.front()))
        warnings.push_back("The resultant of the static loads acts outside the base: the dam tips over without any "
                           "earthquake.");
    if (s.dry_base)
        warnings.push_back("The base is taken as dry although there is water on the dam: no answer here counts any "
                           "uplift.");
    if (drains_change_nothing(s))
        warnings.push_back("[drains] change nothing: their head, by drains.efficiency, lies above that of the rock behind the "
                           "curtain, and they would give it water. A larger efficiency, or a deeper line, draws water.");
    const bool rocks = std::any_of(s.slips.begin(), s.slips.end(), answered_by_rocking);
    for (const std::string& premise : broken_premises(s))
        warnings.push_back((rocks ? "Judged by the block that rocks and slides: the dam " : "No PASS: the dam ") +
                           premise + ".");
    if (!s.slips_without_bond.empty())
        warnings.push_back(
            fmt::format("The bond is {:.0f} % of the resistance before the earthquake: the slip is judged "
                        "for c = 0, too (a judgement, from a third on).",
                        100.0 * s.bond_share));
    const RigidModel& model = s.bases.front().model;
    if (model.state == sliding::StaticState::slides_downstream || model.state == sliding::StaticState::slides_upstream)
        warnings.push_back("The block slides without any earthquake: " + model.why_it_fails() + ".");
    if (model.state != sliding::StaticState::at_rest &&
        std::any_of(model.anchors.begin(), model.anchors.end(),
                    [](const AnchorBar& bar) { return bar.prestress < bar.yield_force; }))
        warnings.push_back(
            "Anchors pull with their prestress until it slides; whether it comes to rest against what more "
            "they have is a question for finite elements.");
    if (model.state == sliding::StaticState::lifts_off)
        warnings.push_back("The uplift carries more than the weight: the block floats without any earthquake.");
    if (scene.sliding.scheme == SlidingScheme::slammer)
        warnings.push_back("SLAMMER's trapezoid scheme has an error of second order in the time step, largest where "
                           "the yield acceleration is near the peak; the exact scheme has none.");
    if (scene.sliding.scheme == SlidingScheme::slammer && s.flexible)
        warnings.push_back("sliding.scheme = \"slammer\" is the rigid block's; decoupled and coupled are exact: events "
                           "located on closed forms.");
    for (const SlipRow& row : s.slips)
        if (row.flexible) add_flexible_warnings(row, warnings);
    for (const SlipRow& row : s.slips)
        for (const AnchorOutcome& anchor : row.rigid().anchors)
            if (anchor.history.snapped_at)
                warnings.push_back(fmt::format("{}, polarity {:+d}: {} snapped at {:.4g} s.", row.record, row.polarity,
                                               anchor.name, *anchor.history.snapped_at));
    for (const SlipRow& row : s.slips)
        for (const auto* r : {&row.horizontal, row.with_vertical ? &*row.with_vertical : nullptr,
                              row.rocking ? &row.rocking->slide : nullptr}) {
            if (!r) continue;
            for (const Note& note : r->notes) // of the water between two records, and of water on its way
                if (note.kind == NoteKind::rest_after || note.kind == NoteKind::rest_falls ||
                    note.kind == NoteKind::crack_water_late)
                    warnings.push_back(fmt::format("{}, polarity {:+d}: {}", row.record, row.polarity, text_of(note)));
            if (r->status == Status::overturned)
                warnings.push_back(
                    fmt::format("{}, polarity {:+d}: overturned. {}", row.record, row.polarity,
                                text_of(r->notes.front())));
            if (r->status == Status::sliding_at_end)
                warnings.push_back(fmt::format(
                    "{}, polarity {:+d}: still sliding after a run-out of {:.3g} s; the slip is a lower bound.",
                    row.record, row.polarity, scene.sliding.run_out_max));
            if (r->status == Status::not_resolved)
                for (const Note& note : r->notes) warnings.push_back(row.record + ": " + text_of(note));
            if (r->status == Status::runs_away)
                warnings.push_back(
                    fmt::format("{}, polarity {:+d}: runs away. {}", row.record, row.polarity,
                                text_of(r->notes.back())));
        }
}

std::string in_g(double a)
{
    return fmt::format("{:.3g} g", a / units::standard_gravity);
}

/// "tips at 0.305 g before it slides at 0.869 g: ..."; nothing where it slides first, or the motion stays below.
std::optional<std::string> before_sliding(const std::string& what, double limit, double yield, double pga)
{
    if (!(limit > 0.0 && limit < pga && limit < yield)) return std::nullopt; // without an earthquake: `overturns`
    const std::string slides = std::isfinite(yield) ? " before it slides at " + in_g(yield) : " and does not slide";
    return fmt::format("{} at {}{}: the rigid sliding block does not hold here", what, in_g(limit), slides);
}

} // namespace

GoverningSlip SlipRow::governing() const
{
    if (answered_by_rocking(*this)) return {rocking->slide, "rocking", slip_error(rocking->slide)};
    if (!flexible) return {rigid(), "rigid", slip_error(rigid())};
    const auto& decoupled = flexible->decoupled;
    const auto& coupled = flexible->coupled;
    const bool opens = rigid().lift_offs > 0 || (decoupled && decoupled->slide.lift_offs > 0);
    if (decoupled && (opens || !coupled)) return {decoupled->slide, "decoupled", slip_error(decoupled->slide)};
    return {coupled->slide, "coupled", opens ? std::nan("") : slip_error(coupled->slide)};
}

double slip_error(const sliding::SlideResult& slide)
{
    return slide.accuracy == sliding::SlideAccuracy::scheme ? std::nan("") : slide.slip_error;
}

Verdict judge(const sliding::SlideResult& slide, const std::optional<double>& allowable)
{
    return judge(slide.status, slide.max_slip, slip_error(slide), allowable);
}

Verdict judge(const SlipRow& row, const std::optional<double>& allowable)
{
    const GoverningSlip g = row.governing();
    const Verdict verdict = judge(g.slide.status, g.slide.max_slip, g.error, allowable);
    if (verdict == Verdict::pass && row.leaves_out) return Verdict::undecided;
    if (g.method == "rocking") return verdict; // it has no such premise
    return verdict == Verdict::pass && !row.broken_premises.empty() ? Verdict::undecided : verdict;
}

bool vibrates(const SlipRow& row)
{
    const std::string_view method = row.governing().method;
    return method == "coupled" || method == "decoupled";
}

std::string verdict_word(const SlipRow& row, const std::optional<double>& allowable)
{
    const Verdict verdict = judge(row, allowable);
    return verdict == Verdict::pass && row.of_dam && !vibrates(row) ? "below" : word(verdict);
}

const sliding::SlideResult& worse(const sliding::SlideResult& a, const sliding::SlideResult& b)
{
    const auto rank = [](const sliding::SlideResult& r) {
        return !is_answer(r.status) ? 2 : status_row(r.status).slip == SlipMeaning::none ? 1 : 0;
    };
    if (rank(a) != rank(b)) return rank(b) > rank(a) ? b : a;
    return b.max_slip > a.max_slip ? b : a;
}

const SlipRow& worse_horizontal(const Screening& s, std::size_t number)
{
    const SlipRow &a = s.slips[2 * number], &b = s.slips[2 * number + 1];
    return &worse(a.horizontal, b.horizontal) == &b.horizontal ? b : a;
}

const SlipRow* worse_with_vertical(const Screening& s, std::size_t number)
{
    const SlipRow &a = s.slips[2 * number], &b = s.slips[2 * number + 1];
    if (!a.with_vertical || !b.with_vertical) return nullptr;
    return &worse(*a.with_vertical, *b.with_vertical) == &*b.with_vertical ? &b : &a;
}

const SlipRow& worse_judged(const Screening& s, std::size_t number)
{
    const SlipRow &a = s.slips[2 * number], &b = s.slips[2 * number + 1];
    return &worse(a.judged(), b.judged()) == &b.judged() ? b : a;
}

bool has_rocking(const Screening& s)
{
    return std::any_of(s.slips.begin(), s.slips.end(), [](const SlipRow& row) { return row.rocking.has_value(); });
}

StatusCount statuses_of(const Screening& screening)
{
    StatusCount count;
    for (const SlipRow& row : screening.slips)
        for (const sliding::SlideResult* slide : all_slides(row)) count.add(slide->status);
    for (const PlaneRow& row : screening.planes.rows)
        if (row.kind != PlaneKind::base)
            for (const PlaneSlip& slip : row.slips) count.add(slip.slide.status);
    return count;
}

void add_elastic_dam(const Ready& ready, int jobs, Watch& watch, Screening& screening)
{
    if (screening.slips.empty() || !screening.slips.front().of_dam) return;
    const BaseRow& base = screening.bases.front();
    if (base.model.state != sliding::StaticState::at_rest || overturns(base)) return;
    screening.elastic = screen_elastic(ready, jobs, watch);
}

bool overturns(const BaseRow& base)
{
    return base.model.state == sliding::StaticState::at_rest &&
           (base.limits.tips <= 0.0 || base.limits.tips_upstream <= 0.0);
}

std::vector<std::string> broken_premises(const BaseRow& base, double pga)
{
    const sliding::BaseLimits& limits = base.limits;
    const double down = base.model.downstream.law.constant, up = base.model.upstream.law.constant;
    std::vector<std::string> out;
    const auto add = [&](const char* what, double limit, double yield) {
        if (auto sentence = before_sliding(what, limit, yield, pga)) out.push_back(std::move(*sentence));
    };
    add("tips", limits.tips, down);
    if (limits.opens < limits.tips * (1.0 - 1e-9)) add("has its joint open from heel to toe", limits.opens, down);
    const double bond = limits.yield_with_crack;
    if (base.model.block.cohesion_force > 0.0 && bond < pga && bond < down * (1.0 - 1e-9))
        out.push_back(
            fmt::format("slides at {} with the crack that the same acceleration opens, not at {}: its bond does "
                        "not hold until then",
                        in_g(bond), in_g(down)));
    add("tips upstream", limits.tips_upstream, up);
    return out;
}

std::vector<std::string> broken_premises(const Screening& screening)
{
    std::vector<std::string> all;
    for (const SlipRow& row : screening.slips)
        for (const std::string& premise : row.broken_premises)
            if (std::find(all.begin(), all.end(), premise) == all.end()) all.push_back(premise);
    return all;
}

FlexibleSlips slide_flexible(const Scene& scene, const sliding::FlexibleBlock& flexible, const RigidModel& model,
                             const GroundMotion& motion, int polarity, sliding::HistoryOutput history)
{
    const FlexibleMethod method = scene.flexible_block ? scene.flexible_block->method : FlexibleMethod::both;
    FlexibleSlips slips;
    slips.column = column_under(scene, flexible, motion);
    if (method != FlexibleMethod::coupled)
        slips.decoupled = slide_model(scene, flexible, model, motion, polarity, FlexibleMethod::decoupled, history);
    if (method != FlexibleMethod::decoupled)
        slips.coupled = slide_model(scene, flexible, model, motion, polarity, FlexibleMethod::coupled, history);
    return slips;
}

namespace {

/// The rows once more without bond, where much of the resistance is bond.
void add_slips_without_bond(const Scene& given, const sliding::SeepageProfile& seepage,
                            const std::vector<RecordPair>& records, const RowsOf& of, Screening& s)
{
    const sliding::RigidBlock& block = of.base.model.block;
    const double resistance = block.cohesion_force + block.friction * sliding::static_normal_force(block);
    s.bond_share = resistance > 0.0 ? block.cohesion_force / resistance : 0.0;
    if (!(s.bond_share > judged_bond_share) || of.base.model.state != sliding::StaticState::at_rest) return;
    Scene scene = given;
    scene.contact.cohesion = 0.0;
    const BaseRow base{"without bond", make_rigid_model(scene, seepage), sliding::base_limits(scene, seepage)};
    std::vector<std::string> told_already;
    s.slips_without_bond = slip_rows({scene, base, of.flexible, of.rocking, of.jobs}, records, told_already);
}

/// Base, lifts and seams side by side.
void add_planes(const Ready& ready, int jobs, Screening& s)
{
    std::vector<PlaneSlip> of_base;
    for (const SlipRow& row : s.slips) of_base.push_back({row.record, row.polarity, row.judged()});
    s.planes = find_planes(ready, s.combinations, s.bases.front().model, std::move(of_base), jobs);
    s.warnings.insert(s.warnings.end(), s.planes.warnings.begin(), s.planes.warnings.end());
}

/// The block under all records, without limit equilibrium.
void add_slips(const RowsOf& of, const std::vector<RecordPair>& records, Screening& s)
{
    s.slips = slip_rows(of, records, s.warnings);
    for (const SlipRow& row : s.slips) {
        s.largest_pga = std::max(s.largest_pga, row.pga);
        s.largest_vertical_pga = std::max(s.largest_vertical_pga, row.vertical_pga);
    }
}

/// What the kept way of sliding of a wedge leaves out.
void add_wedge_warnings(const Scene& scene, const std::vector<RecordPair>& records, Screening& s)
{
    const RigidModel& model = s.bases.front().model;
    const RigidWedge& w = *model.wedge;
    for (const RecordPair& pair : records) {
        const GroundMotion motion = ground_motion(scene, pair);
        double share = 0.0;
        for (const int polarity : {1, -1})
            share = std::max(share, share_of_other_modes(w.wedge, w.push, motion, w.yields.at_rest, polarity));
        if (share > 0.0)
            s.warnings.push_back(
                fmt::format("{}: at {:.2g} % of the samples beyond the yield the wedge would start another "
                            "way than at the yield (other planes, or lifting); the way at the yield is kept.",
                            motion.name, 100.0 * share));
    }
    if (model.upstream.law.constant < s.largest_pga)
        s.warnings.push_back(
            fmt::format("Pushed the other way the wedge would start at {:.4g} m/s², below the largest PGA of "
                        "{:.4g} m/s²: that sliding is not followed.",
                        std::max(0.0, model.upstream.law.constant), s.largest_pga));
}

Screening screen_wedge(const Ready& ready, int jobs)
{
    const Scene& scene = ready.scene;
    const std::vector<RecordPair>& records = ready.records();
    Screening s;
    s.plan = ready.plan;
    s.bases.push_back({"wedge", ready.rigid_model()});
    add_slips({scene, s.bases.front(), s.flexible, RockingRuns::where_sliding_does_not_hold, jobs}, records, s);
    s.regressions = regression_rows(scene, s.bases.front().model, records);
    s.statistics = statistics_rows(s.slips, scene.criteria.allowable_slip);
    add_warnings(scene, s, s.warnings);
    if (s.bases.front().model.state == sliding::StaticState::at_rest) add_wedge_warnings(scene, records, s);
    return s;
}

} // namespace

std::vector<LiftBlock> lift_blocks(const Scene& scene)
{
    std::vector<LiftBlock> list;
    for (const LiftJoint& joint : scene.lift_joints) {
        const sliding::RigidBlock block = sliding::lift_block(scene, joint);
        LiftBlock& b = list.emplace_back();
        b.joint = joint.name;
        b.elevation = joint.elevation;
        b.friction = block.friction;
        b.normal_force = sliding::static_normal_force(block);
        b.shear_force = block.horizontal_force;
        if (b.shear_force != 0.0)
            b.sliding_factor =
                (block.friction * b.normal_force + block.cohesion_force + block.dowel_force) / std::abs(b.shear_force);
        b.critical_friction = sliding::critical_friction(block);
        b.yield_acceleration = sliding::yield_downstream(block).law.constant;
    }
    return list;
}

Screening run_screening(const Ready& ready, int jobs, RockingRuns rocking, FlexibleRuns flexible)
{
    const Scene& scene = ready.scene;
    const std::vector<RecordPair>& records = ready.records();
    if (scene.wedge) return screen_wedge(ready, jobs);
    Screening s;
    s.plan = ready.plan;
    const sliding::SeepageProfile seepage = ready.seepage->profile_of(scene);
    const auto base = [&](const char* name, std::optional<CrackRule> crack) {
        return BaseRow{name, ready.rigid_model(crack), sliding::base_limits(scene, seepage, crack)};
    };
    const bool cracks = s.plan.on(Effect::base_crack);
    s.bases.push_back(base(cracks ? "cracked, as given" : "uncracked, as given", std::nullopt));
    s.bases.push_back(cracks ? base("uncracked", CrackRule::none)
                             : base("cracked under static loads", CrackRule::fixed_static));
    s.dry_base = base_taken_as_dry(scene);
    if (flexible == FlexibleRuns::as_the_scene_says) s.flexible = flexible_block(scene);
    s.mass_ratio_words = ready.flexible_modes.empty() ? mass_ratio_words(scene) : "of the tied modes";
    const RowsOf rows{scene, s.bases.front(), s.flexible, rocking, jobs};
    add_slips(rows, records, s);
    add_slips_without_bond(scene, seepage, records, rows, s);
    const bool leaves_out = !not_honoured(ready.given, methods::rigid | methods::flexible).empty();
    for (std::vector<SlipRow>* slips : {&s.slips, &s.slips_without_bond})
        for (SlipRow& row : *slips) {
            row.leaves_out = leaves_out;
            row.of_dam = !scene.section.rock_slope;
        }
    add_equilibrium(ready, seepage, s);
    add_planes(ready, jobs, s);
    s.regressions = regression_rows(scene, s.bases.front().model, records);
    s.statistics = statistics_rows(s.slips, scene.criteria.allowable_slip);
    if (s.bases.front().model.state == sliding::StaticState::at_rest) s.needed = needed_rows(ready, jobs);
    add_warnings(scene, s, s.warnings);
    return s;
}

} // namespace damslip
