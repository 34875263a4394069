#pragma once

#include "sliding/equilibrium/base_state.hpp"

#include <memory>
#include <optional>

namespace damslip::sliding {

/// The rule of the crack that opens while the base is shaken, by uplift.opening.
/// @returns none where the opening leaves the block's uplift as it is: unchanged, reynolds
std::optional<CrackRule> crack_rule_while_open(OpeningWater opening);

/// Uplift of the block that slides with the crack its own acceleration opens, by uplift.opening of the scene: the smallest
/// a_h with
///
///     drive(a_h) = c A' + mu N'(a_h),   N' = N - U(x_t),   L - x_t = 3 x (distance of N' from the compressed end)
///
/// found by a scan over x_t, for the resistance need not fall steadily. c A' is that of the static state. Water
/// that needs time to enter (mouth) is taken to have had it, as full, and comes beside it as OpeningUplift::slow; of a crack
/// that runs through at once the last state before it counts (base_limits() says where).
/// @param block  of `before`, with its friction
/// @param vertical  for all vertical accelerations to 1 g, in steps of 0.01 g; else for none
/// @returns null where uplift.opening leaves the block's uplift as it is: unchanged, reynolds (a block has no width of the
/// joint), no uplift
std::shared_ptr<const OpeningUplift> opening_uplift(const Scene& scene, const StaticCase& static_case,
                                                    const BaseState& before, const RigidBlock& block, bool vertical,
                                                    const SeepageProfile& seepage);

} // namespace damslip::sliding
