#pragma once

#include "analysis/sweep/result_store.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "core/status.hpp"

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
SweepOutcome run_sweep(const Sweep& inputs, const Grid& grid, const std::vector<std::size_t>& wanted, ResultStore* kept,
                       int jobs, Watch& watch);

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
SweepTotals run_long_sweep(const Sweep& inputs, Grid grid, const std::vector<std::size_t>& wanted, ResultStore* kept,
                           int jobs, Watch& watch, const TakePart& take);

/// FE slip against the rigid block's, over the motions of one friction, variant and FE method that both carried to their
/// end, with the vertical component where the record has one. Slips are sizes: those of the two polarities do not cancel.
struct SweepComparison {
    GridIndex at; ///< of the first motion
    std::int64_t motions = 0, static_failures = 0;
    std::optional<double> critical_friction;
    double mean_fe = 0.0, mean_rigid = 0.0, largest_fe = 0.0, largest_rigid = 0.0; ///< [m]
    std::optional<double> ratio_of_means;
    std::optional<double> largest_error; ///< of the time step [m]; none: some motion has none
    StatusCount without;                 ///< FE runs without a slip or an answer
};

/// One for each friction, variant and FE method; the rigid block slides anew.
std::vector<SweepComparison> compare_with_rigid(const Scene& scene, const Grid& grid, const SweepOutcome& outcome);

/// One point of whoever asks from outside: a scene, a method, one of its records.
struct PointAnswer {
    FinishedRow row; ///< that of a sweep over this scene alone, bit for bit: of its polarities the worse
    std::string record;
    int polarity = 1;
    std::string method;
    double seconds = 0.0; ///< processor time
};

/// Answers point after point. The records are read again only when the scene names others, or another scale of them.
class PointRuns {
public:
    /// @param record  name; empty: the only one @throws UsageError, InputError, NotConverged
    PointAnswer run(const Scene& scene, const SweepMethod& method, const std::string& record, Watch& watch);

private:
    std::string names_; ///< what the records were read for
    Records records_;
};

/// rigid-v where a record has a vertical component and the scene counts it, else rigid: the last method a sweep takes by itself.
SweepMethod usual_method(const Scene& scene);

/// What a table says of a row beside the results, for ResultStore::describe(): axes, names, rock, PGA.
std::string axes_json(const Grid& grid);

/// The grid of a stored sweep, as far as its table needs it: without models and motions. @param axes  of axes_json()
Grid stored_grid(const std::string& axes);

/// Parts put together.
struct MergedSweep {
    std::unique_ptr<ResultStore> whole;
    std::size_t parts = 0;
};

/// The rows of all parts of a sweep in one store.
/// @param paths  stores of parts, or folders: all files named *.i-of-n.sqlite in them
/// @param file   of the whole; empty: a temporary one
/// @throws InputError naming the parts that are missing, given twice, unfinished, damaged or of another sweep
MergedSweep merge_parts(const std::vector<std::filesystem::path>& paths, const std::filesystem::path& file);

} // namespace damslip
