// The screening as object, text and CSV files.
#include "pages/screen/screen_report.hpp"

#include "core/file.hpp"
#include "core/version.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/anchor_tables.hpp"
#include "pages/scene/effect_table.hpp"
#include "pages/scene/report_provenance.hpp"
#include "pages/screen/screen_tables.hpp"
#include "pages/screen/wedge_tables.hpp"
#include "pages/spectrum/spectrum_tables.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace damslip::pages {

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

} // namespace

std::vector<std::string> screen_notes(const Ready& ready)
{
    std::vector<std::string> notes = note_texts(ready.given.notes);
    if (!ready.flexible_modes.empty()) notes.push_back(ready.flexible_modes);
    return notes;
}

nlohmann::ordered_json screen_json(const ScreenReportInput& in)
{
    const Screening& s = in.screening;
    const std::optional<double>& allowable = in.scene.criteria.allowable_slip;
    auto j = json_header("screen", in.scene, s.plan.scene_hash);
    j["records"] = record_provenance(in.records);
    j["effects"] = json_of(effect_table(s.plan));
    if (in.scene.wedge) {
        const RigidModel& model = s.bases.front().model;
        j["wedge"] = json_of(wedge_stability_table(in.scene, model));
        j["planes"] = json_of(wedge_plane_table(in.scene, *model.wedge));
        j["yield"] = json_of(wedge_yield_table(in.scene, *model.wedge));
    } else {
        j["limit_equilibrium"] = json_of(sliding::equilibrium_table(s.combinations));
        j["verdicts"] = json_of(sliding::verdict_table(s.combinations));
        j["yield"] = json_of(yield_table(s));
        if (!in.given.lift_joints.empty()) j["lift_joints"] = json_of(lift_joint_table(in.given));
        if (!in.given.anchors.empty()) j["anchors"] = json_of(anchor_list_table(in.given));
        j["uplift_profiles"] = json_of(sliding::uplift_comparison_table(s.uplifts));
    }
    j["displacements"] = json_of(slip_table(s, allowable));
    if (in.mean_polarity) j["mean_of_polarities"] = json_of(mean_slip_table(s));
    if (has_rocking(s)) j["rocking_block"] = json_of(rocking_table(s, allowable));
    if (!s.slips_without_bond.empty()) j["without_bond"] = json_of(bond_table(s, allowable));
    if (!in.scene.anchors.empty()) j["anchor_forces"] = json_of(screened_anchor_table(s));
    const Table events = event_table(s);
    if (!events.rows.empty()) j["events"] = json_of(events);
    if (s.flexible) j["flexible_block"] = json_of(flexible_table(s, allowable));
    if (!s.needed.empty()) j["needed"] = json_of(needed_table(s.needed, in.scene));
    j["statistics"] = json_of(statistics_table(s));
    j["regressions"] = json_of(regression_table(s.regressions));
    if (in.spectrum) j["response_spectrum"] = spectrum_json(*in.spectrum);
    const Headline headline = screen_headline(in.scene, s);
    j["headline"] = headline.sentence;
    j["verdict"] = headline.verdict;
    j["warnings"] = s.warnings;
    return j;
}

std::string screen_text(const ScreenReportInput& in)
{
    const Screening& s = in.screening;
    const std::optional<double>& allowable = in.scene.criteria.allowable_slip;
    std::string out = in.scene.title + "   (" + in.scene.file.string() + ", scene " +
                      s.plan.scene_hash.substr(0, 12) + ")\n" + effects_line(s.plan) + "\n";
    const auto show = [&out](const Table& table) {
        if (!table.rows.empty()) out += text(table) + "\n";
    };
    if (in.scene.wedge) {
        const RigidModel& model = s.bases.front().model;
        show(wedge_stability_table(in.scene, model));
        show(wedge_plane_table(in.scene, *model.wedge));
        show(wedge_yield_table(in.scene, *model.wedge));
    } else {
        out += text_by_columns(sliding::equilibrium_table(s.combinations), 3) + "\n";
        const Table checks = sliding::check_matrix(s.combinations);
        if (checks.rows.empty())
            out += "verdicts: no required values are given; name criteria.document, or required_... in "
                   "[[combination]]\n\n";
        else
            out += text_by_columns(checks, 2) + "\n";
        out += text_by_columns(yield_table(s), 1) + "\n";
        show(lift_joint_table(in.given));
        show(anchor_list_table(in.given));
        show(sliding::uplift_comparison_table(s.uplifts));
    }
    if (in.spectrum) out += spectrum_text(*in.spectrum) + "\n";
    show(regression_summary(s.regressions));
    show(slip_table(s, allowable));
    if (in.mean_polarity) show(mean_slip_table(s));
    if (has_rocking(s)) show(rocking_table(s, allowable));
    if (!s.slips_without_bond.empty()) show(bond_table(s, allowable));
    show(screened_anchor_table(s));
    if (const Table events = event_table(s); !events.rows.empty()) show(events);
    if (s.flexible) show(flexible_table(s, allowable));
    show(needed_table(s.needed, in.scene));
    show(statistics_table(s));
    const Headline headline = screen_headline(in.scene, s);
    out += headline.sentence + "\n" + headline.verdict + "\n";
    for (const std::string& warning : s.warnings) out += "note: " + warning + "\n";
    return out;
}

void write_screening(const std::filesystem::path& folder, const ScreenReportInput& in)
{
    const std::vector<std::string> comments{"damslip " + program_version(), "scene " + in.screening.plan.scene_hash};
    const std::optional<double>& allowable = in.scene.criteria.allowable_slip;
    write_file(folder / "summary.json", screen_json(in).dump(2) + "\n");
    write_file(folder / "displacements.csv", csv(slip_table(in.screening, allowable), comments));
    if (!in.scene.wedge) {
        write_file(folder / "equilibrium.csv", csv(sliding::equilibrium_table(in.screening.combinations), comments));
        write_file(folder / "verdicts.csv", csv(sliding::verdict_table(in.screening.combinations), comments));
        write_file(folder / "yield.csv", csv(yield_table(in.screening), comments));
    }
    if (has_rocking(in.screening))
        write_file(folder / "rocking_block.csv", csv(rocking_table(in.screening, allowable), comments));
    if (const Table events = event_table(in.screening); !events.rows.empty())
        write_file(folder / "events.csv", csv(events, comments));
    if (in.screening.flexible)
        write_file(folder / "flexible_block.csv", csv(flexible_table(in.screening, allowable), comments));
    if (!in.screening.needed.empty())
        write_file(folder / "needed.csv", csv(needed_table(in.screening.needed, in.scene), comments));
    write_file(folder / "scene.resolved.toml", resolved_toml(in.given));
    write_file(folder / "report.html", screen_report(in));
}

} // namespace damslip::pages
