#pragma once

#include "analysis/prepare/records.hpp"
#include "analysis/sweep/slip_history.hpp"
#include "core/table.hpp"
#include "pages/report/page.hpp"
#include "pages/sweep/sweep_rows_view.hpp"

/// A sweep as the report that is handed in.
namespace damslip::pages {

struct SweepReportInput {
    const Scene* scene;               ///< as given; null: not known, as of merged parts
    const Table& rows;                ///< the whole table of the sweep, or its first rows where `view` is given
    const std::vector<Table>& tables; ///< further ones: comparison of the methods, counts
    const std::vector<RecordPair>& records;
    std::filesystem::path csv;               ///< where the rows are; empty: nowhere
    std::vector<SlipHistory> histories = {}; ///< of the rows, in their order; empty: none kept
    const SweepView* view = nullptr;         ///< of all rows, of a sweep too long for one table; null: made from `rows`
};

inline constexpr std::size_t listed_rows = 400; ///< that the report prints

Page sweep_page(const SweepReportInput& input);

/// The page as one HTML file.
std::string sweep_report(const SweepReportInput& input);

} // namespace damslip::pages
