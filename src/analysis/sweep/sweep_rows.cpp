#include "analysis/sweep/sweep_rows.hpp"

namespace damslip {

namespace {

/// Results in the order of the columns; what a method does not give stays empty.
struct Results {
    Cell slip, max_slip, upstream_slip, slip_low, slip_high, slip_error, truncation_error, critical_friction, status,
        lift_slip;

    std::vector<Cell> cells() const
    {
        return {slip,       max_slip,         upstream_slip,     slip_low, slip_high,
                slip_error, truncation_error, critical_friction, status,   lift_slip};
    }
};
enum ResultColumn : std::size_t {
    slip_column = 0,
    slip_error_column = 5,
    critical_friction_column = 7,
    status_column = 8
};

Cell number(const std::optional<double>& value)
{
    return value ? Cell(*value) : Cell();
}

std::optional<double> number_of(const FinishedRow& row, ResultColumn column)
{
    const double* value = std::get_if<double>(&row.results[column]);
    return value ? std::optional(*value) : std::nullopt;
}

/// Median and band of a regression; the status says what is the matter with them, if anything. A block that does not stand
/// has none.
Results regression_results(const sliding::Regression& regression, const sliding::RegressionInputs& inputs,
                           sliding::StaticState state)
{
    if (state != sliding::StaticState::at_rest) {
        Results none;
        none.status = word(sliding::status_of(state));
        return none;
    }
    const sliding::RegressionResult r = sliding::evaluate(regression, inputs);
    const auto metres = [](const std::optional<double>& value_cm) {
        return value_cm ? Cell(*value_cm * units::cm) : Cell();
    };
    Results results;
    results.slip = results.max_slip = metres(r.median_cm);
    results.slip_low = metres(r.minus_sd_cm);
    results.slip_high = metres(r.plus_sd_cm);
    if (r.status != sliding::RegressionStatus::ok) results.status = sliding::reason(r);
    return results;
}

Results block_results(const Scene& scene, const Grid& grid, const GridIndex& at, const sliding::SkippingMotion& motion,
                      SlipHistory& history)
{
    const bool keep = grid.tasks.rows() <= most_rows_with_history;
    const sliding::SlideResult r = slide_model(scene, grid.model(at), motion, grid.axes.polarity[at.polarity],
                                               keep ? sliding::HistoryOutput::samples : sliding::HistoryOutput::none);
    if (keep && reported(r.status, r.slip)) history = slip_history(r.history.time, r.history.slip);
    Results results;
    results.slip = number(reported(r.status, r.slip));
    results.max_slip = number(reported(r.status, r.max_slip));
    results.upstream_slip = number(reported(r.status, r.upstream_slip));
    results.status = word(r.status);
    return results;
}

bool empty(const Cell& cell)
{
    return std::holds_alternative<std::monostate>(cell);
}

/// What the numbers of a row do not say by themselves.
Cell remark(const SweepMethod& method, const std::vector<Cell>& results)
{
    const bool unknown =
        method.kind == SweepKind::finite_elements && !empty(results[slip_column]) && empty(results[slip_error_column]);
    return unknown ? Cell(std::string(no_error_estimate)) : Cell();
}

} // namespace

Table sweep_table()
{
    Table t;
    t.columns = {{"id", "id", "", 4},
                 {"friction", "μ", "–", 4},
                 {"level_m", "level", "m", 4},
                 {"uplift", "uplift", "", 4},
                 {"reservoir", "reservoir", "", 4},
                 {"size", "size", "–", 4},
                 {"scale", "scale", "–", 4},
                 {"polarity", "polarity", "", 4},
                 {"record", "record", "", 4},
                 {"method", "method", "", 4},
                 {"yield_acceleration_m_s2", "a_y", "m/s²", 5},
                 {"yield_coefficient_g", "a_y", "g", 5},
                 {"pga_m_s2", "PGA", "m/s²", 4},
                 {"slip_m", "slip", "m", 5},
                 {"max_slip_m", "largest", "m", 5},
                 {"upstream_slip_m", "upstream", "m", 4},
                 {"slip_low_m", "−1σ", "m", 4},
                 {"slip_high_m", "+1σ", "m", 4},
                 {"slip_error_m", "± step", "m", 2},
                 {"truncation_error_m", "± modes", "m", 2},
                 {"critical_friction", "critical μ", "–", 6},
                 {"status", "status", "", 4},
                 {"lift_joint_slip_m", "lift joints", "m", 5},
                 {"remark", "remark", "", 4}};
    return t;
}

std::vector<Cell> table_row(const Grid& grid, std::size_t id, const std::vector<Cell>& results)
{
    const GridIndex at = grid.tasks.index(id);
    const double a_y = grid.model(at).downstream.law.constant;
    std::vector<Cell> row{static_cast<std::int64_t>(id),
                          grid.axes.friction[at.friction],
                          grid.axes.level[at.level] * grid.axes.size[at.size],
                          grid.axes.uplift[at.uplift],
                          grid.axes.reservoir[at.reservoir],
                          grid.axes.size[at.size],
                          grid.axes.scale[at.scale],
                          static_cast<std::int64_t>(grid.axes.polarity[at.polarity]),
                          grid.records[at.record],
                          grid.axes.method[at.method].id,
                          a_y,
                          a_y / units::standard_gravity,
                          grid.inputs_of(at).pga_g * units::standard_gravity};
    row.insert(row.end(), results.begin(), results.end());
    row.push_back(remark(grid.axes.method[at.method], results));
    return row;
}

FinishedRow rigid_row(const Scene& scene, const Grid& grid, std::size_t id)
{
    const GridIndex at = grid.tasks.index(id);
    const SweepMethod& method = grid.axes.method[at.method];
    Results results;
    SlipHistory history;
    if (method.kind == SweepKind::regression)
        results = regression_results(*sliding::find_regression(method.id), grid.inputs_of(at), grid.model(at).state);
    else if (method.kind == SweepKind::rigid)
        results = block_results(scene, grid, at, grid.horizontal(at), history);
    else if (grid.motion(at).has_vertical())
        results = block_results(scene, grid, at, grid.motion(at), history);
    else
        results.status = std::string("no vertical component");
    results.critical_friction = grid.model(at).critical_friction;
    FinishedRow row{id, true, results.cells(), std::move(history)};
    const std::optional<Status> status = status_of(row);
    row.good = !status || is_answer(*status); // others are remarks: the method does not apply
    return row;
}

FinishedRow fe_row(std::size_t id, const FeSlip& slip)
{
    Results results;
    results.slip = number(slip.slip);
    results.max_slip = number(slip.max_slip);
    results.slip_error = number(slip.slip_error);
    results.truncation_error = number(slip.truncation_error);
    results.critical_friction = number(slip.critical_friction);
    results.status = word(slip.status);
    results.lift_slip = number(slip.lift_slip);
    return {id, is_answer(slip.status), results.cells(), slip.history};
}

std::vector<Cell> not_run()
{
    Results results;
    results.status = word(Status::interrupted);
    return results.cells();
}

std::optional<Status> status_of(const FinishedRow& row)
{
    const auto* word = std::get_if<std::string>(&row.results[status_column]);
    return word ? status_of_word(*word) : std::nullopt;
}

std::optional<double> slip_of(const FinishedRow& row)
{
    return number_of(row, slip_column);
}

std::optional<double> slip_error_of(const FinishedRow& row)
{
    return number_of(row, slip_error_column);
}

std::optional<double> critical_friction_of(const FinishedRow& row)
{
    return number_of(row, critical_friction_column);
}

} // namespace damslip
