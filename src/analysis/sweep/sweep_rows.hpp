#pragma once

#include "analysis/sweep/fe_sweep.hpp"
#include "analysis/sweep/result_store.hpp"
#include "analysis/sweep/sweep_grid.hpp"

namespace damslip {

/// Computes a row of the rigid block or of a regression. @param scene  for its [sliding] options
FinishedRow rigid_row(const Scene& scene, const Grid& grid, std::size_t id);

/// Adds rows that differ in friction alone: the same as one by one, sooner. @param ids  ascending, at least one
void add_rigid_rows(const Scene& scene, const Grid& grid, std::span<const std::size_t> ids,
                    std::vector<FinishedRow>& rows);

/// The row of an FE run, of the whole dam or of few modes of it. @param with_history  of its slip
FinishedRow fe_row(std::size_t id, const fe2d::RunResult& run, bool with_history);

/// What has become of an anchor by the end: "snapped", "yielded" (at any time), else "elastic".
std::string anchor_end(const AnchorHistory& history);

/// Results of a row that an interrupted sweep did not reach.
RowResults not_run();

/// Empty: a remark of a method that does not apply.
std::optional<Status> status_of(const FinishedRow& row);

} // namespace damslip
