#include "verification/hard/hard_scenes.hpp"

#include "fe2d/run/ground_input.hpp"
#include "scene/section.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/cases/small_dam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::hard {

namespace {

/// a_v below -g, and above it by as much, `times` in a row with a second of rest each, pushed downstream in flight.
GroundMotion falls(double seconds, int times)
{
    GroundMotion motion = silence(times * (2.0 * seconds + 1.0) + 0.2);
    motion.accel_v = motion.accel_h;
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k) {
        const double t = std::fmod(static_cast<double>(k) * motion.dt, 2.0 * seconds + 1.0) - 0.2;
        if (t < 0.0 || t > 2.0 * seconds) continue;
        motion.accel_v[k] = -1.6 * 9.81 * std::sin(std::numbers::pi * t / seconds);
        motion.accel_h[k] = t < seconds ? 2.0 : 0.0;
    }
    return motion;
}

struct ImpulseRun {
    double slip = 0.0;     ///< mean, at the end [m]
    double rotation = 0.0; ///< largest, of the base [rad]
};

/// By velocities and impulses (Moreau 1988), steps of `dt`.
ImpulseRun by_impulses(const Scene& scene, const GroundMotion& motion, double duration, double dt)
{
    const verification::SmallDam dam(scene);
    const fe2d::GroundInput ground(motion, MassDamping::relative, 0.0);
    const Eigen::Index m = dam.pairs();
    verification::MoreauScheme scheme(dam.dense(), Eigen::VectorXd::Constant(m, dam.friction()), dt);
    scheme.start(dam.start(), dam.load({}));
    const double start = dam.weights().dot(scheme.gaps().tail(m));
    const auto steps = static_cast<int>(std::lround(duration / dt));
    ImpulseRun run;
    for (int n = 1; n <= steps; ++n) {
        scheme.advance(dam.load(ground.at(n * dt)));
        run.rotation = std::max(run.rotation, fe2d::base_rotation(dam.plane(), scheme.gaps().head(m)));
    }
    run.slip = dam.weights().dot(scheme.gaps().tail(m)) - start;
    return run;
}

/// The small dam's concrete and rock under another section, dry.
Scene small_body(Polyline section)
{
    Scene scene = verification::small_dam_scene(verification::SmallDamBase::rock);
    scene.reservoir.reset();
    scene.section.polygon = std::move(section);
    return scene;
}

/// A body that leaves the ground as a whole.
HardResult flights(Polyline section, double seconds, int times)
{
    const Scene scene = small_body(std::move(section));
    const GroundMotion motion = falls(seconds, times);
    const fe2d::RunResult run = fe_run(scene, motion, 5);
    const double expected = by_impulses(scene, motion, run.end_time, motion.dt / 64).slip;
    HardResult result = compared(run, expected, 0.02 * std::abs(expected));
    const double most_open = *std::max_element(run.history.open_length.begin(), run.history.open_length.end());
    if (most_open < 0.999 * base_length(scene.section)) result.status = "never off the ground";
    return result;
}

/// The same of a block that does not give, on ground that does not give: plastic landings.
HardResult stiff_flights(double seconds, int times)
{
    Scene scene = stiff_block(8.0, 1.0, 0.4);
    scene.sliding.lift_off = LiftOff::ballistic;
    const GroundMotion motion = falls(seconds, times);
    const sliding::SlideResult rigid = rigid_run(scene, motion);
    HardResult result = compared(fe_run(scene, motion, 3), rigid.slip, 0.01 * std::abs(rigid.slip));
    if (rigid.lift_offs < times) result.status = "never off the ground";
    return result;
}

/// The stiff dam, dry and on stiff rock, pushed at the crest until only `share` of its base is shut.
HardResult open_base(double least_open, const double most_open, double force, double pga)
{
    Scene scene = stiff_dam(0.8);
    scene.reservoir.reset();
    scene.uplift.reset();
    scene.curtain.reset();
    scene.mesh.contact_size = 1.5;
    scene.forces.push_back({"push", {0.0, 62.5}, force, 0.0});
    scene = with_friction_over(scene, 1.02);
    const GroundMotion motion = fe2d::test::sines(pga, 6.0);
    const sliding::SlideResult rigid = rigid_run(scene, motion);
    const fe2d::RunResult run = fe_run(scene, motion);
    HardResult result = compared(run, rigid.slip, fine_share * std::abs(rigid.slip) + 1e-6);
    const double open = run.stages.back().open_length / base_length(scene.section);
    if (!(open >= least_open && open <= most_open)) result.status = "open: " + std::to_string(open) + " of the base";
    return result;
}

/// A slender body that rocks on its toe and falls back.
HardResult rocking()
{
    Scene scene = small_body({{0, 0}, {10, 0}, {10, 30}, {0, 30}});
    scene.contact.friction = 3.0;
    const GroundMotion motion = push(5.0, 0.3, 2.0, 0.1);
    const fe2d::RunResult run = fe_run(scene, motion, 5);
    const double expected = by_impulses(scene, motion, 2.0, motion.dt / 64).rotation;
    HardResult result = compared(run, expected, 0.01 * expected);
    result.value_a = *std::max_element(run.history.rocking.begin(), run.history.rocking.end());
    return result;
}

} // namespace

void add_opening_cases(HardCases& cases)
{
    const std::string rigid = "event-located rigid block";
    const std::string impulses = "velocities and impulses in dense matrices (Moreau 1988)";
    cases.push_back({.id = "hard.opening.above-one-g",
                     .why = "a_v below -g: the whole base opens, flies, and lands again",
                     .method_a = "FE, body of soft concrete on rock",
                     .method_b = impulses,
                     .tolerance = "2 %: the dense scheme is of first order, its last halving to 0.16 ms changes 1.4 %",
                     .run = [] { return flights(exact::triangle(30.0, 40.0), 0.2, 1); }});
    cases.push_back({.id = "hard.opening.flights",
                     .why = "full separation and re-contact, four times",
                     .method_a = "FE, body of soft concrete on rock",
                     .method_b = impulses,
                     .tolerance = "2 %: as above; here the halving changes 0.1 %",
                     .run = [] {
                         return flights({{0, 0}, {30, 0}, {30, 10}, {0, 10}}, 0.4, 4);
                     }});
    for (const int times : {1, 4})
        cases.push_back({.id = times == 1 ? "hard.opening.stiff-flight" : "hard.opening.stiff-flights",
                         .why = "a stiff body on a rigid plane lands with 1.4 m/s in one step, undamped",
                         .method_a = "FE, stiff block",
                         .method_b = "event-located rigid block with flight and plastic landing",
                         .tolerance = "1 %: lift-off and landing are known to a step of 0.00125 s of flights of 0.2 s",
                         .run = [times] { return stiff_flights(times == 1 ? 0.2 : 0.4, times); }});
    cases.push_back({.id = "hard.opening.half-base",
                     .why = "half of the base is open before the shaking starts, and the tip of the opening wanders",
                     .method_a = "FE, moduli x 1e4",
                     .method_b = rigid,
                     .tolerance = "1 %: slides end at step ends; friction does not care which pairs carry N'",
                     .run = [] { return open_base(0.4, 0.6, 13.0e6, 0.6); }});
    cases.push_back({.id = "hard.opening.toe-only",
                     .why = "a few pairs at the toe carry everything",
                     .method_a = "FE, moduli x 1e4",
                     .method_b = rigid,
                     .tolerance = "1 %: as above",
                     .run = [] { return open_base(0.85, 0.99, 17.1e6, 0.3); }});
    cases.push_back(
        {.id = "hard.opening.rocking",
         .why = "the block stands on one pair, then falls back on all",
         .quantity = "largest rotation",
         .unit = "rad",
         .method_a = "FE, slender body on rock",
         .method_b = impulses,
         .tolerance =
             "1 %: the concrete gives at the toe; energy to 1e-7: round-off of 3e12 Pa times rotations of 0.04",
         .energy_closure = 1e-7,
         .run = rocking});
}

} // namespace damslip::hard
