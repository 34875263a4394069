#include "pages/screen/screen_pages.hpp"

#include "analysis/screen/variation.hpp"
#include "core/file.hpp"
#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "core/status.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "pages/fe/fe_pages.hpp"
#include "pages/modes/modes_pages.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"
#include "scene/section.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

using units::mm;
using units::standard_gravity;

struct CheckCount {
    std::size_t judged = 0, failed = 0;
};

CheckCount count_checks(const Screening& s)
{
    CheckCount count;
    for (const sliding::Equilibrium& e : s.combinations)
        for (const sliding::Check& check : e.checks) {
            count.judged += check.verdict != sliding::Verdict::no_criterion;
            count.failed += check.verdict == sliding::Verdict::fail;
        }
    return count;
}

/// Factors of lifts and seams against those required of the base.
CheckCount count_plane_checks(const Planes& planes)
{
    CheckCount count;
    for (const PlaneRow& row : planes.rows)
        for (std::size_t k = 0; row.kind != PlaneKind::base && k < row.factors.size(); ++k)
            if (const auto& required = planes.states[k].required; required && row.factors[k]) {
                ++count.judged;
                count.failed += *row.factors[k] < *required;
            }
    return count;
}

/// Of the slides that are judged by.
StatusCount judged_statuses(const Screening& s)
{
    StatusCount count;
    for (const SlipRow& row : s.slips) count.add(row.judged().status);
    return count;
}

/// The row with the largest slip; null where none has one.
const SlipRow* largest(const Screening& s)
{
    const SlipRow* worst = nullptr;
    for (const SlipRow& row : s.slips)
        if (reported(row.judged().status, row.judged().max_slip) &&
            (!worst || row.judged().max_slip > worst->judged().max_slip))
            worst = &row;
    return worst;
}

/// The worse polarity's slip of each record that has one [m].
std::vector<double> worse_slips(const Screening& s)
{
    std::vector<double> slips;
    for (std::size_t i = 0; i + 1 < s.slips.size(); i += 2) {
        const sliding::SlideResult& r = worse(s.slips[i].judged(), s.slips[i + 1].judged());
        if (const auto slip = reported(r.status, r.max_slip)) slips.push_back(*slip);
    }
    return slips;
}

/// Runs that have no slip, by their status: "; without a slip: 2 runs away"; empty where all have one.
std::string without_slip_words(const Screening& s)
{
    StatusCount count;
    for (const SlipRow& row : s.slips)
        if (!reported(row.judged().status, row.judged().max_slip)) count.add(row.judged().status);
    return count.empty() ? "" : fmt::format("; without a slip: {} of {} runs", count.words(), s.slips.size());
}

/// What slides.
std::string slip_sentence(const Scene& scene, const Screening& s)
{
    const SlipRow* worst = largest(s);
    const std::size_t n = s.slips.size() / 2;
    const double slip = worst ? worst->judged().max_slip : 0.0;
    std::string out =
        !worst     ? fmt::format("The {} has no slip to give", sliding_body(scene))
        : slip > 0 ? fmt::format("The {} slides {:.4g} mm at most{} (record {}, polarity {:+d}{}{})",
                                 sliding_body(scene), slip / mm, n > 1 ? fmt::format(" over {} records", n) : "",
                                 worst->record, worst->polarity, worst->with_vertical ? ", with vertical motion" : "",
                                 worst->governing().method == "rocking" ? ", rocking and sliding"
                                 : worst->flexible ? fmt::format(", flexible block, {}", worst->governing().method)
                                                   : "")
                   : fmt::format("The {} does not slide in {}", sliding_body(scene),
                                 n > 1 ? fmt::format("any of the {} records", n) : "the record " + worst->record);
    const std::string without = without_slip_words(s);
    if (n > 1 && slip > 0 && without.empty())
        out += fmt::format(", median {:.4g} mm", percentile(worse_slips(s), 0.5) / mm);
    out += without;
    if (!s.bases.front().model.wedge && !scene.section.rock_slope)
        out += worst && worst->governing().method != "rigid" && worst->governing().method != "rocking"
                   ? ", by a flexible block: no bound for a dam that opens and rocks"
                   : ", by the rigid block: no bound for an elastic dam";
    if (scene.criteria.allowable_slip)
        out += fmt::format("; allowable: {:.4g} mm", *scene.criteria.allowable_slip / mm);
    return out + ".";
}

/// @param checks  of the base @param others  of lifts and seams, which have a clause of their own
std::string checks_sentence(const CheckCount& checks, const CheckCount& others)
{
    const auto words = [](const CheckCount& c, const std::string& which) {
        return c.failed > 0 ? fmt::format(" {} of {} limit-equilibrium checks{} fail.", c.failed, c.judged, which)
                            : fmt::format(" All {} limit-equilibrium checks{} pass.", c.judged, which);
    };
    std::string out;
    if (checks.judged > 0) out += words(checks, others.judged > 0 ? " of the base" : "");
    if (others.judged > 0) out += words(others, " of other planes");
    return out;
}

/// Combinations without an earthquake in which the shear exceeds the strength: the dam does not stand then, whether or not
/// a required factor is given.
std::string standing_sentence(const Screening& s)
{
    std::string out;
    for (const sliding::Equilibrium& e : s.combinations)
        if (e.k_h == 0.0 && e.k_v == 0.0 && e.sliding_factor < 1.0)
            out += fmt::format("{}{} (crack rule {}, sliding factor {:.3g})", out.empty() ? "" : ", ", e.name,
                               sliding::word(e.crack_rule), e.sliding_factor);
    return out.empty() ? "" : " Without earthquake the base does not hold in: " + out + ".";
}

std::string metres_per_second2(double a)
{
    return fmt::format("{:.4g} m/s² ({:.3g} g)", a, a / standard_gravity);
}

Section wedge_part(const Scene& scene, const RigidModel& model)
{
    Section section{"Wedge"};
    if (auto drawing = wedge_drawing(scene, *model.wedge)) section.parts.push_back(std::move(*drawing));
    section.parts.push_back(stereonet(scene, *model.wedge));
    section.parts.push_back(rows_part(wedge_stability_table(scene, model)));
    section.parts.push_back(rows_part(wedge_plane_table(scene, *model.wedge)));
    return section;
}

Section section_part(const Scene& scene, const Screening& s)
{
    if (scene.wedge) return wedge_part(scene, s.bases.front().model);
    const Scene solved = with_solved_uplift(scene, s);
    const sliding::BaseState state = sliding::base_state(solved, sliding::scene_static_case(solved));
    return {"Section", {section_drawing(scene, state.base.profile)}};
}

Section yield_section(const Scene& scene, const Screening& s)
{
    Section section{"Yield acceleration"};
    if (scene.wedge) {
        const RigidWedge& wedge = *s.bases.front().model.wedge;
        section.parts.push_back(rows_part(wedge_yield_table(scene, wedge)));
        section.parts.push_back(wedge_yield_chart(wedge, s.largest_pga));
        return section;
    }
    section.parts.push_back(TablePart{yield_table(s), Layout::columns, 1});
    section.parts.push_back(yield_over_friction(scene, s));
    if (scene.reservoir) section.parts.push_back(yield_over_level(scene, s));
    if (!scene.anchors.empty()) section.parts.push_back(rows_part(anchor_list_table(scene)));
    if (!s.uplifts.empty())
        section.parts.push_back(
            rows_part(uplift_comparison_table(s.uplifts),
                      {"U: uplift on the uncracked base, positive up; critical μ: friction that just holds the dam "
                       "without an earthquake."}));
    return section;
}

Section slip_section(const ScreenReportInput& in, const std::vector<GroundMotion>& motions)
{
    const Screening& s = in.screening;
    Section section{"Slip"};
    if (s.elastic) section.parts.push_back(rows_part(elastic_table(s, in.scene.criteria.allowable_slip)));
    section.parts.push_back(rows_part(slip_table(s, in.scene.criteria.allowable_slip)));
    if (in.mean_polarity) section.parts.push_back(rows_part(mean_slip_table(s)));
    if (has_rocking(s)) section.parts.push_back(rows_part(rocking_table(s, in.scene.criteria.allowable_slip)));
    if (!s.slips_without_bond.empty())
        section.parts.push_back(rows_part(bond_table(s, in.scene.criteria.allowable_slip)));
    if (Table anchors = screened_anchor_table(s); !anchors.rows.empty())
        section.parts.push_back(rows_part(std::move(anchors)));
    if (Table events = event_table(s); !events.rows.empty()) section.parts.push_back(rows_part(std::move(events)));
    const bool slides = !largest(s); // nothing to draw
    if (s.flexible) section.parts.push_back(rows_part(flexible_table(s, in.scene.criteria.allowable_slip)));
    if (!s.needed.empty()) section.parts.push_back(rows_part(needed_table(s.needed, in.scene)));
    if (motions.size() > 1) section.parts.push_back(rows_part(statistics_table(s)));
    if (motions.size() > 1 && !slides) section.parts.push_back(slip_by_record(s, in.scene.criteria.allowable_slip));
    if (auto chart = slip_over_friction(in.scene, s, motions, in.jobs)) section.parts.push_back(std::move(*chart));
    if (motions.size() > 2 && !slides) section.parts.push_back(slip_over_ratio(s));
    if (!s.regressions.empty())
        section.parts.push_back(TablePart{regression_summary(s.regressions), Layout::rows, 1,
                                          motions.size() > 1 ? Fold::folded : Fold::open});
    return section;
}

std::vector<Section> record_sections(const ScreenReportInput& in, const std::vector<GroundMotion>& motions)
{
    std::vector<Section> sections{records_section(motions, in.jobs)};
    std::vector<std::vector<Part>> parts(motions.size());
    parallel_for(motions.size(), in.jobs, [&](std::size_t i) {
        parts[i] = record_parts(in.scene, in.screening, motions[i], i, motions.size());
    });
    for (std::size_t i = 0; i < motions.size(); ++i)
        sections.push_back(
            {"Record " + motions[i].name, std::move(parts[i]), i < open_records ? Fold::open : Fold::folded});
    return sections;
}

std::vector<std::pair<std::string, std::string>> provenance(const ScreenReportInput& in)
{
    std::vector<std::pair<std::string, std::string>> list = scene_provenance(in.scene, in.screening.plan.scene_hash);
    list.emplace_back("method", in.scene.sliding.scheme == SlidingScheme::exact
                                    ? "rigid block, events located exactly, acceleration linear between samples"
                                    : "rigid block, SLAMMER's trapezoid scheme");
    add_record_provenance(in.records, list);
    return list;
}

std::vector<std::pair<std::string, std::string>> key_figures(const Scene& scene, const Screening& s)
{
    const RigidModel& model = s.bases.front().model;
    std::vector<std::pair<std::string, std::string>> list{
        {"Yield acceleration", metres_per_second2(model.downstream.law.constant)}};
    if (model.wedge) {
        list.emplace_back("Factor of safety", fmt::format("{:.4g}", model.wedge->still.factor_of_safety));
        list.emplace_back("Slides", direction_words(model.wedge->still.direction));
    } else {
        list.emplace_back("Friction μ", fmt::format("{:.4g}", model.block.friction));
        list.emplace_back("Needs statically μ ≥", model.critical_friction == 0.0 && model.block.cohesion_force > 0.0
                                                      ? "cohesion alone suffices"
                                                      : fmt::format("{:.4g}", model.critical_friction));
    }
    if (!s.slips.empty()) {
        list.emplace_back("Largest PGA", metres_per_second2(s.largest_pga));
        if (s.elastic && !s.elastic->runs.empty()) {
            const ContactRun& run = worst_of(s.elastic->runs);
            const std::optional<double> slip = reported(run.fe.status, run.fe.max_slip);
            list.emplace_back("Largest slip, elastic dam", slip ? fmt::format("{:.4g} mm", *slip / mm) : word(run.fe.status));
        }
        const SlipRow* worst = largest(s);
        list.emplace_back(fmt::format("Largest slip, {}", worst ? worst->governing().method : "rigid"),
                          worst ? fmt::format("{:.4g} mm", worst->judged().max_slip / mm) : "–");
        if (!without_slip_words(s).empty()) list.emplace_back("Statuses", judged_statuses(s).words());
    }
    if (scene.criteria.allowable_slip)
        list.emplace_back("Allowable slip", fmt::format("{:.4g} mm", *scene.criteria.allowable_slip / mm));
    return list;
}

std::vector<std::string> all_warnings(const ScreenReportInput& in)
{
    std::vector<std::string> list = in.screening.warnings;
    for (std::string& w : record_warnings(in.records)) list.push_back(std::move(w));
    return list;
}

/// By the rigid block, or the block that vibrates or rocks in its place. @pre there are records
Headline block_headline(const Scene& scene, const Screening& s)
{
    const std::vector<std::string> premises = broken_premises(s);
    const std::string sentence = slip_sentence(scene, s) + (premises.empty() ? "" : " But it " + premises.front() + ".");
    if (statuses_of(s).exit_code() != exit_ok) return {sentence, Outcome::unresolved, "No answer of some runs."};
    const std::optional<double>& allowable = scene.criteria.allowable_slip;
    const auto any = [&](const std::vector<SlipRow>& rows, auto&& is) { return std::ranges::any_of(rows, is); };
    const auto judged = [&](Verdict verdict) {
        return any(s.slips, [&](const SlipRow& row) { return judge(row, allowable) == verdict; });
    };
    if (judged(Verdict::fail)) return {sentence, Outcome::fail, "FAIL"};
    if (!allowable) return {sentence, Outcome::none, "No criterion for the slip."};
    if (any(s.slips, [](const SlipRow& r) { return !r.broken_premises.empty() && r.governing().method != "rocking"; }))
        return {sentence, Outcome::unresolved, "Undecided: the sliding block does not hold in this motion."};
    if (judged(Verdict::undecided) && s.slips.front().leaves_out)
        return {sentence, Outcome::unresolved, "Undecided: it leaves out what the scene asks for, see the notes."};
    if (judged(Verdict::undecided))
        return {sentence, Outcome::unresolved,
                s.flexible ? "Undecided: the base opens, which the coupled analysis does not follow."
                           : "Undecided: the error of SLAMMER's scheme is not known."};
    if (any(s.slips_without_bond, [&](const SlipRow& row) { return judge(row, allowable) != Verdict::pass; }))
        return {sentence, Outcome::unresolved, "PASS with its bond only: not for c = 0."};
    return {sentence, Outcome::pass, "PASS"};
}

/// By the elastic dam, where it was run, and the block beside it: the worse counts. The block alone is no upper bound of a dam.
Headline judged_headline(const Scene& scene, const Screening& s)
{
    Headline block = block_headline(scene, s);
    if (!s.slips.front().of_dam) return block;
    if (s.elastic && !s.elastic->runs.empty()) {
        Headline elastic = fe_headline(scene, s.elastic->runs);
        if (!s.elastic->why_not.empty()) elastic.sentence += " " + s.elastic->why_not;
        if (elastic.outcome == Outcome::fail || block.outcome != Outcome::fail) {
            if (elastic.outcome == Outcome::pass && !s.elastic->why_not.empty()) return {elastic.sentence, Outcome::unresolved, "Undecided."};
            return elastic;
        }
        block.sentence += " " + elastic.sentence;
        return block;
    }
    if (s.elastic) block.sentence += " The elastic dam was not run: " + s.elastic->why_not;
    if (block.outcome == Outcome::pass && !std::ranges::all_of(s.slips, vibrates))
        return {block.sentence, Outcome::unresolved, "Below the allowable as a rigid block; elasticity not checked."};
    return block;
}

/// Without the load combinations whose checks fail.
Headline slip_headline(const Scene& scene, const Screening& s)
{
    const RigidModel& model = s.bases.front().model;
    const CheckCount checks = count_checks(s);
    if (model.wedge && model.state != sliding::StaticState::at_rest)
        return {fmt::format("The wedge {} without any earthquake: factor of safety {:.4g}.",
                            model.state == sliding::StaticState::lifts_off
                                ? "lifts off"
                                : "slides on " + mode_words(*scene.wedge, model.wedge->still.mode),
                            model.wedge->still.factor_of_safety),
                Outcome::fail, "FAIL"};
    if (model.state == sliding::StaticState::lifts_off)
        return {fmt::format("The uplift carries more than the weight: the {} floats without any earthquake.",
                            sliding_body(scene)),
                Outcome::fail, "FAIL"};
    if (model.state != sliding::StaticState::at_rest)
        return {fmt::format("The {} slides without any earthquake: {}.", sliding_body(scene), model.why_it_fails()),
                Outcome::fail, "FAIL"};
    if (overturns(s.bases.front()))
        return {
            fmt::format("The {} tips over without any earthquake: the resultant of the static loads acts outside its "
                        "base.",
                        sliding_body(scene)),
            Outcome::fail, "FAIL"};
    const std::string pass = s.dry_base ? "PASS on a dry base" : "PASS"; // there is water, and no uplift
    if (s.slips.empty()) {
        const std::string sentence =
            fmt::format("The {} starts to slide at a ground acceleration of {}; no record is "
                        "given.",
                        sliding_body(scene), metres_per_second2(model.downstream.law.constant)) +
            checks_sentence(checks, count_plane_checks(s.planes)) + standing_sentence(s);
        if (checks.judged == 0) return {sentence, Outcome::none, "No criterion."};
        if (checks.failed)
            return {sentence, Outcome::fail, "Load combinations: FAIL " + failed_checks(s.combinations)};
        return {sentence, Outcome::pass, pass};
    }
    const std::string standing = standing_sentence(s);
    Headline slip = judged_headline(scene, s);
    slip.sentence += checks_sentence(checks, count_plane_checks(s.planes)) + standing;
    if (slip.outcome != Outcome::pass) return slip;
    if (!standing.empty()) return {slip.sentence, Outcome::unresolved, "Slip: PASS, but see the load combinations."};
    return {slip.sentence, slip.outcome, pass};
}

} // namespace

Headline screen_headline(const Scene& scene, const Screening& s)
{
    const Headline slip = with_planes(slip_headline(scene, s), s.planes, scene);
    return s.slips.empty() ? slip : with_failed_checks(slip, failed_checks(s.combinations));
}

Page screen_page(const ScreenReportInput& in)
{
    std::vector<GroundMotion> motions;
    for (const RecordPair& pair : in.records) motions.push_back(ground_motion(in.scene, pair));
    const bool elastic = in.screening.elastic && !in.screening.elastic->runs.empty();
    const std::string body = in.scene.wedge ? "wedge. " : elastic ? "block and the elastic dam. " : "block. ";
    Page page = begin_page(in.scene, "Sliding in an earthquake: screening with the rigid " + body,
                           in.screening.plan.scene_hash);
    page.headline = screen_headline(in.scene, in.screening);
    page.key_figures = key_figures(in.scene, in.screening);
    page.warnings = all_warnings(in);
    page.sections.push_back(section_part(in.scene, in.screening));
    const SlipRow* worst = largest(in.screening);
    const bool slides = worst && worst->judged().max_slip > 0.0;
    if (!in.scene.wedge && !slides) page.sections.push_back(equilibrium_section(in.screening.combinations));
    if (!motions.empty()) page.sections.push_back(slip_section(in, motions));
    if (!in.screening.planes.rows.empty()) page.sections.push_back(plane_section(in.screening.planes, in.scene));
    page.sections.push_back(yield_section(in.scene, in.screening));
    if (!in.scene.wedge && slides) page.sections.push_back(equilibrium_section(in.screening.combinations));
    if (in.spectrum) page.sections.push_back(spectrum_section(*in.spectrum));
    if (!motions.empty())
        for (Section& section : record_sections(in, motions)) page.sections.push_back(std::move(section));
    page.sections.push_back({"Effects taken into account", {effect_part(in.screening.plan)}});
    page.sections.push_back(limits_section(in.scene, Method::rigid_block));
    page.sections.push_back({"Scene", {scene_listing(in.given)}});
    page.provenance = provenance(in);
    order_sections(in.scene.criteria.report_order, page);
    return page;
}

// The screening as object, text and CSV files.

namespace {

nlohmann::ordered_json record_provenance(const std::vector<RecordPair>& records)
{
    auto list = nlohmann::ordered_json::array();
    const auto component = [](const Record& r) {
        return nlohmann::ordered_json{
            {"file", r.source.file},     {"format", r.source.format},        {"unit", r.source.unit},
            {"sha256", r.source.sha256}, {"samples", r.acceleration.size()}, {"dt_s", r.dt}};
    };
    for (const RecordPair& pair : records) {
        if (!pair.parts.empty()) {
            list.push_back({{"name", pair.files.name}, {"sequence", record_provenance(pair.parts)}});
            continue;
        }
        nlohmann::ordered_json entry{{"name", pair.files.name}, {"horizontal", component(pair.horizontal)}};
        if (pair.vertical) entry["vertical"] = component(*pair.vertical);
        list.push_back(std::move(entry));
    }
    return list;
}

std::string effects_line(const EffectPlan& plan)
{
    std::string on;
    for (const PlannedEffect& e : plan.effects)
        if (e.on) on += (on.empty() ? "" : ", ") + e.name;
    return broken_lines("effects on: " + (on.empty() ? "none" : on), "");
}

/// "Planes" -> "planes": key of a JSON object and name of a file.
std::string plane_key(const Table& table)
{
    std::string key = table.title;
    key[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(key[0])));
    return key;
}

} // namespace

std::vector<std::string> screen_notes(const Ready& ready)
{
    std::vector<std::string> notes = note_texts(ready.given.notes);
    if (!ready.flexible_modes.empty()) notes.push_back(ready.flexible_modes);
    return notes;
}

namespace {

/// What is said of the lift or seam that governs; empty: the base does.
std::string governing_plane_words(const Screening& s, const Scene& scene)
{
    if (s.planes.rows.empty()) return "";
    const PlaneRow& row = governing(s.planes, scene.planes.governs);
    if (row.kind == PlaneKind::base) return "";
    const std::string yields = row.yield > 0.0 ? fmt::format("it yields at {:.3g} g", row.yield / standard_gravity)
                                               : "it slides without any earthquake";
    const PlaneSlip* worst = row.worst();
    if (!worst || scene.planes.governs == PlaneJudgement::factor)
        return fmt::format("{}: {}; {}", row.name, factor_words(row, s.planes.states), yields);
    const auto same = std::find_if(s.slips.begin(), s.slips.end(), [&](const SlipRow& slip) {
        return slip.record == worst->record && slip.polarity == worst->polarity;
    });
    return fmt::format("{}, record {}, polarity {:+d}: {}{}", row.name, worst->record, worst->polarity,
                       same == s.slips.end() ? "" : fmt::format("PGA {:.3g} g, ", same->pga / standard_gravity), yields);
}

/// What governs, and what is to be looked at.
void add_points(const ScreenReportInput& in, Answer& answer)
{
    const Screening& s = in.screening;
    const bool elastic = s.elastic && !s.elastic->runs.empty();
    const std::string of_plane = governing_plane_words(s, in.scene); // empty: the base
    answer.point("governs", of_plane);
    const std::string base = of_plane.empty() ? "governs" : "base";
    if (elastic) {
        add_points(in.scene, s.elastic->runs, answer, base);
    } else if (const SlipRow* worst = largest(s)) {
        const double yield = s.bases.front().model.downstream.law.constant;
        answer.point(base, fmt::format("record {}, polarity {:+d}: PGA {:.3g} g, it yields at {:.3g} g", worst->record,
                                            worst->polarity, worst->pga / standard_gravity, yield / standard_gravity));
    }
    double friction = 0.0;
    if (!elastic) // what a rigid block needs is no bound for the elastic dam
        for (const NeededRow& row : s.needed) friction = std::max(friction, row.friction.value_or(0.0));
    if (friction > 0.0)
        answer.point("look at", fmt::format("friction{}: {:.3g} keeps the rigid block's slip within {:.4g} mm, given {:.3g}",
                                            of_plane.empty() ? "" : " of the base", friction, in.scene.criteria.allowable_slip.value_or(0.0) / mm,
                                            in.scene.contact.friction));
    if (!in.scene.wedge && in.scene.dam.young_modulus) answer.next("damslip fe " + in.scene.file.string());
}

} // namespace

Answer screen_answer(const ScreenReportInput& in)
{
    const Screening& s = in.screening;
    const std::optional<double>& allowable = in.scene.criteria.allowable_slip;
    Answer out(json_header("screen", in.scene, s.plan.scene_hash));
    out += in.scene.title + "   (" + in.scene.file.string() + ", scene " + s.plan.scene_hash.substr(0, 12) + ")\n" +
           effects_line(s.plan) + "\n";
    out.set("records", record_provenance(in.records));
    out.add("effects", effect_table(s.plan), {.text = false});
    if (in.scene.wedge) {
        const RigidModel& model = s.bases.front().model;
        out.add("wedge", wedge_stability_table(in.scene, model));
        out.add("planes", wedge_plane_table(in.scene, *model.wedge));
        out.add("yield", wedge_yield_table(in.scene, *model.wedge));
    } else {
        out.add("limit_equilibrium", equilibrium_table(s.combinations), {.file = "equilibrium.csv", .turned = 3});
        out.add("verdicts", verdict_table(s.combinations), {.text = false, .file = "verdicts.csv"});
        const Table checks = check_matrix(s.combinations);
        if (checks.rows.empty())
            out += "verdicts: no required values are given: criteria.document = \"FILE.toml\" would judge, such as\n"
                   "examples/criteria/canada_1999.toml, or required_... in [[combination]]\n\n";
        out.add("checks", checks, {.data = false, .turned = 2});
        out.add("criteria", criteria_table(s, in.scene), {.text = !s.planes.rows.empty(), .file = "criteria.csv"});
        out.add("yield", yield_table(s), {.file = "yield.csv", .turned = 1});
        if (!in.given.lift_joints.empty()) out.add("lift_joints", lift_joint_table(in.given));
        if (!in.given.anchors.empty()) out.add("anchors", anchor_list_table(in.given));
        out.add("uplift_profiles", uplift_comparison_table(s.uplifts));
    }
    if (in.spectrum) {
        out += spectrum_text(*in.spectrum) + "\n";
        out.set("response_spectrum", spectrum_json(*in.spectrum));
    }
    out.add("regressions", regression_table(s.regressions), {.text = false});
    out.add("regression_summary", regression_summary(s.regressions), {.data = false});
    for (const Table& table : plane_tables(s.planes, in.scene, PlaneRows::governing_lifts)) // for people
        out.add("", table, {.brief = true, .data = false});
    for (const Table& table : plane_tables(s.planes, in.scene, PlaneRows::all))
        out.add(plane_key(table), table, {.text = false, .file = plane_key(table) + ".csv"});
    if (s.elastic) out.add("elastic", elastic_table(s, allowable), {.brief = true, .file = "elastic.csv"});
    if (s.elastic && !s.elastic->why_not.empty()) out.set("elastic_not_run", s.elastic->why_not);
    const bool elastic = s.elastic && !s.elastic->runs.empty(); // its table has the block's slip beside its own
    out.add("displacements", slip_table(s, allowable), {.brief = !elastic, .file = "displacements.csv"});
    const auto add_known = [&](const std::string& id, const Table& table, Places places = {}) {
        if (!table.rows.empty()) out.add(id, table, places);
    };
    if (in.mean_polarity) out.add("mean_of_polarities", mean_slip_table(s));
    if (has_rocking(s)) out.add("rocking_block", rocking_table(s, allowable), {.file = "rocking_block.csv"});
    if (!s.slips_without_bond.empty()) out.add("without_bond", bond_table(s, allowable));
    if (!in.scene.anchors.empty()) out.add("anchor_forces", screened_anchor_table(s));
    add_known("events", event_table(s), {.file = "events.csv"});
    if (s.flexible) out.add("flexible_block", flexible_table(s, allowable), {.file = "flexible_block.csv"});
    add_known("needed", needed_table(s.needed, in.scene), {.file = "needed.csv"});
    out.add("statistics", statistics_table(s));
    const Headline headline = screen_headline(in.scene, s);
    out.headline(headline);
    out.set("headline", headline.sentence);
    out.set("verdict", headline.verdict);
    out.set("warnings", s.warnings);
    add_points(in, out);
    if (in.spectrum) out.point("response spectrum", spectrum_sentence(*in.spectrum));
    for (const std::string& warning : s.warnings) out.note(warning);
    return out;
}

void write_screening(const std::filesystem::path& folder, const ScreenReportInput& in, const Answer& answer)
{
    answer.write(folder, {"damslip " + program_version(), "scene " + in.screening.plan.scene_hash});
    write_file(folder / "scene.resolved.toml", resolved_toml(in.given));
    write_file(folder / "report.html", page_html(screen_page(in)));
}

} // namespace damslip::pages
