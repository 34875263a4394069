#include "pages/ablation/ablation_tables.hpp"

#include "core/units.hpp"
#include "pages/ablation/tornado.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/effect_table.hpp"
#include "pages/scene/limits.hpp"
#include "pages/scene/report_provenance.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

using units::mm;

/// The removal that changes the slip most under one record; null: none has a change.
const AblationRow* strongest(const AblationPlan& plan, const std::vector<AblationRow>& rows)
{
    const AblationRow* best = nullptr;
    for (std::size_t i = 1; i <= plan.removals.size(); ++i)
        if (rows[i].slip.change && !rows[i].still_sliding &&
            (!best || std::abs(*rows[i].slip.change) > std::abs(*best->slip.change)))
            best = &rows[i];
    return best;
}

/// " (-12 %)"; nothing where it would not help.
std::string percent(const std::optional<double>& value)
{
    if (!value || std::abs(*value) >= 1000.0) return "";
    return std::abs(*value) < 10.0 ? fmt::format(" ({:+.2g} %)", *value) : fmt::format(" ({:+.0f} %)", *value);
}

Drawing slip_bars(const Ablations& in, std::size_t record)
{
    const std::vector<AblationRow> rows = rows_of(in.plan, in.runs, record);
    std::vector<Bar> bars;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const AblationRow& r = rows[i];
        Bar b{r.name,
              {},
              r.change_error.value_or(0.0) / mm,
              r.slip.value ? "no change to show" : word(r.status),
              r.within_step_error};
        if (r.still_sliding && r.slip.value)
            b.words = fmt::format("still sliding after {:.4g} mm", *r.slip.value / mm);
        else if (r.slip.change) {
            b.value = *r.slip.change / mm;
            b.words = fmt::format("{:+.4g} mm", *b.value) + percent(r.slip.percent);
        }
        bars.push_back(std::move(b));
    }
    const auto& full = rows.front().slip.value;
    std::string note = full ? fmt::format("With all effects the dam slides {:.4g} mm. ", *full / mm)
                            : "With all effects: " + word(rows.front().status) + ". ";
    note += "To the right: without the effect it slides further.";
    if (in.runs.step)
        note += " Whiskers: what the time step leaves open in the change; hollow: the change is within it.";
    return tornado("Change of the slip without each effect, record " + in.records[record].files.name, std::move(bars),
                   "change of the slip [mm]", note);
}

Drawing second_bars(const Ablations& in)
{
    const std::vector<std::string> names = scene_names(in.plan);
    const double whole = seconds_of(in.runs.scenes.front()).sum();
    const bool small = whole < 0.1;
    const double unit = small ? 1e-3 : 1.0;
    const char* const word = small ? "ms" : "s";
    std::vector<Bar> bars;
    for (std::size_t i = 1; i < names.size(); ++i) {
        const std::optional<double> saved = saved_seconds(in.runs.scenes.front(), in.runs.scenes[i]);
        Bar b{names[i], {}, 0.0, "not run to the end", false};
        if (saved) {
            b.value = *saved / unit;
            b.words = fmt::format("{:+.2g} {}", *b.value, word) + percent(100.0 * *saved / whole);
        }
        bars.push_back(std::move(b));
    }
    return tornado(small ? "Milliseconds saved without each effect" : "Seconds saved without each effect",
                   std::move(bars), fmt::format("saved [{}]", word),
                   fmt::format("With all effects: {:.3g} {} of set-up and runs. To the right: faster without the "
                               "effect.{}",
                               whole / unit, word,
                               in.runs.jobs > 1 ? " Measured with several scenes side by side: not to rely on." : ""));
}

Drawing yield_bars(const Ablations& in)
{
    const std::vector<std::string> names = scene_names(in.plan);
    std::vector<Bar> bars;
    const double full = in.runs.scenes.front().yield_acceleration.value_or(std::nan(""));
    for (std::size_t i = 1; i < names.size(); ++i) {
        const auto& own = in.runs.scenes[i].yield_acceleration;
        if (!own) {
            bars.push_back({names[i], {}, 0.0, word(Status::not_resolved), false});
            continue;
        }
        const double change = *own - full;
        bars.push_back({names[i], change, 0.0, fmt::format("{:+.3g}", change), false});
    }
    return tornado("Change of the yield acceleration without each effect", std::move(bars), "change of a_y [m/s²]",
                   fmt::format("With all effects a_y = {:.4g} m/s². To the right: it slides later.", full));
}

std::string record_sentence(const Ablations& in, std::size_t record)
{
    const std::vector<AblationRow> rows = rows_of(in.plan, in.runs, record);
    const AblationRow* most = strongest(in.plan, rows);
    const std::string name = in.records[record].files.name;
    if (!rows.front().slip.value)
        return fmt::format("Record {}: the full scene ends as {}.", name, word(rows.front().status));
    if (!most) return fmt::format("Record {}: the dam slides {:.4g} mm.", name, *rows.front().slip.value / mm);
    return fmt::format("Record {}: the dam slides {:.4g} mm; most depends on {}, without it {:+.4g} mm.", name,
                       *rows.front().slip.value / mm, most->name, *most->slip.change / mm);
}

Headline headline(const Ablations& in)
{
    std::string sentence;
    for (std::size_t r = 0; r < in.records.size(); ++r) sentence += (r ? " " : "") + record_sentence(in, r);
    if (in.records.empty())
        sentence = fmt::format("The dam starts to slide at a ground acceleration of {:.4g} m/s²; no record is given.",
                               in.runs.scenes.front().yield_acceleration.value_or(std::nan("")));
    if (const StatusCount unanswered = unanswered_runs(in.runs); !unanswered.empty())
        return {sentence, Outcome::unresolved, "Runs without an answer: " + unanswered.words() + "."};
    return {sentence, Outcome::none, ""};
}

std::vector<std::pair<std::string, std::string>> key_figures(const Ablations& in)
{
    std::vector<std::pair<std::string, std::string>> list{
        {"Method", in.plan.method == Method::rigid_block ? "rigid block" : "finite elements"},
        {"Effects removed",
         fmt::format("{} of {} that are on", in.plan.removals.size(), in.plan.removals.size() + in.plan.kept.size())}};
    if (in.runs.step) list.emplace_back("Time step", fmt::format("{:.4g} s", in.runs.step->largest_dt));
    list.emplace_back("Time with all effects", fmt::format("{:.3g} s", seconds_of(in.runs.scenes.front()).sum()));
    return list;
}

std::vector<std::string> warnings(const Ablations& in)
{
    std::vector<std::string> list = record_warnings(in.records);
    const std::vector<std::string> names = scene_names(in.plan);
    for (std::size_t r = 0; r < in.records.size(); ++r)
        for (std::size_t i = 0; i < names.size(); ++i) {
            const RecordOutcome& o = in.runs.scenes[i].records[r];
            if (o.slip && !o.still_sliding) continue;
            const std::string why = o.still_sliding ? "still sliding after the run-out" : o.message;
            list.push_back(fmt::format(
                "{}, {}: {}{}{}", in.records[r].files.name, i == 0 ? "with all effects" : "without " + names[i],
                o.still_sliding ? "" : word(o.status), why.empty() || o.still_sliding ? "" : ": ", why));
        }
    return list;
}

} // namespace

Page ablation_page(const Ablations& in, const Scene& given, const EffectPlan& effects)
{
    Page page = begin_page(given, "What each effect does to the slip, and what it costs. ");
    page.headline = headline(in);
    page.key_figures = key_figures(in);
    page.warnings = warnings(in);
    for (std::size_t r = 0; r < in.records.size(); ++r)
        page.sections.push_back(
            {"Slip, record " + in.records[r].files.name,
             {slip_bars(in, r),
              rows_part(
                  change_table(in, r),
                  {"Slip: of the scene without the effect named, positive downstream; change: against the run with all "
                   "effects, positive where the slip is larger without it; ± step: what the time step leaves open."})},
             Fold::open});
    if (in.plan.method == Method::rigid_block)
        page.sections.push_back(
            {"Yield acceleration", {yield_bars(in), rows_part(yield_change_table(in))}, Fold::open});
    page.sections.push_back({"Seconds", {second_bars(in), rows_part(seconds_table(in))}, Fold::open});
    Section how{"How to read it", {rows_part(removal_table(in))}, Fold::open};
    for (std::string& note : ablation_notes(in)) how.parts.push_back(Paragraph{std::move(note)});
    page.sections.push_back(std::move(how));
    page.sections.push_back({"Effects taken into account", {effect_part(effects)}, Fold::folded});
    page.sections.push_back(limits_section(given, in.plan.method));
    page.sections.push_back({"Scene", {scene_listing(given)}, Fold::open});
    page.provenance = scene_provenance(given);
    add_record_provenance(in.records, page.provenance);
    return page;
}

nlohmann::ordered_json ablation_json(const Ablations& in, const Scene& given, const EffectPlan& effects)
{
    auto j = json_header("explain", given);
    j["method"] = in.plan.method == Method::rigid_block ? "rigid" : "fe";
    j["effects"] = json_of(effect_table(effects));
    auto& a = j["ablation"];
    a["removals"] = json_of(removal_table(in));
    if (in.runs.step)
        a["step"] = {{"substeps", in.runs.step->halvings},
                     {"dt_s", in.runs.step->largest_dt},
                     {"chosen", in.runs.step->chosen},
                     {"error_from_substeps", in.runs.step->other}};
    if (in.plan.method == Method::rigid_block) a["yield"] = json_of(yield_change_table(in));
    a["changes"] = json_of(change_table_of_all(in));
    a["notes"] = ablation_notes(in);
    a["seconds"] = {{"jobs", in.runs.jobs}, {"scenes", json_of(seconds_table(in))}};
    return j;
}

std::string ablation_text(const Ablations& in, const EffectPlan& effects)
{
    std::vector<Table> tables{effect_table(effects), removal_table(in)};
    if (in.plan.method == Method::rigid_block) tables.push_back(yield_change_table(in));
    for (std::size_t r = 0; r < in.records.size(); ++r) tables.push_back(change_table(in, r));
    tables.push_back(seconds_table(in));
    std::string all = in.plan.full.title + "\n\n" + texts(tables);
    for (const std::string& note : ablation_notes(in)) all += "note: " + note + "\n";
    return all;
}

} // namespace damslip::pages
