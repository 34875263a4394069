#pragma once

#include "analysis/sweep/fe_sweep.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "analysis/sweep/sweep_journal.hpp"

namespace damslip {

/// Columns of a sweep: the axes, the yield acceleration and the PGA, then what the method gave; no rows.
Table sweep_table();

/// The row of the table: axes and yield acceleration of `id`, then the results.
std::vector<Cell> table_row(const Grid& grid, std::size_t id, const std::vector<Cell>& results);

/// Computes a row of the rigid block or of a regression. @param scene  for its [sliding] options
FinishedRow rigid_row(const Scene& scene, const Grid& grid, std::size_t id);

/// The row of an FE run.
FinishedRow fe_row(std::size_t id, const FeSlip& slip);

/// Results of a row that an interrupted sweep did not reach.
std::vector<Cell> not_run();

/// Remark of FE rows whose step was given: nothing to compare it with was run, so ± step is empty.
inline constexpr const char* no_error_estimate = "no error estimate: fixed sub-steps";

// Of the results of a row; empty: not known.
std::optional<Status> status_of(const FinishedRow& row);            ///< empty: a remark of a method that does not apply
std::optional<double> slip_of(const FinishedRow& row);              ///< [m]
std::optional<double> slip_error_of(const FinishedRow& row);        ///< [m]
std::optional<double> critical_friction_of(const FinishedRow& row); ///< [-]

} // namespace damslip
