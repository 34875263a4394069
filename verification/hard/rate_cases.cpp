#include "verification/hard/hard_scenes.hpp"

#include "sliding/block/slide.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace damslip::hard {

namespace {

using fe2d::test::sines;

/// Friction that falls at once, v_c of a nanometre a second: that of rest starts the block, that of sliding stops it.
HardResult jump_of_friction()
{
    sliding::RigidBlock block;
    block.mass = 1.0;
    block.friction = 0.5;
    RateFriction rate;
    rate.kinetic_ratio = 0.6;
    rate.characteristic_rate = 1e-9;
    const GroundMotion motion = push(7.0, 0.4, 2.0, 0.2);
    sliding::RigidBlock sliding = block;
    sliding.friction *= rate.kinetic_ratio;
    const sliding::SlideResult result = slide(motion, sliding::SlipStages{{0.0, block, 0.0, rate}});
    const double expected = slide(motion, sliding::SlipStages{{0.0, block, 0.0}, {0.0, sliding, 0.0}}).slip;
    return {result.slip, expected, 1e-6 * expected, {}, {}, word(result.status)};
}

/// The same between elastic bodies, where friction must lag: by 0.1 s here.
HardResult jump_by_finite_elements()
{
    Scene scene = stiff_dam(0.80);
    scene.contact.rate.kinetic_ratio = 0.9;
    scene.contact.rate.characteristic_rate = 1e-4;
    scene.contact.rate.relaxation_time = 0.1;
    return against_rigid(scene, push(2.2, 0.6, 6.0, 0.5), 2.0 * fine_share);
}

/// A dry block on a rigid plane that the ground lets fall: what its landings lose is theirs.
Scene dropped_block(double restitution)
{
    Scene scene = stiff_block(8.0, 4.0, 0.5);
    scene.contact.restitution = restitution;
    scene.sliding.lift_off = LiftOff::ballistic;
    scene.sliding.run_out_max = 2.0;
    return scene;
}

GroundMotion drop(double duration)
{
    GroundMotion motion = silence(duration);
    motion.accel_v.assign(motion.accel_h.size(), 0.0);
    for (int i = 1; i < 11; ++i) motion.accel_v[i] = -24.0;
    return motion;
}

/// e = 1: it never rests, and no bounce may lose or win anything.
HardResult never_rests()
{
    const Scene scene = dropped_block(1.0);
    const sliding::SlideResult result = rigid_run(scene, drop(60.0));
    HardResult hard{result.impact_loss, 0.0, 1e-9 * result.max_gap * scene.gravity * 8.0 * 4.0 * 2400.0, {}, {},
                    word(result.status)};
    if (result.landings < 20) hard.status = fmt::format("{} landings only", result.landings);
    return hard;
}

/// Height of the second flight, e² of the first.
HardResult second_flight(double restitution)
{
    const GroundMotion motion = drop(4.0);
    const Scene scene = dropped_block(restitution);
    const double first = rigid_run(dropped_block(0.0), motion).max_gap;
    const fe2d::RunResult run = fe_run(scene, motion, 2);
    const std::vector<double>& opening = run.history.largest_opening;
    const auto off = std::find_if(opening.begin(), opening.end(), [&](double g) { return g > 0.5 * first; });
    auto touch = std::find_if(off, opening.end(), [&](double g) { return g < 0.1 * first; });
    while (touch != opening.end() && touch + 1 != opening.end() && *(touch + 1) < *touch) ++touch;
    const double second = touch == opening.end() ? first : *std::max_element(touch, opening.end());
    const double expected = restitution * restitution * first;
    HardResult result = compared(run, expected, 0.02 * expected + 0.002 * first);
    result.value_a = second;
    return result;
}

} // namespace

void add_rate_cases(HardCases& cases)
{
    cases.push_back({.id = "hard.rate.jump",
                     .why = "friction falls within a nanometre a second: forty doublings of the rate in a microsecond",
                     .method_a = "rigid block, v_c = 1e-9 m/s",
                     .method_b = "rigid block with the friction of sliding from its first movement on",
                     .tolerance = "1e-6: the fall itself takes nanoseconds",
                     .run = jump_of_friction});
    cases.push_back({.id = "hard.rate.jump-fe",
                     .why = "v_c far below any rate that a step can see; friction lags by 0.1 s",
                     .method_a = "FE, moduli x 1e4",
                     .method_b = "rigid block",
                     .tolerance = "2 %: slides end at step ends, and friction goes on by the rate at the step's end",
                     .run = jump_by_finite_elements});
    cases.push_back({.id = "hard.rate.rebound-elastic",
                     .why = "e = 1: a minute of bounces that must neither fade nor grow",
                     .quantity = "energy lost in landings",
                     .unit = "J/m",
                     .method_a = "rigid block",
                     .method_b = "none",
                     .tolerance = "1e-9 of the energy of the fall",
                     .expected_status = word(Status::sliding_at_end),
                     .run = never_rests});
    for (const double e : {0.0, 0.5})
        cases.push_back(
            {.id = fmt::format("hard.rate.rebound-fe-{:g}", e),
             .why = "the whole base lands at once on a rigid plane and leaves it again",
             .quantity = "height of the second flight",
             .method_a = "FE, stiff block",
             .method_b = "e² of the rigid block's first flight",
             .tolerance =
                 "2 %: landings within a step of 0.0025 s; 0.2 % of the first flight that the elastic block gives back",
             .run = [e] { return second_flight(e); }});
}

} // namespace damslip::hard
