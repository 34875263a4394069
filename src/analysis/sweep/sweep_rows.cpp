#include "analysis/sweep/sweep_rows.hpp"

#include "analysis/fe/contact_run.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

namespace {

/// Median and band of a regression; the status says what is the matter with them, if anything. A block that does not stand
/// has none.
RowResults regression_results(const sliding::Regression& regression, const sliding::RegressionInputs& inputs,
                              sliding::StaticState state)
{
    if (state != sliding::StaticState::at_rest) {
        RowResults none;
        none.status = word(sliding::status_of(state));
        return none;
    }
    const sliding::RegressionResult r = sliding::evaluate(regression, inputs);
    const auto metres = [](const std::optional<double>& value_cm) {
        return value_cm ? std::optional(*value_cm * units::cm) : std::nullopt;
    };
    RowResults results;
    results.slip = results.max_slip = metres(r.median_cm);
    results.slip_low = metres(r.minus_sd_cm);
    results.slip_high = metres(r.plus_sd_cm);
    if (r.status != sliding::RegressionStatus::ok) results.status = sliding::reason(r);
    return results;
}

sliding::SlideResult slide(const Scene& scene, const Grid& grid, const GridIndex& at,
                           const sliding::SkippingMotion& motion, sliding::HistoryOutput output)
{
    const int polarity = grid.axes.polarity[at.polarity];
    if (grid.axes.method[at.method].kind == SweepKind::rocking)
        return rock_model(scene, grid.model(at), motion.motion(), polarity, output).slide;
    if (const SweepKind kind = grid.axes.method[at.method].kind; is_flexible(kind))
        return slide_model(scene, *grid.flexible[grid.tasks.variant(at)], grid.model(at), motion.motion(), polarity,
                           kind == SweepKind::coupled ? FlexibleMethod::coupled : FlexibleMethod::decoupled, output)
            .slide;
    return slide_model(scene, grid.model(at), motion, polarity, output);
}

/// Slip after each event of a sequence as far as it has one, and the anchors of a row that has a slip.
void add_events_and_anchors(const std::vector<EventSlip>& events, const std::vector<AnchorOutcome>& anchors,
                            RowResults& results)
{
    for (const EventSlip& event : events)
        if (reported(event.status, event.slip)) results.event_slips.push_back(event.slip);
    if (!results.slip) return;
    for (const AnchorOutcome& anchor : anchors)
        results.anchors.push_back({anchor.name, anchor.history.largest_force, anchor_end(anchor.history)});
}

void fill(const sliding::SlideResult& r, RowResults& results)
{
    results.slip = reported(r.status, r.slip);
    results.max_slip = reported(r.status, r.max_slip);
    results.upstream_slip = reported(r.status, r.upstream_slip);
    if (r.slip_error > 0.0) results.slip_error = reported(r.status, r.slip_error);
    results.status = word(r.status);
    add_events_and_anchors(r.events, r.anchors, results);
}

RowResults block_results(const Scene& scene, const Grid& grid, const GridIndex& at,
                         const sliding::SkippingMotion& motion, SlipHistory& history)
{
    const bool keep = grid.tasks.rows() <= most_rows_with_history;
    const sliding::SlideResult r =
        slide(scene, grid, at, motion, keep ? sliding::HistoryOutput::samples : sliding::HistoryOutput::none);
    if (keep && reported(r.status, r.slip)) history = slip_history(r.history.time, r.history.slip);
    RowResults results;
    fill(r, results);
    return results;
}

void finish(const Grid& grid, const GridIndex& at, FinishedRow& row)
{
    row.results.yield = grid.yield(at);
    row.results.critical_friction = grid.model(at).critical_friction;
    const std::optional<Status> status = status_of(row);
    row.good = !status || is_answer(*status); // others are remarks: the method does not apply
}

/// A plain block under the horizontal motion, without a history: rows of several frictions can go together.
bool may_go_together(const Grid& grid, const GridIndex& at)
{
    const SweepKind kind = grid.axes.method[at.method].kind;
    return (kind == SweepKind::rigid || (kind == SweepKind::rigid_vertical && grid.motion(at).has_vertical())) &&
           grid.tasks.rows() > most_rows_with_history;
}

} // namespace

std::string anchor_end(const AnchorHistory& history)
{
    if (history.state == AnchorState::snapped) return "snapped";
    return history.plastic_strain > 0.0 ? "yielded" : "elastic";
}

FinishedRow rigid_row(const Scene& scene, const Grid& grid, std::size_t id)
{
    const GridIndex at = grid.tasks.index(id);
    const SweepMethod& method = grid.axes.method[at.method];
    FinishedRow row{id, true, {}, {}};
    RowResults& results = row.results;
    if (method.kind == SweepKind::regression)
        results = regression_results(*sliding::find_regression(method.id), grid.inputs_of(at), grid.model(at).state);
    else if (method.kind == SweepKind::rigid)
        results = block_results(scene, grid, at, grid.horizontal(at), row.history);
    else if (method.kind == SweepKind::rocking && grid.model(at).wedge)
        results.status = "no block that rocks";
    else if (method.kind != SweepKind::rigid_vertical || grid.motion(at).has_vertical())
        results = block_results(scene, grid, at, grid.motion(at), row.history);
    else
        results.status = "no vertical component";
    finish(grid, at, row);
    return row;
}

void add_rigid_rows(const Scene& scene, const Grid& grid, std::span<const std::size_t> ids,
                    std::vector<FinishedRow>& rows)
{
    GridIndex at = grid.tasks.index(ids.front());
    if (!may_go_together(grid, at)) {
        for (const std::size_t id : ids) rows.push_back(rigid_row(scene, grid, id));
        return;
    }
    const std::size_t rows_of_friction = grid.tasks.rows() / grid.tasks.friction;
    std::vector<GridIndex> places;
    std::vector<const RigidModel*> models;
    for (const std::size_t id : ids) {
        at.friction = id / rows_of_friction;
        places.push_back(at);
        models.push_back(&grid.model(at));
    }
    const bool vertical = grid.axes.method[at.method].kind == SweepKind::rigid_vertical;
    const std::vector<sliding::SlideResult> slides =
        slide_models(scene, models, vertical ? grid.motion(at) : grid.horizontal(at), grid.axes.polarity[at.polarity]);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        FinishedRow& row = rows.emplace_back();
        row.id = ids[i];
        fill(slides[i], row.results);
        finish(grid, places[i], row);
    }
}

FinishedRow fe_row(std::size_t id, const fe2d::RunResult& run, bool with_history)
{
    RowResults results;
    results.slip = reported(run.status, run.slip);
    results.max_slip = reported(run.status, run.max_slip);
    results.slip_error = reported(run.status, run.slip_error);
    if (results.slip && run.modes > 0 && std::isfinite(run.truncation_error))
        results.truncation_error = run.truncation_error;
    if (!run.stages.empty() && std::isfinite(run.stages.back().critical_friction))
        results.critical_friction = run.stages.back().critical_friction;
    results.status = word(run.status);
    for (const fe2d::LiftResult& lift : run.lifts)
        if (results.slip) results.lift_slip = std::max(results.lift_slip.value_or(0.0), lift.largest_slip);
    results.slid_at_least = slid_at_least(run.status, run.slip);
    add_events_and_anchors(run.events, run.anchors, results);
    if (!run.history.time.empty()) { // it was shaken
        const fe2d::RunOutFigures& f = run.run_out;
        if (std::isfinite(f.thrust_over_friction)) results.thrust_over_friction = f.thrust_over_friction;
        results.lift_offs = f.lift_offs;
        results.lift_off_frequency = f.lift_off_frequency;
        results.unloaded_share = f.unloaded_share;
        results.end_rate = f.rate;
        results.slip_shaking = f.slip_shaking;
        results.slip_at_rest = f.slip_at_rest;
    }
    SlipHistory history;
    if (with_history && results.slip) history = slip_history(run.history.time, run.history.slip);
    return {id, is_answer(run.status), std::move(results), std::move(history)};
}

RowResults not_run()
{
    RowResults results;
    results.status = word(Status::interrupted);
    return results;
}

std::optional<Status> status_of(const FinishedRow& row)
{
    return status_of_word(row.results.status);
}

} // namespace damslip
