#pragma once

#include "fe2d/contact/joint_water.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/run/contact_motion.hpp"
#include "fe2d/run/contact_planes.hpp"

/// Water under the dam that follows the opening of the base, or loses its drains.
namespace damslip::fe2d {

/// The law of uplift.opening and drains.lost_at_slip; null: the water does not follow, and nothing asks for the crack afterwards.
/// @param uplift  before the earthquake @param cracked  the same with cracks
std::unique_ptr<CrackWater> base_water(const Scene& scene, const Plane& base, const PressureProfile& uplift,
                                       const CrackedUplift& cracked, const std::optional<DrainLoss>& drain_loss);

/// Pressure of the reservoir's waves at the heel, beyond that of the water at rest [Pa].
class HeelWaves {
public:
    /// @param water  acoustic; null: the added mass speaks for it @param added_mass  of the face; empty: none
    HeelWaves(const Scene& scene, const ContactStructure& structure, const WaterBody* water,
              const std::function<double(Point, double face_angle)>& added_mass);
    double pressure(const DynamicState& state) const;

private:
    Eigen::Index potential_ = -1;           ///< unknown of the water at the heel
    double scale_ = 0.0;                    ///< of its rate: p = scale φ̇ [Pa s/m]
    Eigen::Index heel_ = -1;                ///< first unknown of the dam's heel
    double mass_ = 0.0;                     ///< added mass of the face at the heel [kg/m²]
    Eigen::Vector2d into_water_{-1.0, 0.0}; ///< normal of the face
};

} // namespace damslip::fe2d
