#include "cli/screen_command.hpp"

#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "core/version.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/effect_table.hpp"
#include "pages/screen/screen_report.hpp"
#include "pages/screen/screen_tables.hpp"
#include "pages/screen/wedge_tables.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/equilibrium_tables.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

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
        nlohmann::ordered_json entry{{"name", pair.files.name}, {"horizontal", component(pair.horizontal)}};
        if (pair.vertical) entry["vertical"] = component(*pair.vertical);
        list.push_back(std::move(entry));
    }
    return list;
}

nlohmann::ordered_json summary(const Scene& given, const Scene& scene, const Screening& s,
                               const std::vector<RecordPair>& records)
{
    auto j = json_header("screen");
    j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(scene)}};
    j["records"] = record_provenance(records);
    j["effects"] = json_of(effect_table(s.plan));
    if (scene.wedge) {
        const RigidModel& model = s.bases.front().model;
        j["wedge"] = json_of(wedge_stability_table(scene, model));
        j["planes"] = json_of(wedge_plane_table(scene, *model.wedge));
        j["yield"] = json_of(wedge_yield_table(scene, *model.wedge));
        j["displacements"] = json_of(slip_table(s, scene.criteria.allowable_slip));
        j["statistics"] = json_of(statistics_table(s));
        j["regressions"] = json_of(regression_table(s));
        j["warnings"] = s.warnings;
        return j;
    }
    j["limit_equilibrium"] = json_of(sliding::equilibrium_table(s.combinations));
    j["verdicts"] = json_of(sliding::verdict_table(s.combinations));
    j["yield"] = json_of(yield_table(s));
    if (!given.lift_joints.empty()) j["lift_joints"] = json_of(lift_joint_table(given));
    j["uplift_profiles"] = json_of(sliding::uplift_comparison_table(s.uplifts));
    j["displacements"] = json_of(slip_table(s, scene.criteria.allowable_slip));
    if (s.flexible) j["flexible_block"] = json_of(flexible_table(s, scene.criteria.allowable_slip));
    j["statistics"] = json_of(statistics_table(s));
    j["regressions"] = json_of(regression_table(s));
    j["warnings"] = s.warnings;
    return j;
}

std::string effects_line(const EffectPlan& plan)
{
    std::string on;
    for (const PlannedEffect& e : plan.effects)
        if (e.on) on += (on.empty() ? "" : ", ") + e.name;
    return "effects on: " + (on.empty() ? "none" : on) + "\n";
}

/// The verdicts that have a criterion.
Table judged(Table verdicts)
{
    const auto column = std::find_if(verdicts.columns.begin(), verdicts.columns.end(),
                                     [](const Column& c) { return c.key == "verdict"; });
    const auto j = static_cast<std::size_t>(column - verdicts.columns.begin());
    std::erase_if(verdicts.rows, [j](const auto& row) { return row[j] == Cell(std::string("no criterion")); });
    return verdicts;
}

void print_text(const Scene& given, const Scene& scene, const Screening& s, std::ostream& out)
{
    out << scene.title << "   (" << scene.file.string() << ", scene " << scene_hash(scene).substr(0, 12) << ")\n"
        << effects_line(s.plan) << "\n";
    const auto show = [&out](const Table& table) {
        if (!table.rows.empty()) out << pages::text(table) << "\n";
    };
    if (scene.wedge) {
        const RigidModel& model = s.bases.front().model;
        show(wedge_stability_table(scene, model));
        show(wedge_plane_table(scene, *model.wedge));
        show(wedge_yield_table(scene, *model.wedge));
        show(regression_summary(s));
        show(slip_table(s, scene.criteria.allowable_slip));
        show(statistics_table(s));
        for (const std::string& warning : s.warnings) out << "note: " << warning << "\n";
        return;
    }
    out << pages::text_by_columns(sliding::equilibrium_table(s.combinations), 3) << "\n";
    const Table verdicts = judged(sliding::verdict_table(s.combinations));
    if (verdicts.rows.empty())
        out << "verdicts: no required values are given; name criteria.document, or required_... in [[combination]]\n\n";
    show(verdicts);
    show(yield_table(s));
    show(lift_joint_table(given));
    show(sliding::uplift_comparison_table(s.uplifts));
    show(regression_summary(s));
    show(slip_table(s, scene.criteria.allowable_slip));
    if (s.flexible) show(flexible_table(s, scene.criteria.allowable_slip));
    show(statistics_table(s));
    for (const std::string& warning : s.warnings) out << "note: " << warning << "\n";
}

} // namespace

int screen(const ScreenArguments& arguments, const Streams& streams)
{
    PrepareOptions options;
    options.flexible_modes = true;
    options.stop = streams.stop;
    const Ready ready = prepare(read_run_scene(arguments.inputs, streams), Method::rigid_block, options);
    const Scene &given = ready.given, &scene = ready.scene;
    const std::vector<RecordPair>& records = ready.records();
    for (const RecordPair& pair : records)
        for (const Record* r : {&pair.horizontal, pair.vertical ? &*pair.vertical : nullptr})
            if (r && !streams.quiet)
                for (const std::string& warning : r->warnings)
                    streams.talk << "note: " << pair.files.name << ": " << warning << "\n";

    Screening s = run_screening(ready, arguments.jobs);
    for (std::string& note : note_texts(given.notes)) s.warnings.push_back(std::move(note));
    if (!ready.flexible_modes.empty()) s.warnings.push_back(ready.flexible_modes);
    if (!given.lift_joints.empty())
        s.warnings.push_back(fmt::format("Combinations and displacements are of the base only; slip on the {} "
                                         "[[lift_joint]] is left to `damslip fe`.",
                                         given.lift_joints.size()));
    if (streams.form == Form::json)
        streams.out << summary(given, scene, s, records).dump(2) << "\n";
    else
        print_text(given, scene, s, streams.out);

    if (!arguments.out.empty()) {
        write_file(arguments.out / "summary.json", summary(given, scene, s, records).dump(2) + "\n");
        write_file(arguments.out / "displacements.csv",
                   pages::csv(slip_table(s, scene.criteria.allowable_slip),
                              {"damslip " + program_version(), "scene " + scene_hash(scene)}));
        if (s.flexible)
            write_file(arguments.out / "flexible_block.csv",
                       pages::csv(flexible_table(s, scene.criteria.allowable_slip),
                                  {"damslip " + program_version(), "scene " + scene_hash(scene)}));
        write_file(arguments.out / "scene.resolved.toml", resolved_toml(given));
        const std::filesystem::path page = arguments.out / "report.html";
        write_file(page, screen_report({given, scene, s, records, arguments.jobs}));
        if (!streams.quiet)
            streams.talk << "written: " << (arguments.out / "summary.json").string() << ", displacements.csv, "
                         << (s.flexible ? "flexible_block.csv, " : "")
                         << "scene.resolved.toml\nreport: " << page.string() << "\n";
    }
    return statuses_of(s).exit_code();
}

} // namespace damslip::cli
