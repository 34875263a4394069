#pragma once

#include "fe2d/model/model.hpp"

namespace damslip::fe2d {

/// Pressure in a lift joint [Pa] over the distance from the upstream face [m]: the hydrostatic head of the reservoir at
/// the upstream face, linear to that of the tailwater at the downstream face; nothing at a dry face. Empty where the
/// joint has no water or both faces are dry.
/// @param length  of the joint [m]
PressureProfile lift_water_profile(const Scene& scene, const LiftJoint& joint, double length);

/// The water of all lift joints on both their faces, open or not [N/m]; empty where there is none.
/// @param model  of the same scene
Eigen::VectorXd lift_water(const Scene& scene, const Model& model);

} // namespace damslip::fe2d
