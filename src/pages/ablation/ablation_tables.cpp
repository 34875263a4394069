#include "pages/ablation/ablation_tables.hpp"

#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

using units::mm;

Cell cell(const std::optional<double>& value, double unit = 1.0)
{
    return value ? Cell(*value / unit) : Cell();
}

bool fe(const Ablations& in)
{
    return in.plan.method == Method::finite_elements;
}

std::string name_of(const AblationPlan& plan, const std::optional<Effect>& effect)
{
    for (const Ablation& a : plan.removals)
        if (effect && a.effect == *effect) return a.name;
    return "";
}

Table change_columns(const Ablations& in)
{
    Table t;
    t.columns = {{"effect", "without", "", 4},
                 {"status", "status", "", 4},
                 {"slip_mm", "slip", "mm", 5},
                 {"change_mm", "change", "mm", 4},
                 {"change_percent", "change", "%", 3}};
    if (fe(in)) {
        t.columns.insert(t.columns.begin() + 3, {"slip_error_mm", "± step", "mm", 2});
        t.columns.insert(t.columns.begin() + 5, {"change_error_mm", "± step", "mm", 2});
        t.columns.push_back({"crest_mm", "crest", "mm", 4});
        t.columns.push_back({"crest_change_mm", "change", "mm", 3});
        t.columns.push_back({"crest_change_percent", "change", "%", 3});
        for (std::size_t k = 0; k < in.plan.full.lift_joints.size(); ++k) {
            const std::string& name = in.plan.full.lift_joints[k].name;
            t.columns.push_back({fmt::format("lift_joint_{}_slip_mm", k + 1), "slip, " + name, "mm", 5});
            t.columns.push_back({fmt::format("lift_joint_{}_change_mm", k + 1), "change", "mm", 4});
        }
    }
    t.columns.push_back({"remark", "remark", "", 4});
    return t;
}

std::vector<Cell> cells_of(const AblationRow& r, const Ablations& in)
{
    std::vector<Cell> cells{r.name, word(r.status), cell(r.slip.value, mm)};
    if (fe(in)) cells.push_back(cell(r.slip_error, mm));
    cells.push_back(cell(r.slip.change, mm));
    if (fe(in)) cells.push_back(cell(r.change_error, mm));
    cells.push_back(cell(r.slip.percent));
    if (fe(in)) {
        cells.push_back(cell(r.crest.value, mm));
        cells.push_back(cell(r.crest.change, mm));
        cells.push_back(cell(r.crest.percent));
        for (std::size_t k = 0; k < in.plan.full.lift_joints.size(); ++k) {
            const Change lift = k < r.lifts.size() ? r.lifts[k] : Change{};
            cells.push_back(cell(lift.value, mm));
            cells.push_back(cell(lift.change, mm));
        }
    }
    cells.emplace_back(r.remark);
    return cells;
}

/// The sum of the changes in one column of a change table.
Cell sum_cell(const std::string& key, const std::optional<double>& sum, const std::optional<double>& full)
{
    if (key == "effect") return std::string("(sum of changes)");
    if (key == "status") return std::string("sum");
    if (key == "change_mm") return cell(sum, mm);
    if (key == "change_percent" && sum && full.value_or(0.0) != 0.0) return 100.0 * *sum / std::abs(*full);
    if (key == "remark")
        return std::string(sum ? "without rows that are part of another" : "some run has no final slip");
    return {};
}

/// Stands before the row of the simplest scene, which it compares with.
std::vector<Cell> sum_cells(const AblationPlan& plan, const std::vector<AblationRow>& rows, const Table& t)
{
    const std::optional<double> sum = sum_of_changes(plan, rows);
    std::vector<Cell> cells;
    for (const Column& c : t.columns) cells.push_back(sum_cell(c.key, sum, rows.front().slip.value));
    return cells;
}

} // namespace

Table removal_table(const Ablations& in)
{
    Table t;
    t.title = "What takes the place of each effect";
    t.columns = {{"effect", "effect", "", 4}, {"part_of", "part of", "", 4}, {"instead", "instead", "", 4}};
    for (const Ablation& a : in.plan.removals) t.rows.push_back({a.name, name_of(in.plan, a.part_of), a.instead});
    for (const KeptEffect& k : in.plan.kept) t.rows.push_back({k.name, std::string(), "stays: " + k.why});
    return t;
}

Table change_table(const Ablations& in, std::size_t record)
{
    Table t = change_columns(in);
    t.title = "Record " + in.records[record].files.name;
    const std::vector<AblationRow> rows = rows_of(in.plan, in.runs, record);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (in.plan.simplest && i + 1 == rows.size()) t.rows.push_back(sum_cells(in.plan, rows, t));
        t.rows.push_back(cells_of(rows[i], in));
    }
    return t;
}

Table change_table_of_all(const Ablations& in)
{
    Table t = change_columns(in);
    t.title = "Changes by effect";
    t.columns.insert(t.columns.begin(), {"record", "record", "", 4});
    for (std::size_t r = 0; r < in.records.size(); ++r)
        for (std::vector<Cell>& row : change_table(in, r).rows) {
            row.insert(row.begin(), in.records[r].files.name);
            t.rows.push_back(std::move(row));
        }
    return t;
}

Table yield_change_table(const Ablations& in)
{
    Table t;
    t.title = "Yield acceleration";
    t.columns = {{"effect", "without", "", 4},
                 {"yield_acceleration_m_s2", "a_y", "m/s²", 6},
                 {"change_m_s2", "change", "m/s²", 4},
                 {"change_percent", "change", "%", 3},
                 {"critical_friction", "critical μ", "–", 6},
                 {"critical_friction_change", "change", "–", 4}};
    const std::vector<std::string> names = scene_names(in.plan);
    const SceneRuns& full = in.runs.scenes.front();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const SceneRuns& own = in.runs.scenes[i];
        const Change a = change_from(full.yield_acceleration, own.yield_acceleration),
                     mu = change_from(full.critical_friction, own.critical_friction);
        if (i == 0)
            t.rows.push_back({names[i], cell(a.value), {}, {}, cell(mu.value), {}});
        else
            t.rows.push_back(
                {names[i], cell(a.value), cell(a.change), cell(a.percent), cell(mu.value), cell(mu.change)});
    }
    t.notes.push_back("before any slip, downstream, without vertical motion; negative: slides without earthquake.");
    return t;
}

Table seconds_table(const Ablations& in)
{
    Table t;
    t.title = "Seconds";
    t.columns = {{"effect", "without", "", 4},       {"set_up_seconds", "set-up", "s", 3},
                 {"run_seconds", "runs", "s", 3},    {"seconds", "sum", "s", 3},
                 {"saved_seconds", "saved", "s", 2}, {"saved_percent", "saved", "%", 2}};
    if (fe(in)) {
        t.columns.push_back({"unknowns", "unknowns", "", 4});
        t.columns.push_back({"unknowns_saved", "saved", "", 4});
    }
    const std::vector<std::string> names = scene_names(in.plan);
    const SceneRuns& full = in.runs.scenes.front();
    const double whole = seconds_of(full).sum();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const SceneRuns& own = in.runs.scenes[i];
        const SceneSeconds s = seconds_of(own);
        std::optional<double> saved;
        if (i > 0) saved = saved_seconds(full, own);
        std::vector<Cell> row{names[i], s.set_up, s.runs, s.sum(), cell(saved), cell(saved, 0.01 * whole)};
        if (fe(in)) {
            row.emplace_back(own.unknowns);
            row.push_back(i > 0 ? Cell(full.unknowns - own.unknowns) : Cell());
        }
        t.rows.push_back(std::move(row));
    }
    t.notes.push_back("processor time of one thread, so other work on the machine does not count; saved is positive "
                      "where the simpler scene is faster.");
    if (in.runs.jobs > 1)
        t.notes.push_back(fmt::format("measured with up to {} scenes side by side, which share caches and memory: use "
                                      "--jobs 1 for seconds to rely on.",
                                      in.runs.jobs));
    return t;
}

StatusCount unanswered_runs(const AblationRuns& runs)
{
    StatusCount count;
    for (const SceneRuns& scene : runs.scenes)
        for (const RecordOutcome& r : scene.records)
            if (!is_answer(r.status)) count.add(r.status);
    if (runs.step && runs.step->missed) count.add(Status::tolerance_missed);
    return count;
}

} // namespace damslip::pages
