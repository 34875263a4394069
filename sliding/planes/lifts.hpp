#pragma once

#include "sliding/equilibrium/base_state.hpp"
#include "sliding/planes/seam.hpp"

#include <string>
#include <vector>

/// Horizontal joints of the dam, each judged as a sliding plane under all that stands above it.
namespace damslip::sliding {

/// The joint of an elevation: the [[lift_joint]] that is there, else the one that [lifts] makes, named "lift at 30 m".
LiftJoint lift_at(const Scene& scene, double elevation);

/// scene_above() a joint that [lifts] makes, with its water. @pre scene.lifts
Scene scene_above_made_lift(const Scene& scene, const LiftJoint& joint);

/// Ratio of the acceleration at a height to that of the ground, A(y), by lifts.amplification; `modes`: 1, for the caller has
/// the modes [-].
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

/// @param states  the first is the static one
std::vector<LiftPlane> lift_planes(const Scene& scene, const std::vector<GroundState>& states);

} // namespace damslip::sliding
