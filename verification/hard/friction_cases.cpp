#include "verification/hard/hard_scenes.hpp"

#include "fe2d/reduction/reduced_run.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <cmath>
#include <numbers>

namespace damslip::hard {

namespace {

using fe2d::test::sines;

HardResult one_percent_above()
{
    return against_rigid(with_friction_over(stiff_dam(0.7), 1.01), sines(0.3, 6.0));
}

HardResult one_percent_above_silent()
{
    return compared(fe_run(with_friction_over(soft_dam(0.7), 1.01), silence(60.0), 0), 0.0, 1e-12);
}

/// A run that ends before the earthquake: the friction it says would hold, against the rigid block's.
HardResult fails_statically(Scene scene, double share)
{
    const double needed = friction_that_holds(scene);
    scene.contact.friction = share * needed;
    const fe2d::RunResult run = fe_run(scene, sines(1.0, 1.0));
    HardResult result = compared(run, needed, 1e-9 * needed);
    result.value_a = run.stages.back().critical_friction;
    return result;
}

HardResult no_friction_dry()
{
    Scene scene = stiff_block(8.0, 1.0, 1e-6);
    const double period = 1.0, dt = 0.01;
    GroundMotion motion = silence(period, dt);
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k)
        motion.accel_h[k] = 2.0 * std::sin(2.0 * std::numbers::pi * static_cast<double>(k) * dt / period);
    // Friction of 1e-6 g acts for the second of motion and the one it needs to stop what it has made.
    return compared(fe_run(scene, motion), double_integral(motion), 1e-6 * 9.81 * period * period);
}

HardResult friction_of_three()
{
    Scene scene = soft_dam(3.0);
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = 1;
    const GroundMotion motion = sines(4.0, 6.0);
    const fe2d::EarthquakeRun full(scene, options);
    const fe2d::ReducedRun all_modes(full, scene, options, 100000);
    const fe2d::RunResult other = all_modes.run(motion);
    return compared(full.run(motion), other.slip, 1e-6 * other.max_slip);
}

} // namespace

void add_friction_cases(HardCases& cases)
{
    const std::string rigid = "event-located rigid block", fe = "FE, moduli x 1e4";
    const std::string step = "1 %: friction switches at step ends, 0.0025 s of slides of 0.25 s";
    cases.push_back({.id = "hard.friction.one-percent-above",
                     .why = "the thrust of the water nearly moves the dam: every stick hangs on 1 % of the friction",
                     .method_a = fe,
                     .method_b = rigid,
                     .tolerance = step,
                     .run = one_percent_above});
    cases.push_back(
        {.id = "hard.friction.one-percent-above-silent",
         .why = "pairs at heel and toe are at their strength all the time: 60 s without motion must not creep",
         .method_a = "FE",
         .method_b = "limit: no slip",
         .tolerance = "a sticking pair keeps its slip to the last bit",
         .run = one_percent_above_silent});
    cases.push_back({.id = "hard.friction.one-percent-below",
                     .why = "no equilibrium exists: the static solver must say so, not iterate",
                     .quantity = "friction that holds",
                     .unit = "-",
                     .method_a = "FE stages",
                     .method_b = "rigid block",
                     .tolerance = "1e-9: both sum the same loads",
                     .expected_status = "static failure",
                     .run = [] { return fails_statically(soft_dam(0.7), 0.99); }});
    cases.push_back({.id = "hard.friction.zero-with-water",
                     .why = "nothing resists the water",
                     .quantity = "friction that holds",
                     .unit = "-",
                     .method_a = "FE stages",
                     .method_b = "rigid block",
                     .tolerance = "1e-9: both sum the same loads",
                     .expected_status = "static failure",
                     .run = [] {
                         Scene scene = soft_dam(0.7);
                         scene.uplift.reset();
                         return fails_statically(scene, 1e-6);
                     }});
    cases.push_back({.id = "hard.friction.zero-dry",
                     .why = "every pair slips in every step, the tangential operator is singular but for inertia",
                     .method_a = "FE, mu = 1e-6",
                     .method_b = "limit: the block stays where it is, slip = double integral of a_h",
                     .tolerance = "mu g T^2: what the friction left moves in the motion's 1 s",
                     .run = no_friction_dry});
    cases.push_back(
        {.id = "hard.friction.three",
         .why = "the dam rocks instead of sliding; shear of 3 N' couples the pairs more than their pressures do",
         .method_a = "FE",
         .method_b = "FE in all modes of the dam (other unknowns, operators and factor)",
         .tolerance = "1e-6 of the largest slip: round-off of 600 steps with landings",
         .run = friction_of_three});
}

} // namespace damslip::hard
