#pragma once

#include "records/record.hpp"
#include "scene/scene.hpp"
#include "sliding/block/slide.hpp"

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

// Sliding of a block with one mode of its own.
//
// The mode deforms horizontally by psi(y) q. With x = q M_1/L, c = cos(theta) and the slip s along the base
//
//     x'' + 2 zeta omega x' + omega^2 x = a_h - c s''            (a_h positive upstream drives the block downstream)
//     k = a_h - Gamma x''                                        what drives the base; the mass accelerates by k - c s''
//     s'' = f (k - a_y) sliding downstream, -s'' = f (-k - a_y^-) upstream, s'' = 0 at rest,
//
// f and a_y as in Yield; Gamma, zeta, omega: FlexibleBlock. Chopra & Zhang (1991), J. Struct. Eng. 117; Rathje & Bray
// (1999), Earthquake Eng. Struct. Dyn. 28; (2000), J. Geotech. Geoenviron. Eng. 126. One mode with zeta of a base that
// does not slide; the vertical motion is that of the ground and changes the yields only.

struct FlexibleSlide {
    SlideResult slide;                   ///< slip of the base
    double peak_acceleration = 0.0;      ///< of the mass on average, largest |k - c s''| [m/s^2]
    std::vector<double> deflection;      ///< x with the history, coupled only [m]
    std::vector<double> deflection_rate; ///< x' [m/s]
};

/// Decoupled: the response without slip, then the rigid block under its average acceleration k, taken in closed form and
/// located like the events of slide(), with everything that slide() follows: exact but for 1e-6 of k where the block starts
/// and stops. options.sliding.scheme is that of slide() alone: it is not used here. More or less than coupled
/// (docs/neighbours.md). Run-out: until the block rests and what is left of the vibration cannot move it, at most
/// run_out_max.
/// @throws InputError as slide() and check_flexible
FlexibleSlide slide_decoupled(const GroundMotion& motion, const SlipStages& stages, const FlexibleBlock& flexible,
                              const SlideOptions& options = {});

/// Coupled: slip and vibration at the same time. Both are followed in closed form between events; the block is looked at
/// T_s sqrt(1 - Gamma c f)/40 apart (no more than 1000 times to a sample), and starts, stops and strength stages that are seen are located to the last digits.
/// The lift-off options are not used: the block stays on its base. Run-out: until the block rests and what is left of
/// the vibration cannot move it, at most run_out_max. options.sliding.scheme is not used. Friction linear in slip is cut
/// into 100 steps per stage, each with its mean.
/// @throws InputError as slide() and check_flexible
FlexibleSlide slide_coupled(const GroundMotion& motion, const SlipStages& stages, const FlexibleBlock& flexible,
                            const SlideOptions& options = {});

/// @throws InputError for a period <= 0, damping outside 0 ... 0.5, a mass ratio outside 0 ... 0.95, and a block whose
/// friction on a steep base makes 1 - Gamma c f <= 0: it jams.
void check_flexible(const FlexibleBlock& flexible, const SlipStages& stages);

/// A block that rests at the end of its run-out while the vibration can still move it: its slip is a lower bound.
void note_vibration(const SlideOptions& options, SlideResult& result);

} // namespace damslip::sliding
