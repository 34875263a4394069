#pragma once

#include "analysis/fragility/fragility_estimate.hpp"

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

} // namespace damslip
