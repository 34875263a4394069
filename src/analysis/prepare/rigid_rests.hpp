#pragma once

#include "scene/scene.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <memory>

namespace damslip {

/// The rigid block of one static state.
struct RigidStages {
    sliding::RigidBlock block;          ///< before any slip
    sliding::SlipStages stages;         ///< strength and uplift over slip
    sliding::SlipStages opening_stages; ///< the same with the uplift of the crack that each opens (uplift.opening)
};
/// @param later  with the drains lost; null: they are not @param options  its seepage alone is read here
RigidStages rigid_stages(const Scene& scene, const sliding::StaticCase& static_case, const sliding::BaseState& before,
                         const sliding::BaseState* later, const sliding::BlockOptions& options);

/// Between the records of a sequence with uplift.after = "full": full head on what has cracked so far, curtain ruptured, drains
/// without effect where the crack has reached them. Of cracks from both ends the longer one holds water.
/// @returns null without a sequence, or where uplift.after leaves the water as it was
std::shared_ptr<const sliding::RestBetweenEvents> rests_of(const Scene& scene, const sliding::StaticCase& static_case,
                                                           const sliding::BaseState& before,
                                                           const sliding::RigidBlock& block,
                                                           const sliding::BlockOptions& options);

} // namespace damslip
