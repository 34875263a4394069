#pragma once

#include "sliding/block/slow_water.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <memory>

namespace damslip::sliding {

/// Water of uplift.opening = "mouth" under the rigid block. With pressure p(x_w, x_t), U and M_U its force and its moment
/// about the heel, a tip x_t of the heel's crack belongs to N' at r = L - (L - x_t)/3 from the heel, and so to one ground
/// acceleration (loads N, M are linear in a_h and a_v):
///
///     a_h(x_w, x_t) = -[M_0 + M_v a_v + M_U + r (N_0 + N_v a_v - U)] / (M_h + r N_h)
///
/// and the toe's crack likewise with r = (L - x_t)/3. The tip under a_h is found by bisection; x_w never passes it. The
/// block slides with the crack at which drive = c A' + mu N' along that curve: a table over x_w (33 values up to the full crack, and both sides
/// of curtain and drains) and a_v, linear between.
///
/// @param before  the block at rest @param block  of it, with friction and bond
/// @param speed   v_w [m/s], above 0
/// @param vertical  for vertical accelerations to 1 g, in steps of 0.1 g; else for none
std::shared_ptr<const SlowWater> mouth_water(const Scene& scene, const StaticCase& static_case, const BaseState& before,
                                             const RigidBlock& block, double speed, bool vertical,
                                             const SeepageProfile& seepage);

} // namespace damslip::sliding
