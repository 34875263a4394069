#pragma once

#include "analysis/sweep/sweep_comparison.hpp"
#include "core/table.hpp"

#include <functional>
#include <nlohmann/json_fwd.hpp>

/// A sweep as tables.
namespace damslip::pages {

/// Rows in the order of their ids; what an interrupted sweep did not reach says so. Axes, yield acceleration and PGA, then
/// what the method gave. @param mean  with the mean slip of both polarities, empty where one of them has none
Table sweep_table(const Grid& grid, const std::vector<std::size_t>& ids, const SweepOutcome& outcome,
                  bool mean = false);

/// Takes the cells of a row, which are overwritten by those of the next. @param row  null: not reached
using TakeRow = std::function<void(const std::vector<Cell>& cells, const FinishedRow* row)>;

/// The rows of that table one after the other, none of them held. @param ids  ascending
void for_each_sweep_row(const Grid& grid, const std::vector<std::size_t>& ids, const SweepOutcome& outcome, bool mean,
                        const TakeRow& take);

/// Its columns.
std::vector<Column> sweep_columns(const Grid& grid, bool mean = false);

/// Remark of FE rows whose step was given: nothing to compare it with was run, so ± step is empty.
inline constexpr const char* no_error_estimate = "no error estimate: fixed sub-steps";

Table comparison_table(const Grid& grid, const std::vector<SweepComparison>& compared);

/// Counts that show how much was made once; the same for any number of threads.
Table count_table(const FeSweepCounts& counts);

/// @param compared  empty without FE
nlohmann::ordered_json sweep_json(const Scene& given, const Table& rows, const Table& compared,
                                  const SweepOutcome& outcome);

/// FE against the rigid block, counts and seconds, beside the rows, which have standard output for themselves.
std::string fe_sweep_text(const FeSweepCounts& counts, const Table& compared);

} // namespace damslip::pages
