#include "analysis/sweep/sweep_tasks.hpp"

#include "core/input_error.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <tuple>

namespace damslip {

namespace {

std::optional<std::size_t> whole_number(std::string_view text)
{
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// The place-th row of one method in the order variant, motion, friction, the last fastest.
GridIndex running_order(const TaskList& tasks, std::size_t place)
{
    const auto take = [&place](std::size_t n) {
        const std::size_t i = place % n;
        place /= n;
        return i;
    };
    GridIndex at{};
    at.friction = take(tasks.friction);
    at.polarity = take(tasks.polarity);
    at.scale = take(tasks.scale);
    at.record = take(tasks.record);
    at.damping = take(tasks.damping);
    at.period = take(tasks.period);
    at.size = take(tasks.size);
    at.reservoir = take(tasks.reservoir);
    at.opening = take(tasks.opening);
    at.uplift = take(tasks.uplift);
    at.level = take(tasks.level);
    at.plane = take(tasks.plane);
    return at;
}

} // namespace

GridIndex TaskList::index(std::size_t id) const
{
    const auto take = [&id](std::size_t n) {
        const std::size_t i = id % n;
        id /= n;
        return i;
    };
    GridIndex at{};
    at.method = take(method);
    at.record = take(record);
    at.polarity = take(polarity);
    at.scale = take(scale);
    at.damping = take(damping);
    at.period = take(period);
    at.size = take(size);
    at.reservoir = take(reservoir);
    at.opening = take(opening);
    at.uplift = take(uplift);
    at.level = take(level);
    at.plane = take(plane);
    at.friction = take(friction);
    return at;
}

std::size_t TaskList::id(const GridIndex& at) const
{
    std::size_t id = at.friction * variants() + variant(at);
    id = (id * scale + at.scale) * polarity + at.polarity;
    return (id * record + at.record) * method + at.method;
}

std::size_t TaskList::variant(const GridIndex& at) const
{
    const std::size_t base =
        ((((at.plane * level + at.level) * uplift + at.uplift) * opening + at.opening) * reservoir + at.reservoir) *
            size +
        at.size;
    return (base * period + at.period) * damping + at.damping;
}

std::size_t TaskList::motion(const GridIndex& at) const
{
    return (at.record * scale + at.scale) * polarity + at.polarity;
}

double friction_of(const Axes& axes, const GridIndex& at)
{
    return axes.plane_friction.empty() ? axes.friction[at.friction] : axes.plane_friction[at.plane];
}

TaskList make_tasks(const Axes& axes, std::size_t records)
{
    TaskList tasks;
    tasks.friction = axes.friction.size();
    tasks.level = axes.level.size();
    tasks.plane = axes.plane.size();
    tasks.uplift = axes.uplift.size();
    tasks.opening = axes.opening.size();
    tasks.reservoir = axes.reservoir.size();
    tasks.size = axes.size.size();
    tasks.period = std::max<std::size_t>(1, axes.period.size());
    tasks.damping = std::max<std::size_t>(1, axes.damping.size());
    tasks.scale = axes.scale.size();
    tasks.polarity = axes.polarity.size();
    tasks.record = records;
    tasks.method = axes.method.size();
    return tasks;
}

Shard parse_shard(const std::string& text, const std::string& flag)
{
    const std::size_t slash = text.find('/');
    const auto index = whole_number(text.substr(0, slash)),
               count = slash == std::string::npos ? std::nullopt : whole_number(text.substr(slash + 1));
    if (!index || !count || *count == 0 || *count > 1'000'000 || *index >= *count)
        throw UsageError(Diagnostic{"", 0, 0, fmt::format("{} {} is not allowed.", flag, text),
                                    "i/n with whole numbers, i from 0 to n - 1: the i-th of n parts",
                                    fmt::format("for four parts  {0} 0/4 ... {0} 3/4", flag)});
    return {*index, *count};
}

std::vector<std::size_t> shard_rows(const TaskList& tasks, const Shard& shard)
{
    if (shard.count == 1) {
        std::vector<std::size_t> all(tasks.rows());
        std::iota(all.begin(), all.end(), std::size_t{0});
        return all;
    }
    const std::size_t of_method = tasks.rows() / tasks.method;
    // n may be above the number of rows; 1e6 parts of 2e7 rows stay below 2^64
    const std::size_t first = shard.index * of_method / shard.count, last = (shard.index + 1) * of_method / shard.count;
    std::vector<std::size_t> rows;
    rows.reserve((last - first) * tasks.method);
    for (std::size_t place = first; place < last; ++place) {
        GridIndex at = running_order(tasks, place);
        for (at.method = 0; at.method < tasks.method; ++at.method) rows.push_back(tasks.id(at));
    }
    std::sort(rows.begin(), rows.end());
    return rows;
}

std::vector<FeGroup> fe_groups(const TaskList& tasks, const Axes& axes, const std::vector<std::size_t>& rows,
                               std::size_t parts)
{
    std::map<std::tuple<std::size_t, std::size_t, std::size_t>, FeGroup> found; // by variant, method, motion
    for (const std::size_t id : rows) { // ascending ids: ascending frictions within a group
        const GridIndex at = tasks.index(id);
        if (axes.method[at.method].kind != SweepKind::finite_elements) continue;
        FeGroup& group = found[{tasks.variant(at), at.method, tasks.motion(at)}];
        group.variant = tasks.variant(at);
        group.method = at.method;
        group.motion = tasks.motion(at);
        group.rows.push_back(id);
    }
    const std::size_t shares = found.empty() ? 1 : (parts + found.size() - 1) / found.size();
    std::vector<FeGroup> groups;
    for (const auto& [key, group] : found) {
        const std::size_t here = std::min(std::max<std::size_t>(1, shares), group.rows.size());
        for (std::size_t share = 0; share < here; ++share) { // every here-th friction: low ones fail at once
            FeGroup part{group.variant, group.motion, group.method, {}};
            for (std::size_t k = share; k < group.rows.size(); k += here) part.rows.push_back(group.rows[k]);
            groups.push_back(std::move(part));
        }
    }
    return groups;
}

std::vector<FeGroup> with_stopped_in_pieces(std::vector<FeGroup> groups, const std::map<std::size_t, int>& stopped)
{
    if (stopped.empty()) return groups;
    std::vector<FeGroup> pieces;
    for (const FeGroup& group : groups) {
        int times = 0;
        for (const std::size_t id : group.rows)
            if (const auto found = stopped.find(id); found != stopped.end()) times = std::max(times, found->second);
        const std::size_t length = std::max<std::size_t>(1, times < 32 ? group.rows.size() >> times : 0);
        for (std::size_t first = 0; first < group.rows.size(); first += length) {
            FeGroup piece{group.variant, group.motion, group.method, {}, times > 0};
            for (std::size_t k = first; k < std::min(group.rows.size(), first + length); ++k)
                piece.rows.push_back(group.rows[k]);
            pieces.push_back(std::move(piece));
        }
    }
    return pieces;
}

} // namespace damslip
