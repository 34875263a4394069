#pragma once

#include "analysis/fragility/fragility_runs.hpp"
#include "probability/fit.hpp"

#include <functional>

/// What the accuracy of a probability costs: the 95 % interval of P(D > d) at one level, by several estimators and numbers of runs, over the
/// processor time each took.
namespace damslip {

/// One estimate.
struct IntervalPoint {
    std::string estimator;          ///< "plain", "Latin hypercube", "Sobol'"
    std::size_t runs = 0;           ///< of the model whose P is asked for
    double seconds = 0.0;           ///< processor time of all of it [s]
    double p = 0.0;                 ///< P(D > d)
    probability::Interval interval; ///< 95 %, error of the draws, the suite taken as the population
    std::optional<double>
        gain;           ///< variance of plain Monte Carlo for the same seconds over this one's [-]; none: plain itself
    std::string remark; ///< why there is no answer; empty: there is one
    bool done() const { return remark.empty(); }
};

struct IntervalCost {
    LimitInput limit;                  ///< the first of the scene
    double level = 0.0;                ///< intensity [SI]
    std::string method;                ///< "rigid-v", "fe"
    std::vector<IntervalPoint> points; ///< by estimator, then by runs
};

struct IntervalCostOptions {
    std::string method;          ///< whose P is asked for
    std::string rigid;           ///< "rigid-v": the block that finds the level where none is given
    std::optional<double> level; ///< [SI]; none: where P is nearest to 0.1 by the rigid block
    std::size_t runs = 4096;     ///< of the largest estimate; a quarter, a sixteenth ... of it before
    std::size_t sizes = 4;
    std::size_t step = 4;        ///< ratio of neighbouring sizes
    std::size_t replicates = 16; ///< of Latin hypercubes and Sobol' points
    double budget = 300.0;       ///< processor time of all together [s]; what would exceed it is left out, and named
    int jobs = 1;
};

/// Estimators side by side. All variables are drawn as if they varied from earthquake to earthquake (aleatory): the mean of P is the same. Each
/// estimate is run by itself, but for prefixes of plain Monte Carlo with finite elements, which take their share of the longest one's time.
/// @throws InputError where nothing is drawn, for a level that records reach only by a factor beyond suite.max_scale
IntervalCost interval_cost(const FragilityInput& input, const ShakingSuite& suite, const SceneText& text,
                           const NumberInFile& written, const IntervalCostOptions& options, Watch& watch);

/// Adds the gain of each point over plain Monte Carlo, whose half-width falls with the root of the time, through its longest run.
void compare_with_plain(std::vector<IntervalPoint>& points);

/// What a run's own first draws would have given at one level: the interval after a half, a quarter ... of its draws; of dependent draws after so many
/// replicates. Times are known of a run in one go alone. Empty: there are too few.
std::vector<IntervalPoint> own_prefixes(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit,
                                        std::size_t level);

} // namespace damslip
