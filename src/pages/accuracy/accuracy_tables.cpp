#include "pages/accuracy/accuracy_tables.hpp"

#include "core/status_count.hpp"
#include "core/units.hpp"

#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

using units::mm;

Cell millimetres(const std::optional<double>& metres)
{
    return metres ? Cell(*metres / mm) : Cell();
}

template <class Number>
Cell optional_cell(const std::optional<Number>& value)
{
    return value ? Cell(*value) : Cell();
}

/// Of the list; empty for a rung that was skipped, and for a regression, which gives an estimate and no run.
Cell status_cell(const RungResult& r)
{
    if (r.outcome == RungOutcome::skipped) return {};
    if (r.done() && r.rung.family == RungFamily::regression) return {};
    return word(r.status);
}

std::string remark_of(const RungResult& r)
{
    switch (r.outcome) {
    case RungOutcome::done:
    case RungOutcome::failed:
    case RungOutcome::refused:
        return r.remark;
    case RungOutcome::skipped:
        return "skipped: " + r.remark;
    case RungOutcome::stopped:
        return "";
    }
    return "";
}

Cell of_record(const std::vector<double>& values, std::size_t record)
{
    return record < values.size() ? Cell(values[record] / mm) : Cell();
}

std::vector<Cell> rung_row(const RungResult& r, const RungVerdict& v, const Judgement& j)
{
    const bool done = r.done();
    const std::optional<double> top =
        done && j.top && v.off_top ? std::optional(r.slip[j.record] - *v.off_top) : std::nullopt;
    const bool relative = top && std::abs(*top) >= least_slip;
    return {rung_id(r.rung),
            of_record(r.slip, j.record),
            of_record(r.low, j.record),
            of_record(r.high, j.record),
            millimetres(v.error),
            millimetres(v.model_difference),
            millimetres(v.off_top),
            relative ? Cell(100.0 * *v.off_top / std::abs(*top)) : Cell(),
            v.deviation ? Cell(100.0 * *v.deviation) : Cell(),
            v.front ? Cell(true) : Cell(),
            done ? Cell(r.seconds) : Cell(),
            done ? Cell(r.set_up_seconds) : Cell(),
            done ? Cell(std::int64_t{r.repeats}) : Cell(),
            done && r.bytes ? Cell(*r.bytes / 1e6) : Cell(),
            optional_cell(r.unknowns),
            optional_cell(r.time_step),
            optional_cell(r.steps),
            status_cell(r),
            remark_of(r)};
}

} // namespace

Table rung_table(const std::vector<RungResult>& results, const Judgement& j)
{
    Table t;
    t.title = "Rungs";
    t.columns = {{"rung", "rung", "", 4},
                 {"slip_mm", "slip", "mm", 5},
                 {"slip_16_mm", "16 %", "mm", 3},
                 {"slip_84_mm", "84 %", "mm", 3},
                 {"error_mm", "± steps, mesh", "mm", 2},
                 {"model_difference_mm", "model − top's", "mm", 3},
                 {"off_top_mm", "slip − top's", "mm", 3},
                 {"off_top_percent", "slip − top's", "%", 3},
                 {"deviation_percent", "deviation", "%", 3},
                 {"front", "front", "", 4},
                 {"seconds", "time", "s", 3},
                 {"set_up_seconds", "set-up", "s", 2},
                 {"repeats", "runs", "", 4},
                 {"megabytes", "memory", "MB", 3},
                 {"unknowns", "unknowns", "", 4},
                 {"time_step_s", "step", "s", 4},
                 {"steps", "steps", "", 4},
                 {"status", "status", "", 4},
                 {"remark", "remark", "", 4}};
    for (std::size_t i = 0; i < results.size(); ++i) t.rows.push_back(rung_row(results[i], j.rungs[i], j));
    t.notes = {
        "± steps, mesh: estimate of what steps, elements, penalty and modes leave open, from the rungs of the same "
        "model; "
        "model − top's: difference of the limits of both models.",
        "deviation: (|slip − top's| + what the top rung leaves open) over the top's slip, the worst record; front: no "
        "rung as fast deviates less.",
        "time: processor time of all that this rung costs alone, reading and set-up included, median of the runs; "
        "memory: growth of the "
        "resident memory to its peak during the first run.",
        "dt/4: a quarter of the record's step; dt=auto: chosen by time.slip_tolerance, the default of `fe`; "
        "dt=adaptive: the same with time.stepping = \"adaptive\"; 2h, h/2: "
        "elements of twice and half the scene's size; q8: quadratic elements of the size before it; stick: penalty in "
        "N/m³."};
    if (j.top && results[*j.top].slip.size() > 1)
        t.notes.push_back("slips and millimetres: of the record that slides the top rung furthest.");
    return t;
}

Table model_table(const std::vector<RungResult>& results, const Judgement& j)
{
    Table t;
    t.title = "Models and their limits";
    t.columns = {{"model", "model", "", 4},
                 {"limit_mm", "limit", "mm", 5},
                 {"open_mm", "± open", "mm", 2},
                 {"off_top_percent", "model − top's", "%", 3},
                 {"order_step", "order in step", "", 3},
                 {"order_mesh", "in mesh", "", 3},
                 {"order_penalty", "in 1/penalty", "", 3},
                 {"order_modes", "in 1/modes", "", 3}};
    if (!j.top) return t;
    const std::string top = model_of(results[*j.top].rung);
    double reference = results[*j.top].slip[j.record];
    for (const ModelLimit& m : j.models)
        if (m.model == top) reference = m.slip[j.record];
    for (const ModelLimit& m : j.models)
        t.rows.push_back({m.model, m.slip[j.record] / mm, m.open[j.record] / mm,
                          std::abs(reference) >= least_slip
                              ? Cell(100.0 * (m.slip[j.record] - reference) / std::abs(reference))
                              : Cell(),
                          optional_cell(m.order_step), optional_cell(m.order_mesh), optional_cell(m.order_penalty),
                          optional_cell(m.order_modes)});
    t.notes.push_back(
        "limit: step and element size to zero, by Richardson's extrapolation with the observed order (held "
        "between 1 and 2); the rigid block is located exactly. Orders are those the last three rungs show.");
    for (const ModelLimit& m : j.models)
        if (!m.mesh_known && m.model.starts_with("fe-"))
            t.notes.push_back(m.model + ": the limit is that of the scene's mesh, no other mesh was run.");
    return t;
}

Table slip_table(const std::vector<RungResult>& results, const std::vector<std::string>& records)
{
    Table t;
    t.columns = {{"rung", "rung", "", 4}, {"record", "record", "", 4}, {"slip_m", "slip", "m", 6}};
    for (const RungResult& r : results)
        for (std::size_t i = 0; i < r.slip.size() && i < records.size(); ++i)
            t.rows.push_back({rung_id(r.rung), records[i], r.slip[i]});
    return t;
}

bool all_fail_statically(const std::vector<RungResult>& results)
{
    bool any = false;
    for (const RungResult& r : results) {
        if (!r.ran()) continue;
        if (r.done() || !fails_statically(r.status)) return false;
        any = true;
    }
    return any;
}

namespace {

std::string standing_sentence(const std::vector<RungResult>& results)
{
    StatusCount count;
    for (const RungResult& r : results)
        if (r.ran()) count.add(r.status);
    return "The dam does not stand without an earthquake, by every rung that ran: " + count.words() + ".";
}

} // namespace

std::string choice_sentence(const std::vector<RungResult>& results, const Judgement& j, double tolerance)
{
    if (all_fail_statically(results)) return standing_sentence(results);
    if (!j.top) return "No rung has a slip to compare.";
    const RungResult& top = results[*j.top];
    if (j.contradiction)
        return fmt::format("No rung can be named: {}, finer than the others, has no final slip: {}. {}",
                           rung_id(results[*j.contradiction].rung), word(results[*j.contradiction].status),
                           results[*j.contradiction].remark);
    if (!j.top_error)
        return fmt::format("Nothing says how far the finest rung, {}, is from its limit: more steps are needed (larger "
                           "--budget).",
                           rung_id(top.rung));
    if (!j.choice)
        return fmt::format("No rung is within {:.3g} %: the finest one, {}, itself leaves {:.2g} % open.",
                           100.0 * tolerance, rung_id(top.rung), 100.0 * *j.top_error);
    const RungResult& r = results[*j.choice];
    return fmt::format(
        "Cheapest rung within {:.3g} %: {}, slip {:.4g} mm in {:.2g} s, {:.2g} % from the finest ({}, {:.2g} "
        "s).",
        100.0 * tolerance, rung_id(r.rung), r.slip[j.record] / mm, r.seconds, 100.0 * *j.rungs[*j.choice].deviation,
        rung_id(top.rung), top.seconds);
}

} // namespace damslip::pages
