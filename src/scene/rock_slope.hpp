#pragma once

#include "core/geometry.hpp"

/// A rock slope whose block slides on one plane that comes out in the face, cut off at the back by a vertical tension
/// crack. Hoek & Bray (1981), Rock Slope Engineering, ch. 7.
namespace damslip {

struct RockSlope {
    double height = 0.0;         ///< H, of the crest above the line where the plane comes out in the face [m]
    double face_dip = 0.0;       ///< psi_f [rad]
    double plane_dip = 0.0;      ///< psi_p [rad], below psi_f
    double crack_distance = 0.0; ///< b, of the crack behind the crest, horizontally [m]; negative: crack in the face
    double upper_dip = 0.0;      ///< psi_s of the surface behind the crest [rad], positive: falls towards the crest
};

/// Depth z of the crack, from the surface down to the plane [m]. Zero or less: the plane has reached the surface before.
double crack_depth(const RockSlope& slope);

/// The block as a section: the foot of the crack is the heel at (0, 0), the plane is the base, the face is the
/// downstream face. Counter-clockwise: heel, toe, crest (where the crack is behind it), top of the crack.
Polyline sliding_block(const RockSlope& slope);

} // namespace damslip
