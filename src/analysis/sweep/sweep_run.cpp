#include "analysis/sweep/sweep_run.hpp"

#include "core/input_error.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>
#include <tuple>
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
        [&](std::span<const std::size_t> ids, std::span<const fe2d::RunResult> runs) {
            std::vector<FinishedRow> rows;
            for (std::size_t i = 0; i < ids.size(); ++i) {
                if (runs[i].status == Status::interrupted) continue;
                rows.push_back(fe_row(ids[i], runs[i], inputs.tasks.rows() <= most_rows_with_history));
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

namespace {

SweepComparison comparison_at(const Scene& scene, const Grid& grid, const SweepOutcome& outcome, GridIndex g)
{
    SweepComparison c;
    c.at = g;
    c.largest_error = 0.0;
    const RigidModel& model = grid.model(g);
    double fe = 0.0, rigid = 0.0;
    for (g.record = 0; g.record < grid.records.size(); ++g.record)
        for (g.polarity = 0; g.polarity < grid.axes.polarity.size(); ++g.polarity) {
            const FinishedRow* row = outcome.find(grid.tasks.id(g));
            if (!row) continue;
            const RowResults& found = row->results;
            if (found.critical_friction) c.critical_friction = found.critical_friction;
            const Status status = status_of(*row).value_or(Status::not_resolved);
            c.static_failures += fails_statically(status);
            if (!found.slip || !is_answer(status)) c.without.add(status);
            if (!is_answer(status) || !found.slip || model.state != sliding::StaticState::at_rest) continue;
            const sliding::SlideResult slide =
                slide_model(scene, model, grid.motion(g), grid.axes.polarity[g.polarity]);
            const std::optional<double> block = reported(slide.status, std::abs(slide.slip));
            if (!block) continue;
            const double slip = std::abs(*found.slip);
            ++c.motions;
            fe += slip;
            rigid += *block;
            c.largest_fe = std::max(c.largest_fe, slip);
            c.largest_rigid = std::max(c.largest_rigid, *block);
            c.largest_error = found.slip_error && c.largest_error
                                  ? std::optional(std::max(*c.largest_error, *found.slip_error))
                                  : std::nullopt;
        }
    const auto n = static_cast<double>(std::max<std::int64_t>(1, c.motions));
    c.mean_fe = fe / n;
    c.mean_rigid = rigid / n;
    if (rigid > 0.0) c.ratio_of_means = fe / rigid;
    return c;
}

} // namespace

std::vector<SweepComparison> compare_with_rigid(const Scene& scene, const Grid& grid, const SweepOutcome& outcome)
{
    std::vector<SweepComparison> list;
    for (std::size_t id = 0; id < grid.tasks.rows(); ++id) { // one of each group of motions stands for it
        const GridIndex g = grid.tasks.index(id);
        if (g.record == 0 && g.polarity == 0 && grid.axes.method[g.method].kind == SweepKind::finite_elements)
            list.push_back(comparison_at(scene, grid, outcome, g));
    }
    return list;
}

namespace {

/// All that the records, as they are read, depend on.
std::string names_of_records(const Scene& scene)
{
    std::string text = fmt::format("{}|{}|{}", scene.motion.vertical, scene.motion.sequence_pause,
                                   fmt::join(scene.motion.sequence, "|"));
    for (const RecordFiles& r : scene.motion.records)
        text += fmt::format("\n{}|{}|{}|{}|{}|{}|{}|{}|{}", r.name, r.horizontal.string(),
                            r.vertical ? r.vertical->string() : "", r.unit, r.dt.value_or(0.0), r.column,
                            r.vertical_column, r.magnitude.value_or(0.0), r.scale);
    return text;
}

std::size_t record_index(const Records& records, const std::string& name)
{
    std::vector<std::string> names;
    for (const RecordPair& pair : *records) names.push_back(pair.files.name);
    if (name.empty() && names.size() == 1) return 0;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
    refuse_usage(name.empty() ? fmt::format("the scene has {} records, and none is named.", names.size())
                              : fmt::format("the scene has no record \"{}\".", name),
                 fmt::format("one of \"{}\"", fmt::join(names, "\", \"")), "name one of them as \"record\"");
}

/// What a method needs of the scene. @throws UsageError
void check_method(const Scene& scene, const SweepMethod& method)
{
    if (scene.wedge && method.kind == SweepKind::finite_elements)
        refuse_usage(fmt::format("method {} cannot take a [wedge]: it has no section for finite elements.", method.id),
                     "rigid, rigid-v and the regressions", "write another method");
    if (is_flexible(method.kind) && (scene.wedge || (!scene.flexible_block && scene.regressions.period <= 0.0)))
        refuse_usage(fmt::format("method {}: the scene does not say how the block vibrates.", method.id),
                     "[flexible_block] with period_s, or regressions.period_s", "add it to the scene");
    if (method.law == FeLaw::penalty && !scene.contact.tangential_stiffness)
        refuse_usage("method fe-penalty: the scene does not give the stiffness of sticking.",
                     "contact.tangential_stiffness_N_m3 with enforcement = \"penalty\"", "write  fe  or  fe-exact");
}

} // namespace

PointAnswer PointRuns::run(const Scene& scene, const SweepMethod& method, const std::string& record, Watch& watch)
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    check_method(scene, method);
    const std::string names = names_of_records(scene);
    if (!records_ || names != names_) records_ = load_records(scene, Method::rigid_block);
    names_ = names;
    Axes axes = axes_of(scene);
    axes.method = {method};
    Sweep sweep{scene, std::move(axes), {}, records_};
    sweep.tasks = make_tasks(sweep.axes, records_->size());
    check_fe_scenes(sweep);
    GridIndex at = sweep.tasks.index(0);
    at.record = record_index(records_, record);
    std::vector<std::size_t> ids;
    for (at.polarity = 0; at.polarity < sweep.axes.polarity.size(); ++at.polarity) ids.push_back(sweep.tasks.id(at));
    const Grid grid = make_grid(scene, sweep.axes, sweep.tasks, records_, 1);
    SweepOutcome outcome = run_sweep(sweep, grid, ids, nullptr, 1, watch);
    if (outcome.rows.size() < ids.size()) throw Interrupted("a point");
    const auto severity = [](const FinishedRow& row) {
        return std::tuple(!row.good, !row.results.slip, row.results.max_slip ? std::abs(*row.results.max_slip) : 0.0);
    };
    FinishedRow& worse = *std::max_element(outcome.rows.begin(), outcome.rows.end(),
                                           [&](const auto& a, const auto& b) { return severity(a) < severity(b); });
    const int polarity = sweep.axes.polarity[sweep.tasks.index(worse.id).polarity];
    return {std::move(worse), (*records_)[at.record].files.name, polarity, method.id, clock.seconds()};
}

SweepMethod usual_method(const Scene& scene)
{
    const bool vertical = std::any_of(scene.motion.records.begin(), scene.motion.records.end(),
                                      [](const RecordFiles& r) { return r.vertical.has_value(); });
    return sweep_method(vertical && scene.motion.vertical ? "rigid-v" : "rigid");
}

static void to_json(nlohmann::ordered_json& json, const SweepMethod& method)
{
    json = method.id;
}

static void from_json(const nlohmann::ordered_json& json, SweepMethod& method)
{
    method = sweep_method(json.get<std::string>());
}

namespace {

namespace fs = std::filesystem;

/// Calls with the name and the values of each list of a grid, and how many rows one after the other share a value; 0: a list
/// that has no value for a row.
template <class AnyGrid, class Call>
void for_each_list(AnyGrid& grid, const Call& call)
{
    const auto every = [&grid](std::size_t GridIndex::*axis) {
        GridIndex one{};
        one.*axis = 1;
        return grid.tasks.id(one);
    };
    call("friction", grid.axes.friction, every(&GridIndex::friction));
    call("level_at_size_1_m", grid.axes.level, every(&GridIndex::level));
    call("plane", grid.axes.plane, every(&GridIndex::plane));
    call("plane_friction", grid.axes.plane_friction, std::size_t{0});
    call("uplift", grid.axes.uplift, every(&GridIndex::uplift));
    call("opening_water", grid.axes.opening, every(&GridIndex::opening));
    call("reservoir", grid.axes.reservoir, every(&GridIndex::reservoir));
    call("size", grid.axes.size, every(&GridIndex::size));
    call("period_s", grid.axes.period, every(&GridIndex::period));
    call("damping", grid.axes.damping, every(&GridIndex::damping));
    call("scale", grid.axes.scale, every(&GridIndex::scale));
    call("polarity", grid.axes.polarity, every(&GridIndex::polarity));
    call("record", grid.records, every(&GridIndex::record));
    call("method", grid.axes.method, every(&GridIndex::method));
    call("pga_m_s2", grid.pgas, grid.tasks.method);
    call("rock", grid.rocks, every(&GridIndex::method));
    call("event", grid.events, std::size_t{0});
    call("anchor", grid.anchors, std::size_t{0});
}

/// All files that paths name.
std::vector<fs::path> part_files(const std::vector<fs::path>& paths)
{
    static const std::regex name(R"(.*\.[0-9]+-of-[0-9]+\.sqlite)");
    std::vector<fs::path> files;
    for (const fs::path& path : paths) {
        std::error_code error;
        if (!fs::is_directory(path, error)) {
            files.push_back(path);
            continue;
        }
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(path, error))
            if (std::regex_match(entry.path().filename().string(), name)) found.push_back(entry.path());
        if (error) refuse(path, "the folder cannot be read: " + error.message() + ".", "a readable folder", "");
        if (found.empty())
            refuse(path, "there is no part of a sweep in this folder.", "files named *.i-of-n.sqlite",
                   "run the parts first:  damslip sweep ... --out results.csv --shard i/n");
        std::sort(found.begin(), found.end());
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

std::string named(const Shard& shard)
{
    return fmt::format("{}/{}", shard.index, shard.count);
}

void check_none_missing(const std::map<std::size_t, fs::path>& parts, std::size_t count)
{
    std::string missing, flags;
    for (std::size_t i = 0; i < count; ++i) {
        if (parts.contains(i)) continue;
        missing += (missing.empty() ? "" : ", ") + named({i, count});
        flags += (flags.empty() ? "--shard " : ", --shard ") + named({i, count});
    }
    if (!missing.empty())
        refuse({}, fmt::format("{} of {} parts are missing: {}.", count - parts.size(), count, missing),
               "all parts of the sweep", "run them:  " + flags);
}

} // namespace

std::string axes_json(const Grid& grid)
{
    nlohmann::ordered_json axes;
    for_each_list(grid, [&](const char* name, const auto& values, std::size_t every) {
        if (std::string_view(name).starts_with("plane") && !has_plane_axis(grid.axes)) return;
        axes[name] = {{"every", every}, {"values", values}};
    });
    return axes.dump();
}

Grid stored_grid(const std::string& axes)
{
    const auto json = nlohmann::ordered_json::parse(axes);
    Grid grid;
    for_each_list(grid, [&](const char* name, auto& values, std::size_t) {
        if (json.contains(name)) json[name]["values"].get_to(values);
    });
    grid.tasks = make_tasks(grid.axes, grid.records.size());
    return grid;
}

MergedSweep merge_parts(const std::vector<fs::path>& paths, const fs::path& file)
{
    const std::vector<fs::path> files = part_files(paths);
    SweepIdentity identity;
    std::string axes;
    std::size_t count = 0, rows = 0;
    std::map<std::size_t, fs::path> parts; // by index
    for (const fs::path& name : files) {
        const ResultStore part(name);
        std::error_code error;
        if (fs::equivalent(name, file, error))
            refuse(name, "this part is where the whole would be.", "another --out", "choose another --out");
        if (parts.empty()) {
            identity = part.identity();
            axes = part.axes();
            count = part.shard().count;
        }
        if (!(part.identity() == identity) || part.axes() != axes || part.shard().count != count)
            refuse(name,
                   fmt::format("part {} is not of the same sweep as {}.", named(part.shard()), files.front().string()),
                   "parts of one sweep: the same scene, records, grid, version and number of parts",
                   "merge the parts of each sweep by themselves");
        if (!part.done() || part.damaged())
            refuse(name,
                   part.damaged() ? fmt::format("{} rows are damaged.", part.damaged()) : "this part is not finished.",
                   "parts that ran to their end", fmt::format("go on with  --shard {} --resume", named(part.shard())));
        const auto [there, fresh] = parts.emplace(part.shard().index, name);
        if (!fresh)
            refuse(name,
                   fmt::format("part {} is given twice, also as {}.", named(part.shard()), there->second.string()),
                   "each part once", "leave one of them out");
        rows += part.finished();
    }
    check_none_missing(parts, count);
    if (rows != identity.rows)
        refuse(files.front(), fmt::format("the parts have {} rows, the sweep {}.", rows, identity.rows), "all rows",
               "run the parts again");
    auto whole = std::make_unique<ResultStore>(file, identity, Shard{}, StoreStart::fresh);
    for (const auto& [index, name] : parts) whole->take(name);
    whole->describe(axes);
    return {std::move(whole), count};
}

} // namespace damslip
