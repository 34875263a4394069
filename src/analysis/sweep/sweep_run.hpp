#pragma once

#include "analysis/sweep/sweep_rows.hpp"

namespace damslip {

/// Rows of a sweep, or of a part of it, by ascending id.
struct SweepOutcome {
    std::vector<FinishedRow> rows;     ///< finished ones only
    std::size_t wanted = 0, found = 0; ///< rows asked for; taken from the store
    std::optional<FeSweepCounts> fe;   ///< of this process; none: no FE method

    bool complete() const { return rows.size() == wanted; }
    bool all_good() const;
    const FinishedRow* find(std::size_t id) const; ///< nullptr: not finished
};

/// All rows of a sweep, without a store. @param jobs  threads, 0: all cores
/// @throws UsageError for scenes that FE cannot take, InputError, NotConverged
SweepOutcome run_sweep(const Sweep& sweep, Watch& watch, int jobs = 0);

/// Computes the rows that are asked for: FE groups first, then the rigid block and the regressions. Rows in the store
/// are not computed again; what finishes goes into it. Ends early when interrupted.
/// @param wanted   ids, ascending
/// @param kept     nullptr: none
SweepOutcome run_sweep(const Sweep& inputs, const Grid& grid, const std::vector<std::size_t>& wanted,
                       ResultStore* kept, int jobs, Watch& watch);

/// What is known of all rows of a sweep whose rows are not held together.
struct SweepTotals {
    std::size_t wanted = 0, rows = 0, found = 0; ///< asked for; finished; of these taken from the store
    std::size_t bad = 0;                         ///< rows whose method did not end properly

    bool complete() const { return rows == wanted; }
};

/// Takes a part's rows: ids and what became of them, ascending, part after part.
using TakePart = std::function<void(const Grid& grid, const std::vector<std::size_t>& ids, const SweepOutcome& part)>;

/// The same rows without finite elements, a few thousand at a time, so that the memory does not grow with their number.
/// @param grid  from begin_grid()
SweepTotals run_long_sweep(const Sweep& inputs, Grid grid, const std::vector<std::size_t>& wanted,
                           ResultStore* kept, int jobs, Watch& watch, const TakePart& take);

} // namespace damslip
