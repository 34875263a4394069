#include "pages/accuracy/accuracy_pages.hpp"

#include "core/status.hpp"
#include "core/units.hpp"

#include <cmath>
#include <fmt/format.h>
#include <ranges>

namespace damslip::pages {

namespace {

using units::mm;

/// Of the list; empty for a model level that was skipped, and for a regression, which gives an estimate and no run.
Cell status_cell(const ModelLevelResult& r)
{
    if (r.skipped || (r.done() && r.model_level.family == ModelLevelFamily::regression)) return {};
    return word(r.status);
}

struct ModelLevelRow {
    const ModelLevelResult& result;
    const ModelLevelVerdict& verdict;
    const Judgement& judgement;

    Cell of_motion(std::optional<double> MotionOutcome::*value) const
    {
        return judgement.motion < result.motions.size() ? optional_cell(result.motions[judgement.motion].*value, mm) : Cell();
    }
    /// Of its slip from the top's, over the top's [%].
    Cell off_top_percent() const
    {
        if (!result.done() || !judgement.top || !verdict.off_top) return {};
        const double top = std::abs(result.slip(judgement.motion) - *verdict.off_top);
        return top >= least_slip ? Cell(100.0 * *verdict.off_top / top) : Cell();
    }
};

std::vector<ColumnOf<ModelLevelRow>> model_level_columns()
{
    using R = ModelLevelRow;
    const auto if_done = [](auto value) {
        return [=](const R& r) { return r.result.done() ? Cell(r.result.*value) : Cell(); };
    };
    const auto megabytes = [](const R& r) { return r.result.done() ? optional_cell(r.result.bytes, 1e6) : Cell(); };
    const auto deviation = [](const R& r) { return r.verdict.deviation ? Cell(100.0 * *r.verdict.deviation) : Cell(); };
    return {{in_brief({"rung", "model level"}), [](const R& r) { return model_level_id(r.result.model_level); }},
            {in_brief({"slip_mm", "slip", "mm", 5}), [](const R& r) { return r.of_motion(&MotionOutcome::slip); }},
            {{"slip_16_mm", "16 %", "mm", 3}, [](const R& r) { return r.of_motion(&MotionOutcome::low); }},
            {{"slip_84_mm", "84 %", "mm", 3}, [](const R& r) { return r.of_motion(&MotionOutcome::high); }},
            {in_brief({"error_mm", "± steps, mesh", "mm", 2}), [](const R& r) { return optional_cell(r.verdict.error, mm); }},
            {{"model_difference_mm", "model − top's", "mm", 3},
             [](const R& r) { return optional_cell(r.verdict.model_difference, mm); }},
            {{"off_top_mm", "slip − top's", "mm", 3}, [](const R& r) { return optional_cell(r.verdict.off_top, mm); }},
            {{"off_top_percent", "slip − top's", "%", 3}, &R::off_top_percent},
            {in_brief({"deviation_percent", "deviation", "%", 3}), deviation},
            {{"front", "front"}, [](const R& r) { return r.verdict.front ? Cell(true) : Cell(); }},
            {in_brief({"seconds", "time", "s", 3}), if_done(&ModelLevelResult::seconds)},
            {{"set_up_seconds", "set-up", "s", 2}, if_done(&ModelLevelResult::set_up_seconds)},
            {{"repeats", "runs"}, if_done(&ModelLevelResult::repeats)},
            {{"megabytes", "memory", "MB", 3}, megabytes},
            {{"unknowns", "unknowns"}, [](const R& r) { return optional_cell(r.result.unknowns); }},
            {{"time_step_s", "step", "s", 4}, [](const R& r) { return optional_cell(r.result.time_step); }},
            {{"steps", "steps"}, [](const R& r) { return optional_cell(r.result.steps); }},
            {in_brief({"status", "status"}), [](const R& r) { return status_cell(r.result); }},
            {{"remark", "remark"}, [](const R& r) { return (r.result.skipped ? "skipped: " : "") + r.result.remark; }}};
}

} // namespace

Table model_level_table(const std::vector<ModelLevelResult>& results, const Judgement& j)
{
    std::vector<ModelLevelRow> rows;
    for (std::size_t i = 0; i < results.size(); ++i) rows.push_back({results[i], j.model_levels[i], j});
    Table t = table_of("Model levels", model_level_columns(), rows);
    t.notes = {
        "± steps, mesh: estimate of what steps, elements, penalty and modes leave open, from the model levels of the "
        "same "
        "model; model − top's: difference of the limits of both models.",
        "deviation: (|slip − top's| + what the top model level leaves open) over the top's slip, the worst motion; "
        "front: no "
        "model level as fast deviates less.",
        "time: processor time of all that this model level costs alone, reading and set-up included, median of the "
        "runs; "
        "memory: growth of the resident memory to its peak during the first run.",
        "dt/4: a quarter of the record's step; dt=auto: chosen by time.slip_tolerance, the default of `fe`; "
        "dt=adaptive: the same with time.stepping = \"adaptive\"; 2h, h/2: "
        "elements of twice and half the scene's size; q8: quadratic elements of the size before it; stick: penalty in "
        "N/m³."};
    if (j.top && results[*j.top].motions.size() > 1)
        t.notes.push_back("slips and millimetres: of the record and polarity that slide the top model level furthest.");
    return t;
}

Table front_table(const std::vector<ModelLevelResult>& results, const Judgement& j)
{
    std::vector<ModelLevelRow> rows;
    for (std::size_t i = results.size(); i-- > 0;)
        if (j.model_levels[i].front) rows.push_back({results[i], j.model_levels[i], j});
    return table_of("Model levels that none as fast beats", model_level_columns(), rows);
}

Table model_table(const std::vector<ModelLevelResult>& results, const Judgement& j)
{
    using M = ModelLimit;
    double reference = 0.0; // of the limits: the top's own, or its slip
    if (j.top) {
        reference = results[*j.top].slip(j.motion);
        const std::string top = model_of(results[*j.top].model_level);
        for (const M& m : j.models)
            if (m.model == top) reference = m.slip[j.motion];
    }
    const auto off_top = [&](const M& m) {
        return std::abs(reference) >= least_slip ? Cell(100.0 * (m.slip[j.motion] - reference) / std::abs(reference))
                                                 : Cell();
    };
    Table t = table_of<M>(
        "Models and their limits",
        {{in_brief({"model", "model"}), &M::model},
         {in_brief({"limit_mm", "limit", "mm", 5}), [&](const M& m) { return m.slip[j.motion] / mm; }},
         {in_brief({"open_mm", "± open", "mm", 2}), [&](const M& m) { return m.open[j.motion] / mm; }},
         {in_brief({"off_top_percent", "model − top's", "%", 3}), off_top},
         {{"order_step", "order in step", "", 3}, [](const M& m) { return optional_cell(m.order_step); }},
         {{"order_mesh", "in mesh", "", 3}, [](const M& m) { return optional_cell(m.order_mesh); }},
         {{"order_penalty", "in 1/penalty", "", 3}, [](const M& m) { return optional_cell(m.order_penalty); }},
         {{"order_modes", "in 1/modes", "", 3}, [](const M& m) { return optional_cell(m.order_modes); }}},
        j.top ? j.models : std::vector<M>{});
    if (!j.top) return t;
    t.notes.push_back("limit: step and element size to zero, by Richardson's extrapolation with the observed order "
                      "(held between 1 and 2); the rigid block is located exactly. Orders are those the last three "
                      "model levels show.");
    for (const M& m : j.models)
        if (!m.mesh_known && m.model.starts_with("fe-"))
            t.notes.push_back(m.model + ": the limit is that of the scene's mesh, no other mesh was run.");
    return t;
}

Table slip_table(const std::vector<ModelLevelResult>& results, const std::vector<MotionName>& motions)
{
    struct Row {
        std::string model_level;
        MotionName motion;
        double slip; ///< [m]
    };
    std::vector<Row> rows;
    for (const ModelLevelResult& r : results)
        for (std::size_t i = 0; i < r.motions.size() && i < motions.size(); ++i)
            rows.push_back({model_level_id(r.model_level), motions[i], r.slip(i)});
    return table_of<Row>("",
                         {{{"rung", "model level"}, &Row::model_level},
                          {{"record", "record"}, [](const Row& r) { return r.motion.record; }},
                          {{"polarity", "polarity"}, [](const Row& r) { return r.motion.polarity; }},
                          {{"slip_m", "slip", "m", 6}, &Row::slip}},
                         rows);
}

Table one_model_level_table(const ModelLevelResult& result, const std::vector<MotionName>& motions)
{
    using Number = std::size_t;
    return table_of<Number>("Model level " + model_level_id(result.model_level),
                            {{in_brief({"record", "record"}), [&](Number i) { return motions[i].record; }},
                             {in_brief({"polarity", "polarity"}), [&](Number i) { return motions[i].polarity; }},
                             {ranking({"slip_mm", "slip", "mm", 6}), [&](Number i) { return result.slip(i) / mm; }},
                             {in_brief({"seconds", "time, all motions", "s", 3}), [&](Number) { return result.seconds; }}},
                            std::views::iota(Number{0}, result.motions.size()));
}

bool all_fail_statically(const std::vector<ModelLevelResult>& results)
{
    bool any = false;
    for (const ModelLevelResult& r : results) {
        if (!r.ran()) continue;
        if (r.done() || !fails_statically(r.status)) return false;
        any = true;
    }
    return any;
}

namespace {

std::string standing_sentence(const std::vector<ModelLevelResult>& results)
{
    StatusCount count;
    for (const ModelLevelResult& r : results)
        if (r.ran()) count.add(r.status);
    return "The dam does not stand without an earthquake, by every model level that ran: " + count.words() + ".";
}

} // namespace

std::string choice_sentence(const std::vector<ModelLevelResult>& results, const Judgement& j, double tolerance)
{
    if (all_fail_statically(results)) return standing_sentence(results);
    if (!j.top) return "No model level has a slip to compare.";
    const ModelLevelResult& top = results[*j.top];
    if (j.contradiction)
        return fmt::format("No model level can be named: {}, finer than the others, has no final slip: {}. {}",
                           model_level_id(results[*j.contradiction].model_level), word(results[*j.contradiction].status),
                           results[*j.contradiction].remark);
    if (!j.top_error)
        return fmt::format(
            "Nothing says how far the finest model level, {}, is from its limit: more steps are needed (larger "
            "--budget).",
            model_level_id(top.model_level));
    if (!j.choice)
        return fmt::format("No model level is within {:.3g} %: the finest one, {}, itself leaves {:.2g} % open.",
                           100.0 * tolerance, model_level_id(top.model_level), 100.0 * *j.top_error);
    const ModelLevelResult& r = results[*j.choice];
    return fmt::format(
        "Cheapest model level within {:.3g} %: {}, slip {:.4g} mm in {:.2g} s, {:.2g} % from the finest ({}, {:.2g} "
        "s).",
        100.0 * tolerance, model_level_id(r.model_level), r.slip(j.motion) / mm, r.seconds, 100.0 * *j.model_levels[*j.choice].deviation,
        model_level_id(top.model_level), top.seconds);
}

} // namespace damslip::pages
