#include "pages/assess/assess_pages.hpp"

#include "core/text.hpp"
#include "core/units.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"
#include "scene/section.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

using units::mm;

const char* model_of(AssessPart part)
{
    return word_in(part, {{AssessPart::rigid_block, "limit equilibrium, regressions, rigid block"},
                          {AssessPart::flexible_block, "flexible block"},
                          {AssessPart::finite_elements, "finite elements"},
                          {AssessPart::spectrum, "response spectrum"},
                          {AssessPart::rigid_effects, "rigid block without each effect"},
                          {AssessPart::variants, "finite elements, one assumption changed"}});
}

const char* why(AssessPart part)
{
    return word_in(part, {{AssessPart::rigid_block, "checks of the load combinations; order of the slip"},
                          {AssessPart::flexible_block, "whether the dam's first mode moves the rigid block's slip"},
                          {AssessPart::finite_elements, "elastic dam that slides, opens and rocks: decides the slip"},
                          {AssessPart::spectrum, "how much the dam amplifies each record"},
                          {AssessPart::rigid_effects, "which assumption moves the block's slip"},
                          {AssessPart::variants, "range of the answer; which assumption moves it"}});
}

/// What a part of a finished assessment says, in a few words.
std::string came_out(AssessPart part, const Assessment& a)
{
    const auto slip = [&](SlipLevel level, bool ran) {
        std::optional<double> most;
        for (const MotionOutcome& l : a.levels)
            if (l.level == level && l.largest_slip) most = std::max(most.value_or(0.0), *l.largest_slip);
        return !ran ? "not run" : most ? fmt::format("{:.4g} mm", *most / mm) : "no slip";
    };
    const auto done = [](bool ran) { return std::string(ran ? "done" : "not run"); };
    switch (part) {
    case AssessPart::rigid_block:
        return slip(SlipLevel::rigid_block, true);
    case AssessPart::flexible_block:
        return slip(SlipLevel::flexible_block, bool(a.flexible));
    case AssessPart::finite_elements:
        return slip(SlipLevel::finite_elements, !a.runs.empty());
    case AssessPart::spectrum:
        return done(bool(a.spectrum));
    case AssessPart::rigid_effects:
        return done(bool(a.rigid_ablation));
    case AssessPart::variants:
        return a.assumptions.empty() ? "not run" : fmt::format("{} runs", a.assumptions.size());
    }
    return "";
}

std::string purpose(const WorkPlan& plan, const Scene& given)
{
    const std::size_t records = plan.ready.records().size();
    const auto& allowable = given.criteria.allowable_slip;
    return fmt::format("How far the {} slides under {} record{}, which model says so and how far that may be off; {}.",
                       sliding_body(given), records, records == 1 ? "" : "s",
                       allowable ? fmt::format("judged by an allowable slip of {:.4g} mm", *allowable / mm)
                                 : "no allowable slip is given, so the slip has no verdict");
}

std::string cost(const WorkPlan& plan)
{
    std::string text = fmt::format("About {:.2g} s of the budget of {:.4g} s, estimated from short pieces on this machine.",
                                   plan.seconds(), plan.budget);
    std::string unknown;
    for (const PlannedPart& p : plan.parts)
        if (p.left_out.empty() && !p.seconds) unknown += std::string(unknown.empty() ? "" : "; ") + model_of(p.part);
    if (!unknown.empty())
        text += " Not estimated, for the dam does not stand before the earthquake: " + unknown + ".";
    const auto over =
        std::ranges::count_if(plan.parts, [](const PlannedPart& p) { return p.left_out.empty() && !p.fits; });
    if (over > 0)
        text += fmt::format(" The budget does not hold {} of {} parts whole: raise --budget, or agree to what it leaves out.",
                            over, plan.parts.size());
    return text;
}

/// @param on  what the models include, or leave out
Table effects_of(const WorkPlan& plan, bool on)
{
    Table table = effect_table((plan.fe ? *plan.fe : plan.ready).plan, on);
    table.title = on ? "Premises: what the models include" : "Left out";
    return table;
}

Table value_table(const Scene& given)
{
    return table_of<UsualValue>("Values to agree on",
                              {{{"key", "key"}, &UsualValue::key},
                               {{"value", "value"}, &UsualValue::value},
                               {{"usual", "usual"}, [](const UsualValue& v) { return usual_text(v.usual, v.unit); }}},
                              usual_values(given),
                              {"those of the scene that have a usual range, defaults included; all are in scene.resolved.toml of --out."});
}

std::vector<GroundMotion> motions_of(const Ready& ready)
{
    std::vector<GroundMotion> motions;
    for (const RecordPair& pair : ready.records()) motions.push_back(ready.motion(pair));
    return motions;
}

constexpr const char* agreement =
    "the models and their order, the premises and what is left out, the values, the records and their scale, and what is "
    "judged by what. The slip that comes out then stands, whatever it is.";

std::vector<std::string> plan_notes(const WorkPlan& plan)
{
    std::vector<std::string> notes = note_texts(plan.ready.given.notes);
    if (!plan.rock_change.empty()) notes.push_back(plan.rock_change);
    for (const PlannedPart& part : plan.parts)
        if (!part.left_out.empty()) notes.push_back(fmt::format("{}: {}", model_of(part.part), part.left_out));
    return notes;
}

} // namespace

Table work_plan_table(const WorkPlan& plan, const Assessment* done)
{
    using P = PlannedPart;
    std::vector<ColumnOf<P>> columns{
        {in_brief({"model", "model"}), [](const P& p) { return model_of(p.part); }},
        {in_brief({"motions", "motions"}), &P::runs},
        {in_brief({"estimated_s", "estimated", "s", 2}), &P::seconds},
        {in_brief({"fits", "fits"}), [](const P& p) {
             return !p.left_out.empty() ? "cannot run" : !p.seconds ? "not known" : p.fits ? "yes" : "not whole";
         }}};
    if (done) {
        columns.push_back({{"took_s", "took", "s", 2}, [done](const P& p) {
                               const auto it = done->seconds_of.find(p.part);
                               return it == done->seconds_of.end() ? Cell() : Cell(it->second);
                           }});
        columns.push_back({{"came_out", "came out"}, [done](const P& p) { return came_out(p.part, *done); }});
    }
    columns.push_back({{"why", "why"}, [](const P& p) { return why(p.part); }});
    return table_of<P>("Models in their order", columns, plan.parts,
                       {"motions: records times polarities, of each model; of the changed assumptions one each, on the worst motion."});
}

Table judgement_table(const Ready& ready)
{
    struct Row {
        std::string quantity, required, by, source;
    };
    std::vector<Row> rows;
    if (const auto& allowable = ready.given.criteria.allowable_slip)
        rows.push_back({"largest slip, with its error", fmt::format("≤ {:.4g} mm", *allowable / mm),
                        "finite elements; without them a block, which gives no PASS", "criteria.allowable_slip"});
    for (const sliding::Equilibrium& e : ready.combinations())
        for (const sliding::Check& check : e.checks)
            if (check.required) {
                const char* const sign = check.quantity.starts_with("resultant") ? "≤" : "≥";
                rows.push_back({fmt::format("{}: {}", e.name, check.quantity), fmt::format("{} {:.4g}", sign, *check.required),
                                "limit equilibrium", check.source});
            }
    return table_of<Row>("What is judged by what",
                         {{{"quantity", "quantity"}, &Row::quantity},
                          {{"required", "required"}, &Row::required},
                          {{"by", "by"}, &Row::by},
                          {{"source", "source"}, &Row::source}},
                         rows);
}

Page work_plan_page(const WorkPlan& plan, const Scene& given)
{
    Page page = begin_page(given, "Work plan: what an assessment is going to do. ");
    page.headline = {purpose(plan, given)};
    page.key_figures = {{"Cost", fmt::format("{:.2g} s", plan.seconds())}, {"Budget", fmt::format("{:.4g} s", plan.budget)}};
    page.warnings = plan_notes(plan);
    page.sections.push_back({"To agree on before it runs", {Paragraph{std::string("A reviewer agrees to ") + agreement}}});
    page.sections.push_back({"Models in their order", {rows_part(work_plan_table(plan)), Paragraph{cost(plan)}}});
    Section judged{"What is judged by what", {}};
    if (Table table = judgement_table(plan.ready); !table.rows.empty())
        judged.parts.push_back(rows_part(std::move(table)));
    else
        judged.parts.push_back(Paragraph{"Nothing: give criteria.allowable_slip_mm and criteria.document."});
    page.sections.push_back(std::move(judged));
    page.sections.push_back({"Values to agree on", {rows_part(value_table(given)), record_part(record_table(motions_of(plan.ready)))}});
    page.sections.push_back({"Premises", {rows_part(effects_of(plan, true))}});
    page.sections.push_back({"Left out", {rows_part(effects_of(plan, false))}});
    page.sections.push_back(limits_section(plan.ready.scene, plan.fe ? Method::finite_elements : Method::rigid_block));
    end_page(given, plan.ready.records(), page);
    return page;
}

Answer work_plan_answer(const WorkPlan& plan, const Scene& given)
{
    Answer all(json_header("plan", given));
    all += given.title + "\n\n";
    all.headline({purpose(plan, given)});
    all += "\n";
    all.set("seconds", plan.seconds());
    all.set("budget_seconds", plan.budget);
    all.add("models", work_plan_table(plan), {.brief = true});
    all.add("judged", judgement_table(plan.ready));
    all.add("values", value_table(given));
    all.add("records", record_table(motions_of(plan.ready)));
    all.add("premises", effects_of(plan, true));
    all.add("left_out", effects_of(plan, false));
    all.point("cost", cost(plan));
    all.point("agree before it runs", agreement);
    all += cost(plan) + "\n" + broken_lines(std::string("Agree before it runs: ") + agreement, "") + "\n\n";
    all.notes("notes", plan_notes(plan));
    all.next("damslip assess " + given.file.string() + fmt::format(" --budget {:g}", plan.budget));
    return all;
}

} // namespace damslip::pages
