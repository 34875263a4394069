#pragma once

#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/planes/seam.hpp"

#include <span>
#include <string>
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

// Horizontal joints of the dam, each judged as a sliding plane under all that stands above it.

/// The joint of an elevation: the [[lift_joint]] that is there, else the one that [lifts] makes, named "lift at 30 m".
LiftJoint lift_at(const Scene& scene, double elevation);

/// scene_above() a joint that [lifts] makes, with its water. @pre scene.lifts
Scene scene_above_made_lift(const Scene& scene, const LiftJoint& joint);

/// Ratio of the acceleration at a height to that of the ground, A(y), by lifts.amplification; `modes`: 1, it is no function of
/// the height alone [-].
double amplification_at(const Scene& scene, double elevation);

/// Joint of [lifts] or [[lift_joint]] in one ground state.
struct LiftState {
    double normal = 0.0, shear = 0.0; ///< N' and T [N/m]
    double factor = 0.0;              ///< peak strength [-]
    double factor_residual = 0.0;     ///< [-]
    double heel_stress = 0.0, toe_stress = 0.0; ///< effective, normal to the joint, compression positive [Pa]
    double upstream_face_stress = 0.0, downstream_face_stress = 0.0; ///< along the faces, σ sec²φ - p tan²φ [Pa]
    CrackedBase base;                                                ///< crack and uplift
};

struct LiftPlane {
    std::string name;
    double elevation = 0.0;        ///< [m]
    double length = 0.0;           ///< [m]
    LiftJoint joint;
    std::vector<LiftState> states; ///< in the order of the ground states
    double yield = 0.0;            ///< acceleration of the part above it [m/s^2], uniform
    double yield_of_ground = 0.0;  ///< acceleration of the ground at that yield: yield / mean_amplification [m/s^2]
    double mean_amplification = 1.0;  ///< Ā: of the part above, its mass and water as weights [-]
    double joint_amplification = 1.0; ///< A at the joint [-]
    SlipStages stages; ///< for slide() under the ground's motion times mean_amplification
    std::vector<AnchorBar> anchors; ///< through the joint
};

/// Peaks over the peak of the ground by the modes of the dam.
struct LiftAmplification {
    double joint = 1.0; ///< at the joint [-]
    double mean = 1.0;  ///< Ā of the part above: force through the joint [-]
    double arm = 1.0;   ///< of that force above the joint, over the arm in a dam that moves with the ground [-]
};

/// @param states  the first is the static one
/// @param modes  of each lift, for lifts.amplification = "modes"; empty: 1
std::vector<LiftPlane> lift_planes(const Scene& scene, const std::vector<GroundState>& states,
                                   std::span<const LiftAmplification> modes = {});

} // namespace damslip::sliding
