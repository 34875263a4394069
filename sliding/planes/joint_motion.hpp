#pragma once

#include "sliding/block/slide.hpp"

#include <vector>

/// Two steps: the dam vibrates on its bonded base, then the block above a joint slides under the motion of the joint.
namespace damslip::sliding {

/// One mode of the dam on its bonded base.
struct TiedMode {
    double frequency = 0.0; ///< [Hz], > 0
    double ratio = 0.0;     ///< ζ [-]
};

/// Acceleration of a place under one component a of the ground's: Σ w_n A_n + rest a, with A_n = a - y'' the absolute
/// acceleration of the mode's oscillator, y'' + 2 ζ ω y' + ω² y = a.
struct ModalShares {
    std::vector<double> of_mode; ///< w_n [-]
    double rest = 0.0;           ///< of what the modes leave, which moves with the ground [-]
};

/// Both components of a place under both of the ground's, named so: v_of_h is the vertical one of a horizontal motion.
struct PlaceShares {
    ModalShares h_of_h, v_of_h, h_of_v, v_of_v;
};

/// The dam above a joint while the joint is bonded.
struct TiedPart {
    std::vector<TiedMode> modes;
    PlaceShares joint; ///< mean over the joint: a_J = (a_h - u_x'', a_v + u_y'')
    PlaceShares mean;  ///< force through the joint over the mass above it
};

/// The motions of both places in equal parts of the ground's interval, linear in between; after the record the dam goes on
/// vibrating for `tail`.
struct JointMotions {
    GroundMotion joint, mean;
};
/// @param parts  of an interval, >= 1 @param tail  [s]
JointMotions joint_motions(const GroundMotion& ground, const TiedPart& part, int parts, double tail);

/// Slip of the block above the joint: under the joint's motion and under the mean of the part, the larger. Equal parts of an
/// interval of a twentieth of the shortest period, and of half that: the slip is that of the halves, slip_error what they change.
/// @param ground  no sequence
SlideResult slide_above(const GroundMotion& ground, const TiedPart& part, const SlipStages& stages,
                        const SlideOptions& options);

} // namespace damslip::sliding
