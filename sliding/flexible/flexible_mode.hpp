#pragma once

#include "records/record.hpp"
#include "scene/scene.hpp"

#include <numbers>

namespace damslip::sliding {

/// One mode of a sliding mass that is not rigid.
struct FlexibleBlock {
    double period = 0.0;         ///< T_s, > 0, of the mode on a base that does not slide [s]
    double damping_ratio = 0.05; ///< zeta of the mode, 0 ... 0.5 [-]
    /// Gamma = L^2/(M M_1) with L = sum m psi, M_1 = sum m psi^2: effective mass of the mode over the sliding mass [-],
    /// > 0, <= 0.95. A uniform shear column, psi = sin(pi y/2H), has 8/pi^2 = 0.81.
    double mass_ratio = 8.0 / (std::numbers::pi * std::numbers::pi);
};

struct ModeState {
    double x = 0.0; ///< [m]
    double v = 0.0; ///< x' [m/s]
};

/// inertia x'' + 2 zeta omega x' + omega^2 x = p, p linear in time: followed in closed form, whatever the step.
class Oscillator {
public:
    /// @param omega  [rad/s], > 0 @param damping  zeta [-], >= 0 @param inertia  [-], > 0
    Oscillator(double omega, double damping, double inertia);

    /// State a time h later under p0 + p1 t. Under-, over- and critically damped alike.
    ModeState after(const ModeState& now, double p0, double p1, double h) const;

    /// omega^2 x + 2 zeta omega x': what spring and damper pull with [m/s^2].
    double restoring(const ModeState& s) const { return stiffness_ * s.x + damping_ * s.v; }

private:
    double stiffness_, damping_; ///< omega^2 [1/s^2], 2 zeta omega [1/s]
    double decay_;               ///< of the free motion [1/s]
    double square_;              ///< its circular frequency squared; negative: over-damped
    double free_stiffness_;      ///< stiffness over inertia [1/s^2]
};

/// L = sum m psi, M_1 = sum m psi^2 and the whole horizontal mass M, water included [kg/m].
struct ModalSums {
    double load = 0.0, mass = 0.0, total = 0.0;

    double mass_ratio() const { return load * load / (total * mass); } ///< Gamma [-]
};

/// Of the shape psi = (y/H)^n, y above the heel (0 below it), H of the crest: section, and the added mass of the water at the
/// scene's level. n -> 0 is a rigid mass, Gamma = 1.
ModalSums power_shape(const Scene& scene, double exponent);

// A uniform shear column on rock as the mode of a FlexibleBlock, and the mode it has once it is soft from its strain.

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
