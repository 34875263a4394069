#pragma once

#include "analysis/prepare/ready.hpp"
#include "analysis/sweep/sweep_axes.hpp"
#include "core/parallel.hpp"
#include "core/status.hpp"
#include "fe2d/run/earthquake_run.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace damslip {

/// Slip of one row over time, as much of it as a chart shows.
struct SlipHistory {
    double interval = 0.0;    ///< between values, the first at t = 0 [s]; 0: no history
    std::vector<double> slip; ///< positive downstream, whole multiples of 0.1 µm [m]

    friend bool operator==(const SlipHistory&, const SlipHistory&) = default;
};

constexpr std::size_t history_values = 400;          ///< at most
constexpr std::size_t most_rows_with_history = 1000; ///< sweeps of more rows keep none

/// Every n-th value, n so that there are at most `history_values`; the last interval is cut where it does not fit.
/// @param time, slip  of equal length [s, m], time ascending; values between them are interpolated where the samples are
/// not evenly spaced
SlipHistory slip_history(const std::vector<double>& time, const std::vector<double>& slip);

/// Counts of the FE runs of this process that do not depend on the number of threads, and processor seconds.
struct FeSweepCounts {
    std::int64_t set_ups = 0; ///< meshes and matrices made
    std::int64_t runs = 0, static_failures = 0, steps = 0, factorisations = 0, unresolved = 0;
    double set_up_seconds = 0.0, static_seconds = 0.0, dynamic_seconds = 0.0;
    std::set<std::string> choices;  ///< what reservoir.model = "auto" became, a sentence each
    std::set<std::string> failures; ///< why models could not be made, a sentence each
};

/// A scene and all that is varied of it.
struct Sweep {
    Scene scene; ///< as given, not yet called for by an effect plan
    Axes axes;
    TaskList tasks;
    Records records;
    std::optional<int> modes = {};                ///< of reduced runs
    std::optional<double> penalty_stiffness = {}; ///< of the method fe-penalty [N/m^3]; none: the scene's
    bool truncation_error = false;                ///< estimate of each reduced run what the modes left out change
};

/// Reads the records. @throws InputError
Sweep make_sweep(Scene scene, Axes axes);

/// Scenes that FE cannot take are found here, before anything is computed. @throws UsageError
void check_fe_scenes(const Sweep& inputs);

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

/// Takes finished runs as soon as they are there, by the ids of their rows; called from several threads.
using TakeRuns = std::function<void(std::span<const std::size_t> ids, std::span<const fe2d::RunResult> runs)>;

/// Called with the rows of a group before they go through the earthquake; called from several threads.
using BeginRows = std::function<void(std::span<const std::size_t> ids)>;

/// Runs all groups. Mesh, matrices and condensed rock of a variant and contact law are made once, when the first of its
/// groups comes up, and given back after the last; the frictions of a group go through the earthquake together.
/// Results do not depend on the number of threads.
FeSweepCounts run_fe_groups(const Sweep& inputs, const std::vector<FeGroup>& groups, int jobs, Watch& watch,
                            const BeginRows& begin, const TakeRuns& take);

/// All that the rows of a sweep depend on. Equal identities: equal rows, bit for bit, on one machine.
struct SweepIdentity {
    std::string version; ///< of the program
    std::string scene;   ///< scene_hash after the command line's changes
    std::string records; ///< SHA-256 over the contents of all record files and the imported mesh
    std::string grid;    ///< axes and options in words
    std::size_t rows = 0;

    friend bool operator==(const SweepIdentity&, const SweepIdentity&) = default;
};

/// The record files of the scene are read.
SweepIdentity sweep_identity(const Sweep& inputs);

/// SHA-256 over all members.
std::string hash_of(const SweepIdentity& identity);

/// Comment lines on top of the CSV.
std::vector<std::string> csv_comments(const SweepIdentity& identity);

} // namespace damslip
