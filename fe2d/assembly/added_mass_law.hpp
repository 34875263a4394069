#pragma once

#include "core/geometry.hpp"

#include <functional>

namespace damslip::fe2d {

/// Mass of water that moves with the face in its normal direction, per area of wet face [kg/m^2]; `face_angle` phi is
/// the inclination of the face from the vertical, positive where the body widens downwards [rad].
using AddedMassLaw = std::function<double(Point, double face_angle)>;

} // namespace damslip::fe2d
