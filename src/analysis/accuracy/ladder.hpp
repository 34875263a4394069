#pragma once

#include "analysis/accuracy/rung.hpp"
#include "scene/rock_mass.hpp"

#include <functional>
#include <vector>

/// Which rungs a scene's ladder has. Nothing is computed here: the next rung follows from the scene's facts and from what
/// the rungs so far have given.
namespace damslip {

enum class Effort {
    quick, ///< fewer steps, no mesh finer than the scene's, no variants of law and scheme
    full
};

/// What of a scene and its records decides about rungs.
struct LadderFacts {
    std::vector<std::string> regressions; ///< ids of the best valid ones, and "ensemble"; none: none is valid
    bool vertical = false;                ///< some record has a vertical component that counts
    bool slammer = false;                 ///< the scene asks for SLAMMER's scheme
    bool rocks = false;                   ///< in some motion the block tips before it slides
    std::vector<RungWater> waters;        ///< FE models from poor to rich; none: no finite elements
    bool reducible = false;               ///< the first of them can run on few modes
    std::vector<double> alphas;           ///< of HHT, other than the scene's [-]
    bool own_settings = false;            ///< the scene fixes step or contact law otherwise than the ladder
    RockKind rock = RockKind::rigid;      ///< what the rungs stand on
    bool quadratic = false;               ///< the scene's elements are linear: quadratic ones are tried beside them
    double coarsest = 1.0;                ///< largest mesh factor that leaves enough elements on the base: 1, 2, 4
    std::vector<std::string> left_out;    ///< a sentence for each kind of rung that this scene has not
};

struct LadderOptions {
    Effort effort = Effort::full;
    double tolerance = 0.02; ///< of the deviation from the top rung [-]; steps are halved until a quarter of it is left
};

/// The rungs whose place in the ladder is settled by what has been run, in the order in which they are climbed: for each
/// FE model a row of halved steps, refined until the slip is settled, then other meshes, contact laws, schemes and mode
/// counts beside it; fine meshes of all models last, those of the richest until the slip is settled, in the mesh and then
/// in the step; the top rung at the very end.
std::vector<Rung> ladder(const LadderFacts& facts, const LadderOptions& options, const std::vector<RungResult>& so_far);

/// The first of them without a result; nothing when the ladder is climbed.
std::optional<Rung> next_rung(const LadderFacts& facts, const LadderOptions& options,
                              const std::vector<RungResult>& so_far);

/// Is `a` the poorer method, or the coarser rung of the same model?
bool below(const Rung& a, const Rung& b);

/// The finest rung of the richest model among the results; nothing when none is done.
std::optional<std::size_t> top_rung(const std::vector<RungResult>& results);

/// Row of one FE model on the scene's mesh: results with dt, dt/2 ... in this order, as far as they are done.
std::vector<const RungResult*> step_row(const std::vector<RungResult>& results, RungWater water);

/// Row of one FE model on the finest mesh that has two steps: the finest steps that follow each other there. The scene's
/// mesh where no other has two.
std::vector<const RungResult*> fine_row(const std::vector<RungResult>& results, RungWater water);

/// Column of one FE model: results on all meshes with the step that has most of them, from coarse to fine.
std::vector<const RungResult*> mesh_column(const std::vector<RungResult>& results, RungWater water);

/// Slips of one motion [m].
std::vector<double> slips_of(const std::vector<const RungResult*>& rungs, std::size_t motion);

/// Seconds a rung will take, from the nearest of its model: steps times unknowns^1.25; nothing to go by: nothing.
std::optional<double> expected_seconds(const Rung& rung, const std::vector<RungResult>& so_far);

struct ClimbOptions {
    LadderOptions ladder;
    int repeats = 3;              ///< of a rung at most, >= 1; see repeated_enough
    std::optional<double> budget; ///< processor time for all rungs and repeats together [s]; none: no end
};

/// What the climb asks for and tells.
struct ClimbCalls {
    std::function<RungResult(const Rung&)> run;               ///< once
    std::function<double(const Rung&)> least_seconds = {};    ///< of a rung whose neighbours say nothing; empty: 0 [s]
    std::function<bool()> interrupted;                        ///< empty: never
    std::function<void(const Rung&)> begins;                  ///< empty: nobody listens
    std::function<void(const std::vector<RungResult>&)> ends; ///< after each rung, all results so far; may be empty
};

/// A rung is repeated while it has taken less than this in all, so one of a second is run three times and one of two
/// seconds once.
inline constexpr double repeat_seconds = 3.5;

/// Climbs the ladder of a scene. Rungs that would exceed the budget by what they are expected to take, or that it ends, are `skipped` and
/// stay in the list; so do those that fail. An interrupt ends the climb; what was finished is kept, the rung under way is
/// not.
std::vector<RungResult> climb(const LadderFacts& facts, const ClimbOptions& options, const ClimbCalls& calls);

/// One rung, repeated: the seconds are the median.
RungResult run_repeatedly(const Rung& rung, int repeats, const ClimbCalls& calls);

} // namespace damslip
