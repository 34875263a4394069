#pragma once

#include "analysis/fragility/fragility_estimate.hpp"
#include "probability/annual_rate.hpp"
#include "probability/sampling.hpp"

namespace damslip {

/// Capacities of an incremental dynamic analysis by roots in place of the first level above the limit, for the rigid block that slides one way under
/// the horizontal component (scene: sliding.two_way = false; method "rigid"). Its slip obeys D(k a; a_y) = k D(a; a_y / k), k the factor on the record,
/// and grows with k, so that D = d has one root between the level before and the first one that fails; found to 1e-12 of k.
///
/// A draw counts only if its own run at the failing level obeys the equation to 1e-9: laws that change on the way (residual strength, drains lost,
/// cracks) keep the first level, and their number is said.
/// @returns false where the design, the method or the scene is another: nothing is changed then
bool capacities_by_roots(FragilityEstimate& estimate, const FragilityPlan& plan, const FragilityRuns& runs,
                         const SceneText& text, const SweepMethod& method, int jobs);

/// Which variables P at one level comes from, by the rigid block: P of a draw is that of the whole suite.
struct FragilityCauses {
    std::size_t level = 0; ///< place in the levels: where P of the first limit is nearest to one half
    LimitInput limit;
    std::optional<probability::SobolIndices>
        shares; ///< of independent variables, in their order; none: they are correlated, or P does not vary
    /// Of correlated variables (Shapley), in their order: they sum up to 1. None: independent, more than most_shapley, or P does not vary.
    std::optional<probability::ShapleyEffects> shapley;
    std::vector<probability::TornadoBar> bars; ///< longest first
    std::size_t runs = 0;
};

/// All subsets of k correlated variables are 2^k - 1.
inline constexpr std::size_t most_shapley = 8;

/// @param rows  of each of two samples (Saltelli); runs: rows (variables + 2) x records x polarities. Of k correlated variables rows draws of each
///              subset with three of its variables each (Song, Nelson & Staum 2016), for k > 4 of a subset rows 2^4 / 2^k, 16 at least
/// @returns nothing without variables, for a cloud, or where every P is 0 or 1
std::optional<FragilityCauses> fragility_causes(const FragilityPlan& plan, const FragilityEstimate& estimate,
                                                const SceneText& text, const NumberInFile& written,
                                                const SweepMethod& rigid, std::size_t rows, int jobs, Watch& watch);

/// Yield acceleration over g with which the block, one way and on a level base, slips d* under a record.
struct NeededYield {
    double x = 0.0;                         ///< intensity [SI]
    double k16 = 0.0, k50 = 0.0, k84 = 0.0; ///< percentiles over records and polarities [-]
};

/// k_max(d*) at each level: D falls with the yield, its root is found by bisection. Of the rigid block, whatever the dam.
std::vector<NeededYield> needed_yield(const FragilityPlan& plan, const SceneText& text, double slip);

/// P over the water level, of runs that draw reservoir.level_m from a few values: one place for each limit and intensity.
///
/// At each value P and Wilson's interval of its runs, made non-decreasing (isotonic regression); at each P so reached the most likely stage is where
/// that curve reaches it, its ends where the upper and the lower end of the intervals do: linear between the values, kept within them.
/// Values at which nothing fails have no row, and a place of one row is left out.
/// @returns nothing where no variable, or not a discrete one, is reservoir.level_m, or fewer than two values of it were drawn
std::vector<probability::UsaceLocation> stage_fragility(const FragilityPlan& plan, const FragilityRuns& runs);

/// The nearest non-decreasing values (pool adjacent violators; Barlow et al. 1972). @param weight  > 0, as long as y
std::vector<double> non_decreasing(std::vector<double> y, const std::vector<double>& weight);

} // namespace damslip
