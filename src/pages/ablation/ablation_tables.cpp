#include "pages/ablation/ablation_pages.hpp"

#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

using units::mm;

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

AblationRow sum_row(const AblationPlan& plan, const std::vector<AblationRow>& rows)
{
    AblationRow row{rows.front().motion, "(sum of changes)", "sum"};
    row.remark = "some run has no final slip";
    const double full = rows.front().slip.value.value_or(0.0);
    if (const std::optional<double> sum = sum_of_changes(plan, rows)) {
        row.slip.change = sum;
        if (full != 0.0) row.slip.percent = 100.0 * *sum / std::abs(full);
        row.remark = "without rows that are part of another";
    }
    return row;
}

/// The sum stands before the row of the simplest scene, which it compares with.
void add_changes(const Ablations& in, std::size_t motion, std::vector<AblationRow>& list)
{
    std::vector<AblationRow> rows = rows_of(in.plan, in.runs, motion);
    if (in.plan.simplest) rows.insert(rows.end() - 1, sum_row(in.plan, rows));
    list.insert(list.end(), rows.begin(), rows.end());
}

std::vector<ColumnOf<AblationRow>> change_columns(const Ablations& in)
{
    using R = AblationRow;
    const ColumnOf<R> slip_error{in_brief({"slip_error_mm", "± step", "mm", 2}),
                                 [](const R&r) { return optional_cell(r.slip_error, mm); }},
        change_error{in_brief({"change_error_mm", "± step", "mm", 2}),
                     [](const R&r) { return optional_cell(r.change_error, mm); }};
    std::vector<ColumnOf<R>> columns{
        {in_brief({"effect", "without"}), &R::name},
        {in_brief({"status", "status"}), &R::status},
        {in_brief({"slip_mm", "slip", "mm", 5}), [](const R& r) { return optional_cell(r.slip.value, mm); }}};
    if (fe(in)) columns.push_back(slip_error);
    columns.push_back({ranking({"change_mm", "change", "mm", 4}), [](const R& r) { return optional_cell(r.slip.change, mm); }});
    if (fe(in)) columns.push_back(change_error);
    columns.push_back({in_brief({"change_percent", "change", "%", 3}), [](const R& r) { return optional_cell(r.slip.percent); }});
    if (fe(in)) {
        columns.push_back(
            {{"crest_mm", "crest", "mm", 4}, [](const R& r) { return optional_cell(r.crest.value, mm); }});
        columns.push_back(
            {{"crest_change_mm", "change", "mm", 3}, [](const R& r) { return optional_cell(r.crest.change, mm); }});
        columns.push_back(
            {{"crest_change_percent", "change", "%", 3}, [](const R& r) { return optional_cell(r.crest.percent); }});
        for (std::size_t k = 0; k < in.plan.full.lift_joints.size(); ++k) {
            const std::string key = fmt::format("lift_joint_{}_", k + 1);
            columns.push_back({{key + "slip_mm", "slip, " + in.plan.full.lift_joints[k].name, "mm", 5},
                               [k](const R& r) { return k < r.lifts.size() ? optional_cell(r.lifts[k].value, mm) : Cell(); }});
            columns.push_back({{key + "change_mm", "change", "mm", 4},
                               [k](const R& r) { return k < r.lifts.size() ? optional_cell(r.lifts[k].change, mm) : Cell(); }});
        }
    }
    columns.push_back({in_brief({"remark", "remark"}), &R::remark});
    return columns;
}

} // namespace

Table removal_table(const Ablations& in)
{
    struct Row {
        std::string effect, part_of, instead;
    };
    std::vector<Row> rows;
    for (const Ablation& a : in.plan.removals) rows.push_back({a.name, name_of(in.plan, a.part_of), a.instead});
    for (const KeptEffect& k : in.plan.kept) rows.push_back({k.name, "", "stays: " + k.why});
    return table_of<Row>("What takes the place of each effect",
                         {{{"effect", "effect"}, &Row::effect},
                          {{"part_of", "part of"}, &Row::part_of},
                          {{"instead", "instead"}, &Row::instead}},
                         rows);
}

Table change_table(const Ablations& in, std::size_t motion)
{
    std::vector<AblationRow> rows;
    add_changes(in, motion, rows);
    return table_of("Record " + in.runs.motions[motion].label(), change_columns(in), rows);
}

Table change_table_of_all(const Ablations& in)
{
    std::vector<AblationRow> rows;
    for (std::size_t r = 0; r < in.runs.motions.size(); ++r) add_changes(in, r, rows);
    std::vector<ColumnOf<AblationRow>> columns = change_columns(in);
    columns.insert(columns.begin(), {{{"record", "record"}, [](const AblationRow& r) { return r.motion.record; }},
                                     {{"polarity", "polarity"}, [](const AblationRow& r) { return r.motion.polarity; }}});
    return table_of("Changes by effect", columns, rows);
}

Table yield_change_table(const Ablations& in)
{
    struct Row {
        std::string name;
        Change yield, critical_friction;
    };
    const std::vector<std::string> names = scene_names(in.plan);
    const VariantRuns& full = in.runs.scenes.front();
    std::vector<Row> rows{{names[0], {full.yield_acceleration, {}, {}}, {full.critical_friction, {}, {}}}};
    for (std::size_t i = 1; i < names.size(); ++i) {
        const VariantRuns& own = in.runs.scenes[i];
        rows.push_back({names[i], change_from(full.yield_acceleration, own.yield_acceleration),
                        change_from(full.critical_friction, own.critical_friction)});
    }
    return table_of<Row>(
        "Yield acceleration",
        {{in_brief({"effect", "without"}), &Row::name},
         {in_brief({"yield_acceleration_m_s2", "a_y", "m/s²", 6}), [](const Row& r) { return optional_cell(r.yield.value); }},
         {{"change_m_s2", "change", "m/s²", 4}, [](const Row& r) { return optional_cell(r.yield.change); }},
         {ranking({"change_percent", "change", "%", 3}), [](const Row& r) { return optional_cell(r.yield.percent); }},
         {{"critical_friction", "critical μ", "–", 6},
          [](const Row& r) { return optional_cell(r.critical_friction.value); }},
         {{"critical_friction_change", "change", "–", 4},
          [](const Row& r) { return optional_cell(r.critical_friction.change); }}},
        rows, {"before any slip, downstream, without vertical motion; negative: slides without earthquake."});
}

Table seconds_table(const Ablations& in)
{
    struct Row {
        std::string name;
        const VariantRuns& runs;
        std::optional<double> saved;
        std::optional<std::int64_t> unknowns_saved = {};

        std::int64_t unknowns() const { return runs.unknowns.value_or(0); }
    };
    const std::vector<std::string> names = scene_names(in.plan);
    const VariantRuns& full = in.runs.scenes.front();
    std::vector<Row> rows{{names[0], full, {}}};
    for (std::size_t i = 1; i < names.size(); ++i) {
        rows.push_back({names[i], in.runs.scenes[i], saved_seconds(full, in.runs.scenes[i])});
        rows.back().unknowns_saved = rows.front().unknowns() - rows.back().unknowns();
    }
    const double percent = 0.01 * full.all_seconds();
    std::vector<ColumnOf<Row>> columns{
        {{"effect", "without"}, &Row::name},
        {{"set_up_seconds", "set-up", "s", 3}, [](const Row& r) { return r.runs.set_up_seconds; }},
        {{"run_seconds", "runs", "s", 3}, [](const Row& r) { return r.runs.run_seconds(); }},
        {{"seconds", "sum", "s", 3}, [](const Row& r) { return r.runs.all_seconds(); }},
        {{"saved_seconds", "saved", "s", 2}, [](const Row& r) { return optional_cell(r.saved); }},
        {{"saved_percent", "saved", "%", 2}, [=](const Row& r) { return optional_cell(r.saved, percent); }}};
    if (fe(in)) {
        columns.push_back({{"unknowns", "unknowns"}, &Row::unknowns});
        columns.push_back({{"unknowns_saved", "saved"}, [](const Row& r) { return optional_cell(r.unknowns_saved); }});
    }
    Table t = table_of("Seconds", columns, rows,
                       {"processor time of one thread, so other work on the machine does not count; saved is positive "
                        "where the simpler scene is faster."});
    if (in.runs.jobs > 1)
        t.notes.push_back(fmt::format("measured with up to {} scenes side by side, which share caches and memory: use "
                                      "--jobs 1 for seconds to rely on.",
                                      in.runs.jobs));
    return t;
}

StatusCount unanswered_runs(const AblationRuns& runs)
{
    StatusCount count;
    for (const VariantRuns& scene : runs.scenes)
        for (const MotionOutcome& r : scene.motions)
            if (!is_answer(r.status)) count.add(r.status);
    if (runs.step && runs.step->missed) count.add(Status::tolerance_missed);
    return count;
}

} // namespace damslip::pages
