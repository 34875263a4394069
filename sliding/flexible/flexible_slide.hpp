#pragma once

#include "sliding/block/slide.hpp"
#include "sliding/flexible/flexible_mode.hpp"

/// Sliding of a block with one mode of its own.
///
/// The mode deforms horizontally by psi(y) q. With x = q M_1/L, c = cos(theta) and the slip s along the base
///
///     x'' + 2 zeta omega x' + omega^2 x = a_h - c s''            (a_h positive upstream drives the block downstream)
///     k = a_h - Gamma x''                                        what drives the base; the mass accelerates by k - c s''
///     s'' = f (k - a_y) sliding downstream, -s'' = f (-k - a_y^-) upstream, s'' = 0 at rest,
///
/// f and a_y as in Yield; Gamma, zeta, omega: FlexibleBlock. Chopra & Zhang (1991), J. Struct. Eng. 117; Rathje & Bray
/// (1999), Earthquake Eng. Struct. Dyn. 28; (2000), J. Geotech. Geoenviron. Eng. 126. One mode with zeta of a base that
/// does not slide; the vertical motion is that of the ground and changes the yields only.
namespace damslip::sliding {

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
