#include "analysis/sweep/sweep_store.hpp"

#include "core/input_error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

namespace damslip {

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
