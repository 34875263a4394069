#pragma once

#include "scene/scene.hpp"
#include "sliding/loads/added_mass.hpp"
#include "sliding/loads/static_loads.hpp"

#include <functional>
#include <optional>

namespace damslip::sliding {

/// The added mass of a whole upstream face, so that a rigid acceleration a of the dam meets the water force -M^w a.
/// n is the unit normal of the face (its sense does not matter), r the point [m], m_n as in added_mass_per_area.
struct AddedMassIntegral {
    double xx = 0.0, xy = 0.0,
           yy = 0.0;         ///< M^w = integral of m_n n n^T dS [kg/m]; vertical face: xx only; leaning away: xy < 0
    Point horizontal_moment; ///< integral of -y n_x m_n n dS [kg]: moment about the heel of the horizontal part of M^w
                             ///< a, per a
    Point vertical_moment;   ///< integral of  x n_y m_n n dS [kg]: of the vertical part
    /// Integral of m_n (n_x y - n_y x)^2 dS [kg m]: moment about the heel that resists a rotation about it, per angular
    /// acceleration.
    double rotation = 0.0;
    /// Height above the heel of the horizontal water force under a horizontal acceleration [m]; 0 without added mass.
    double acting_height() const { return xx > 0.0 ? -horizontal_moment.x / xx : 0.0; }
};

/// Integrated to 1e-13 relative (tanh-sinh rule in depth on every straight piece, which takes the root at the surface).
/// The upstream face only, between the reservoir bottom (the heel's level) and the surface or the crest; kinked faces
/// use each piece's own angle. The tailwater has no added mass: the theory has none there, its depth is small.
/// @param share  of the acceleration at a level y over that of the ground; null: the dam moves as one [-]
AddedMassIntegral integrate_added_mass(const AddedMass& method, const WaterColumn& water,
                                       const Polyline& upstream_face,
                                       const std::function<double(double)>& share = nullptr);

/// The scene's added mass with the water at `level` above the heel; all zero without a reservoir, for level <= 0 and
/// for reservoir.model = "hydrostatic".
AddedMassIntegral scene_added_mass(const Scene& scene, std::optional<double> level);

/// Water force on the dam that accelerates rigidly by (ax, ay) [m/s^2]: -M^w a.
FaceLoad hydrodynamic_force(const AddedMassIntegral& mass, double ax, double ay);

} // namespace damslip::sliding
