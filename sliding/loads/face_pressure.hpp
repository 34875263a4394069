#pragma once

#include "core/geometry.hpp"
#include "sliding/loads/force.hpp"

namespace damslip::sliding {

/// A distributed load in its horizontal and vertical part; each carries its own moment, so that stabilising and
/// overturning parts can be told apart.
struct FaceLoad {
    Force horizontal; ///< y = 0
    Force vertical;   ///< x = 0
    Force total() const { return horizontal + vertical; }
};

/// On which side of the face the dam lies when walking along it in the order of its points.
enum class DamSide {
    right, ///< upstream face, heel to crest
    left   ///< downstream face, toe to crest; crest, downstream end to upstream end
};

/// Resultant of the pressure p = unit_weight (level - y) on those parts of the face that lie below `level`: -p n with n
/// out of the dam, integrated exactly (p is linear along each straight piece, pieces are cut at the level). Water
/// stands on top of a piece that leans away from it (pushes down) and below an overhanging one (pushes up).
/// @param unit_weight  rho g [N/m^3]
/// @param level        of the surface [m]; a face entirely above it carries nothing
FaceLoad hydrostatic_load(const Polyline& face, DamSide side, double level, double unit_weight);

/// Horizontal earth-pressure thrust of sediment on the upstream face: K_s gamma' (level - y) on the vertical projection
/// of the face, 1/2 K_s gamma' h_s^2 on a face that reaches from the bottom to above the sediment, whatever its slope.
/// The weight of sediment resting on an inclined face is left out (safe side); give it as a point force where it is
/// wanted.
Force silt_thrust(const Polyline& upstream_face, double level, double submerged_unit_weight,
                  double pressure_coefficient);

} // namespace damslip::sliding
