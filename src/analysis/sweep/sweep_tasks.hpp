#pragma once

#include "analysis/sweep/sweep_axes.hpp"

#include <map>

namespace damslip {

/// Positions of one row on the axes.
struct GridIndex {
    std::size_t friction, level, uplift, reservoir, size, scale, polarity, record, method;
    std::size_t opening = 0, period = 0, damping = 0, plane = 0;
};

/// The rows of a sweep: the Cartesian product friction x plane x level x uplift x opening water x reservoir x size x period x
/// damping x scale x polarity x record x method, numbered from 0 in this order, the last axis fastest.
struct TaskList {
    std::size_t friction = 1, level = 1, uplift = 1, reservoir = 1, size = 1, scale = 1, polarity = 1, record = 1,
                method = 1, opening = 1, period = 1, damping = 1, plane = 1; ///< values on each axis

    std::size_t rows() const { return friction * variants() * motions() * method; }
    std::size_t variants() const
    {
        return plane * level * uplift * opening * reservoir * size * period * damping;
    } ///< scenes but for the friction
    std::size_t motions() const { return record * scale * polarity; }
    std::size_t rows_of_model() const { return motions() * method; } ///< ids of one friction and variant follow each other

    GridIndex index(std::size_t id) const;
    std::size_t id(const GridIndex& at) const;
    std::size_t variant(const GridIndex& at) const; ///< 0 ... variants() - 1
    std::size_t motion(const GridIndex& at) const;  ///< 0 ... motions() - 1, polarity fastest, record slowest
};

/// Friction of the plane that a row slides on [-].
double friction_of(const Axes& axes, const GridIndex& at);

TaskList make_tasks(const Axes& axes, std::size_t records);

/// Part i of n of a sweep, i from 0.
struct Shard {
    std::size_t index = 0, count = 1;
    friend bool operator==(const Shard&, const Shard&) = default;
};

/// "2/4". @param flag  for messages @throws UsageError
Shard parse_shard(const std::string& text, const std::string& flag);

/// Ids of a part, ascending. The rows of each method are taken in the order variant, motion, friction, so that rows which
/// share a set-up stay together, and cut into n runs of equal length, give or take a row: every part gets its share
/// of each method.
std::vector<std::size_t> shard_rows(const TaskList& tasks, const Shard& shard);

/// Frictions of one variant, motion and FE method: what marches through the earthquake together.
struct FeGroup {
    std::size_t variant = 0, motion = 0, method = 0;
    std::vector<std::size_t> rows; ///< ids, by friction
    bool alone = false;            ///< no other motion goes with it: its rows were stopped before they finished
};

/// FE rows among `rows` in groups, ordered by variant, method and motion. Each group is dealt out to
/// at most `parts` groups where there are fewer groups than parts; the slips do not depend on it.
std::vector<FeGroup> fe_groups(const TaskList& tasks, const Axes& axes, const std::vector<std::size_t>& rows,
                               std::size_t parts);

/// Groups whose rows were stopped n times before they finished, cut into pieces of a 2^n-th of their rows, at least one: what stops
/// again and again before a group is through gets through in the end, with the same slips.
/// @param stopped  how often, by id of row
std::vector<FeGroup> with_stopped_in_pieces(std::vector<FeGroup> groups, const std::map<std::size_t, int>& stopped);

} // namespace damslip
