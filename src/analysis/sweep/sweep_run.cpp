#include "analysis/sweep/sweep_run.hpp"

#include "analysis/sweep/sweep_store.hpp"
#include "core/parallel.hpp"
#include "core/stopwatch.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

namespace damslip {

namespace {

constexpr std::size_t block_rows = 256;   ///< rigid rows that a thread takes at once
constexpr std::size_t most_together = 16; ///< rows that differ in friction alone

/// Rows by their place among the wanted ids, written from several threads, each place once.
class WantedRows {
public:
    /// @param memory  rows that nobody needs any more: new ones take their place
    /// @param storing  false: the caller stores them, all at once
    WantedRows(const std::vector<std::size_t>& wanted, ResultStore* kept, Watch& watch,
               std::vector<FinishedRow> memory = {}, bool storing = true)
        : wanted_(wanted), kept_(kept), watch_(watch), storing_(storing), rows_(std::move(memory)),
          finished_(wanted.size(), 0)
    {
        rows_.resize(wanted.size());
    }

    void finish(std::vector<FinishedRow> rows)
    {
        if (!kept_)
            watch_.results_at_hand();
        else if (storing_)
            kept_->append(rows);
        put_all(std::move(rows));
    }
    void begin(std::span<const std::size_t> ids)
    {
        if (kept_) kept_->begin(ids);
    }
    /// What the store has of the wanted rows.
    void take_finished()
    {
        if (!kept_ || kept_->finished() == 0 || wanted_.empty()) return;
        put_all(kept_->rows(wanted_.front(), wanted_.back()));
    }
    std::map<std::size_t, int> stopped() const { return kept_ ? kept_->stopped() : std::map<std::size_t, int>{}; }
    std::vector<std::size_t> missing() const
    {
        std::vector<std::size_t> ids;
        for (std::size_t i = 0; i < wanted_.size(); ++i)
            if (!finished_[i]) ids.push_back(wanted_[i]);
        return ids;
    }
    /// By id; once.
    std::vector<FinishedRow> finished()
    {
        std::size_t count = 0;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (!finished_[i]) continue;
            if (i != count) rows_[count] = std::move(rows_[i]);
            ++count;
        }
        rows_.resize(count);
        return std::move(rows_);
    }

private:
    /// Those of this part. Rows that follow each other mostly do so here, too.
    void put_all(std::vector<FinishedRow> rows)
    {
        std::size_t at = 0;
        for (FinishedRow& row : rows) {
            if (at == wanted_.size() || wanted_[at] != row.id)
                at = static_cast<std::size_t>(std::lower_bound(wanted_.begin(), wanted_.end(), row.id) -
                                              wanted_.begin());
            if (at == wanted_.size() || wanted_[at] != row.id) continue;
            finished_[at] = 1;
            rows_[at++] = std::move(row);
        }
    }

    const std::vector<std::size_t>& wanted_;
    ResultStore* kept_;
    Watch& watch_;
    bool storing_;
    std::vector<FinishedRow> rows_; ///< one for each wanted id; its contents mean nothing before it is finished
    std::vector<char> finished_;
};

FeSweepCounts run_fe_rows(const Sweep& inputs, const Grid& grid, const std::vector<std::size_t>& missing, int jobs,
                          Watch& watch, WantedRows& store)
{
    const auto threads = static_cast<std::size_t>(thread_count(jobs));
    const std::vector<FeGroup> groups =
        with_stopped_in_pieces(fe_groups(inputs.tasks, inputs.axes, missing, threads), store.stopped());
    std::size_t runs = 0;
    for (const FeGroup& group : groups) runs += group.rows.size();
    watch.begin("sweep, finite elements", static_cast<double>(runs));
    FeSweepCounts counts = run_fe_groups(
        inputs, groups, jobs, watch, [&store](std::span<const std::size_t> ids) { store.begin(ids); },
        [&](std::span<const std::size_t> ids, std::span<const FeSlip> slips) {
            std::vector<FinishedRow> rows;
            for (std::size_t i = 0; i < ids.size(); ++i) {
                if (slips[i].status == Status::interrupted) continue;
                rows.push_back(fe_row(ids[i], slips[i]));
                rows.back().results.yield = grid.yield(grid.tasks.index(ids[i]));
            }
            store.finish(std::move(rows));
        });
    watch.end();
    return counts;
}

void without_finite_elements(std::vector<std::size_t>& ids, const Grid& grid)
{
    if (!grid.axes.finite_elements()) return;
    std::erase_if(ids, [&](std::size_t id) {
        return grid.axes.method[grid.tasks.index(id).method].kind == SweepKind::finite_elements;
    });
}

/// Rows in the order variant, motion, method, friction: those that differ in friction alone stand together. (The friction
/// is the first axis, so the rest of an id tells them.) Where there are none the order stays.
/// @param ids  ascending
std::vector<std::size_t> by_motion(const TaskList& tasks, const std::vector<std::size_t>& ids)
{
    const std::size_t rows_of_friction = tasks.rows() / tasks.friction;
    if (ids.empty() || ids.back() - ids.front() < rows_of_friction) return ids;
    std::vector<std::size_t> ordered = ids; // as numbers with the friction as the last axis
    for (std::size_t& id : ordered) id = id % rows_of_friction * tasks.friction + id / rows_of_friction;
    std::sort(ordered.begin(), ordered.end());
    for (std::size_t& place : ordered) place = place % tasks.friction * rows_of_friction + place / tasks.friction;
    return ordered;
}

/// The rows of some ids in the order of by_motion().
std::vector<FinishedRow> rigid_rows_of(const Scene& scene, const Grid& grid, std::span<const std::size_t> ids)
{
    const std::size_t rows_of_friction = grid.tasks.rows() / grid.tasks.friction;
    std::vector<FinishedRow> rows;
    rows.reserve(ids.size());
    for (std::size_t first = 0, next = 0; first < ids.size(); first = next) {
        while (next < ids.size() && next - first < most_together &&
               ids[next] % rows_of_friction == ids[first] % rows_of_friction)
            ++next;
        add_rigid_rows(scene, grid, ids.subspan(first, next - first), rows);
    }
    return rows;
}

/// @param done  rows before these, for the watch
void run_rigid_rows(const Scene& scene, const Grid& grid, const std::vector<std::size_t>& missing, int jobs,
                    Watch& watch, std::atomic<std::size_t>& done, WantedRows& store)
{
    const std::vector<std::size_t> ordered = by_motion(grid.tasks, missing);
    parallel_for((missing.size() + block_rows - 1) / block_rows, jobs, [&](std::size_t block) {
        if (watch.stop_asked()) return;
        const std::size_t first = block * block_rows, last = std::min(missing.size(), first + block_rows);
        store.finish(rigid_rows_of(scene, grid, std::span(ordered).subspan(first, last - first)));
        watch.at(static_cast<double>(done += last - first));
    });
}

} // namespace

bool SweepOutcome::all_good() const
{
    return std::all_of(rows.begin(), rows.end(), [](const FinishedRow& row) { return row.good; });
}

const FinishedRow* SweepOutcome::find(std::size_t id) const
{
    const auto at = std::lower_bound(rows.begin(), rows.end(), id,
                                     [](const FinishedRow& row, std::size_t i) { return row.id < i; });
    return at != rows.end() && at->id == id ? &*at : nullptr;
}

SweepOutcome run_sweep(const Sweep& inputs, const Grid& grid, const std::vector<std::size_t>& wanted, ResultStore* kept,
                       int jobs, Watch& watch)
{
    if (kept) kept->describe(axes_json(grid));
    WantedRows store(wanted, kept, watch);
    SweepOutcome outcome;
    outcome.wanted = wanted.size();
    store.take_finished();
    std::vector<std::size_t> missing = store.missing();
    outcome.found = wanted.size() - missing.size();
    if (inputs.axes.finite_elements()) outcome.fe = run_fe_rows(inputs, grid, missing, jobs, watch, store);
    without_finite_elements(missing, grid);
    std::atomic<std::size_t> done{0};
    watch.begin("sweep", static_cast<double>(missing.size()));
    run_rigid_rows(inputs.scene, grid, missing, jobs, watch, done, store);
    watch.end();
    if (kept) kept->flush();
    outcome.rows = store.finished();
    return outcome;
}

SweepTotals run_long_sweep(const Sweep& inputs, Grid grid, const std::vector<std::size_t>& wanted, ResultStore* kept,
                           int jobs, Watch& watch, const TakePart& take)
{
    std::size_t rows_at_once = 1024; // up to 4096, as long as they take no second: what a kill may lose
    SweepTotals totals;
    totals.wanted = wanted.size();
    std::atomic<std::size_t> done{0};
    if (kept) kept->describe(axes_json(grid));
    watch.begin("sweep", static_cast<double>(wanted.size()));
    SweepOutcome part;
    for (std::size_t first = 0; first < wanted.size() && !watch.stop_asked(); first += part.wanted) {
        const Stopwatch time;
        const std::size_t last = std::min(first + rows_at_once, wanted.size()) - 1;
        const std::vector<std::size_t> ids(wanted.begin() + first, wanted.begin() + last + 1);
        hold_models(grid, inputs.scene, inputs.records, grid.tasks.index(ids.front()).friction,
                    grid.tasks.index(ids.back()).friction, jobs);
        WantedRows store(ids, kept, watch, std::move(part.rows), false);
        store.take_finished();
        const std::vector<std::size_t> missing = store.missing();
        part.wanted = ids.size();
        part.found = ids.size() - missing.size();
        done += part.found;
        run_rigid_rows(inputs.scene, grid, missing, jobs, watch, done, store);
        part.rows = store.finished();
        if (kept && !missing.empty()) kept->append(part.rows);
        if (rows_at_once < 4096 && time.seconds() < 0.25) rows_at_once *= 2;
        if (rows_at_once > 1024 && time.seconds() > 1.0) rows_at_once /= 2;
        totals.rows += part.rows.size();
        totals.found += part.found;
        totals.bad += static_cast<std::size_t>(
            std::count_if(part.rows.begin(), part.rows.end(), [](const FinishedRow& row) { return !row.good; }));
        take(grid, ids, part);
    }
    if (kept) kept->flush();
    watch.end();
    return totals;
}

SweepOutcome run_sweep(const Sweep& sweep, Watch& watch, int jobs)
{
    check_fe_scenes(sweep);
    std::vector<std::size_t> wanted(sweep.tasks.rows());
    std::iota(wanted.begin(), wanted.end(), 0u);
    return run_sweep(sweep, make_grid(sweep.scene, sweep.axes, sweep.tasks, sweep.records, jobs), wanted, nullptr, jobs,
                     watch);
}

} // namespace damslip
