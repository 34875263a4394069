#pragma once

#include "analysis/fragility/fragility_estimate.hpp"
#include "probability/sensitivity/indices.hpp"

namespace damslip {

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

} // namespace damslip
