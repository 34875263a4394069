#pragma once

#include "sliding/equilibrium/base_state.hpp"
#include "sliding/planes/seam.hpp"

#include <span>
#include <string>
#include <vector>

/// Horizontal joints of the dam, each judged as a sliding plane under all that stands above it.
namespace damslip::sliding {

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
