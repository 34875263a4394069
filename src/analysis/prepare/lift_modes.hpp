#pragma once

#include "records/record.hpp"
#include "scene/scene.hpp"
#include "sliding/planes/lifts.hpp"

#include <vector>

/// Vibration of the dam on its bonded base, for lifts.amplification = "modes".
namespace damslip {

struct LiftModes {
    std::vector<double> elevations;                ///< of the lifts [m]
    std::vector<sliding::TiedPart> parts;          ///< of each lift
    std::vector<sliding::ModalShares> overturning; ///< moment about the joint over that of a part that moves with the ground [-]

    /// Of the lift at an elevation. @pre there is one
    const sliding::TiedPart& part(double elevation) const;
};

bool lifts_vibrate(const Scene& scene);

/// Twenty modes, or with acoustic water all up to 20 Hz, on massless rock; each has the damping that Rayleigh's constants give it.
/// Modified Rayleigh damping is that of the first record.
/// @param scene  of a rigid block
/// @throws InputError, NotConverged as a bonded run of `fe`
LiftModes lift_modes(const Scene& scene);

/// Peaks over the peak of the ground by the response spectrum of each motion, modes combined by CQC: of each lift the motion with
/// the largest mean.
std::vector<sliding::LiftAmplification> lift_amplification(const LiftModes& modes, const std::vector<sliding::SkippingMotion>& motions,
                                                           double ratio);

} // namespace damslip
