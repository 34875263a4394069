#pragma once

#include "fe2d/run/earthquake_run.hpp"
#include "sliding/block/slide.hpp"
#include "verification/hard/hard_case.hpp"

/// Scenes, motions and runs the hard cases share. Runs take what the program takes: what prepare() makes ready.
namespace damslip::hard {

/// The reference dam with all moduli times 1e4 and pairs 5 m apart: it slides as the rigid block.
Scene stiff_dam(double friction);
/// The reference dam as it is, pairs 5 m apart, elements of 8 m.
Scene soft_dam(double friction);
/// A block on a rigid plane, dry, so stiff that only contact moves. [m]
Scene stiff_block(double base, double height, double friction);

/// Slides end within a step of where they should (first order): at this many halvings of 0.01 s, 0.0025 s, that is 1 %
/// of slides of a quarter of a second.
inline constexpr int fine = 2;
inline constexpr double fine_share = 0.01;

/// @param halvings  of the step; none: chosen by the accuracy wanted
fe2d::RunResult fe_run(Scene scene, const GroundMotion& motion, std::optional<int> halvings = fine);
sliding::SlideResult rigid_run(const Scene& scene, const GroundMotion& motion);
double friction_that_holds(const Scene& scene);       ///< statically, by the rigid block [-]
Scene with_friction_over(Scene scene, double factor); ///< friction: `factor` times that which holds

/// Status, complementarity and energy closure of a run; value_a is its slip.
HardResult result_of(const fe2d::RunResult& run);
/// The run against another value of its slip. @param tolerance [m]
HardResult compared(const fe2d::RunResult& run, double value_b, double tolerance);
/// The worse of both in complementarity and energy closure.
HardResult compared(const fe2d::RunResult& run, const fe2d::RunResult& other, double tolerance);

/// FE with steps of 0.0025 s against the event-located rigid block, `share` of its slip apart.
HardResult against_rigid(const Scene& scene, const GroundMotion& motion, double share = fine_share);

GroundMotion silence(double duration, double dt = 0.01);
/// a_h = `acceleration` from `start` for `seconds`, then still ground [s].
GroundMotion push(double acceleration, double seconds, double duration, double start = 0.0, double dt = 0.01);
GroundMotion scaled(GroundMotion motion, double factor);
/// Ground displacement against which the dam is pushed at the end: the double integral of a_h [m].
double double_integral(const GroundMotion& motion);

} // namespace damslip::hard
