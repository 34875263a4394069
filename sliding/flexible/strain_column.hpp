#pragma once

#include "records/record.hpp"
#include "sliding/flexible/flexible_block.hpp"

/// A uniform shear column on rock as the mode of a FlexibleBlock, and the mode it has once it is soft from its strain.
namespace damslip::sliding {

struct StrainColumn {
    double height = 0.0;        ///< H, > 0 [m]
    double velocity = 0.0;      ///< V_s at small strain, > 0 [m/s]
    double damping = 0.05;      ///< of its material at small strain, where the iteration begins [-]
    double base_velocity = 0.0; ///< V_s of the rock below: what it radiates is added to the damping; 0: nothing [m/s]
    double reference_strain = 0.0; ///< gamma_r at which the shear modulus is halved; 0: it stays as it is [-]
};

struct StrainCompatible {
    FlexibleBlock block;   ///< T_s = 4 H/V_s; damping of material and radiation together
    double velocity = 0.0; ///< V_s [m/s]
    double strain = 0.0;   ///< effective, 0.65 of the largest [-]
    int iterations = 0;    ///< 0: linear
    bool settled = true;   ///< else the last iteration
};

/// Equivalent-linear iteration, as SLAMMER 1.1 does it (Jibson, Rathje, Jibson & Lee 2013, USGS Techniques and Methods 12-B1),
/// with the vibration in closed form between samples:
///
///     gamma = 0.65 · 1.57 u_max/H, u_max = 4/pi x_max of the top,     V_s = V_0/sqrt(1 + gamma/gamma_r),
///     material damping 0.62 (1 + gamma/gamma_r)^-0.1 D_Masing + 0.01 (Darendeli 2001),
///     radiation 0.55016 (V_base/V_s)^-0.9904, at most 0.2,
///
/// until V_s^2 and the material damping change by less than `tolerance` of themselves.
/// @param mass_ratio  Gamma of the mode [-]
StrainCompatible strain_compatible(const StrainColumn& column, const GroundMotion& motion, double mass_ratio,
                                   double tolerance = 1e-4);

} // namespace damslip::sliding
