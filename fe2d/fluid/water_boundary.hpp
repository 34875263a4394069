#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace damslip::fe2d {

/// Layers that stand for the water beyond the far end (absorbing_end.hpp).
struct AbsorbingLayers {
    std::vector<double> cosines = {1.0, 0.72, 0.4,
                                   0.16};    ///< cos θ of waves that leave without reflection, in 0 ... 1 [-]
    std::vector<double> decays = {0.7, 1.6}; ///< decay rate times depth of the fields that do [-], > 0
};

/// The water and its boundaries, apart from the shape.
struct FluidOptions {
    double density = 1000.0;        ///< ρ [kg/m^3]
    double bulk_modulus = 2200e6;   ///< K_w [Pa]
    double gravity = 9.81;          ///< of a sloshing surface [m/s^2]
    double bottom_reflection = 1.0; ///< α [-], -1 ... 1
    WaterSurface surface = WaterSurface::free;
    FarEnd far_end = FarEnd::absorbing;
    BottomMotion bottom_motion = BottomMotion::still;
    AbsorbingLayers layers = {};
    bool floor_on_rock =
        false; ///< the floor of the mesh is the rock's (FluidModel::floor); α is then of the bottom beyond the
               ///< far end alone

    double sound_speed() const; ///< c = √(K_w/ρ) [m/s]
};

/// Of a scene with a reservoir.
FluidOptions fluid_options(const Scene& scene);

/// Velocity into a boundary per pressure on it, (1/ρc)(1-α)/(1+α) [m/(Pa s)] for the wave reflection coefficient α
/// (Hall & Chopra 1982; Goldgruber 2015, (3-54)...(3-58)). Infinite for α = -1, where p = 0.
double wave_admittance(double density, double sound_speed, double reflection);

/// α = (Z - ρc)/(Z + ρc), Z = √(E_r ρ_r): normal incidence on a half-space of density ρ_r and modulus E_r (3-55).
double reflection_of_bottom(double density, double sound_speed, double bottom_density, double bottom_modulus);

} // namespace damslip::fe2d
