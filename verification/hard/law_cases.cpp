#include "verification/hard/hard_scenes.hpp"

#include "analysis/prepare/ready.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/exact/two_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace damslip::hard {

namespace {

using fe2d::test::sines;

double interpolated(const std::vector<double>& samples, double place)
{
    const auto k = static_cast<std::size_t>(place);
    if (k + 1 >= samples.size()) return 0.0;
    return samples[k] + (place - static_cast<double>(k)) * (samples[k + 1] - samples[k]);
}

/// Plastic slip of a rigid block of mass m on a spring k (per length) in front of Coulomb's law, a_v = 0:
/// x'' = a_h - r, r = k (x - s) bounded by mu g, in tiny steps by velocity first (symplectic Euler).
double slip_behind_spring(const GroundMotion& motion, double spring_over_mass, double yield, double seconds_after)
{
    const double dt = std::min(2e-5, 0.05 / std::sqrt(spring_over_mass));
    const double end = motion.dt * static_cast<double>(motion.accel_h.size() - 1) + seconds_after;
    double x = 0.0, rate = 0.0, slip = 0.0;
    for (double t = 0.5 * dt; t < end; t += dt) {
        const double resisting = spring_over_mass * (x - slip);
        rate += dt * (interpolated(motion.accel_h, t / motion.dt) - resisting);
        x += dt * rate;
        const double most = yield / spring_over_mass;
        slip = std::clamp(slip, x - most, x + most);
    }
    return slip;
}

HardResult penalty(double stiffness)
{
    const double base = 8.0, height = 1.0, friction = 0.2, density = 2400.0;
    Scene scene = stiff_block(base, height, friction);
    scene.contact.enforcement = ContactEnforcement::penalty;
    scene.contact.tangential_stiffness = stiffness;
    GroundMotion motion = sines(4.0, 4.0);
    motion.accel_v.clear();
    const double expected = slip_behind_spring(motion, stiffness / (density * height), friction * scene.gravity, 5.0);
    return compared(fe_run(scene, motion, 5), expected, 0.01 * std::abs(expected));
}

/// Slips of 5 m on flexible rock: nodes face others than those they started on.
HardResult five_metres()
{
    Scene scene = soft_dam(0.7), finite = scene;
    finite.contact.sliding = JointPath::finite;
    finite.contact.max_slip = 8.0;
    const GroundMotion motion = push(1.5, 1.2, 12.0, 0.5);
    const fe2d::RunResult small = fe_run(scene, motion, 1);
    HardResult result = compared(fe_run(finite, motion, 1), small, 1e-3 * small.slip);
    if (small.slip < 4.0) result.status = fmt::format("slip of {:.2f} m only", small.slip);
    return result;
}

HardResult one_mode()
{
    Scene given = soft_dam(0.7);
    given.time.substeps = 1;
    const Watch nobody;
    const Ready ready = prepare(given, Method::finite_elements, nullptr);
    const Scene& scene = ready.scene;
    const fe2d::RunOptions options = ready.run_options(nobody);
    const GroundMotion motion = sines(1.0, 6.0);
    const fe2d::EarthquakeRun full(scene, options);
    const fe2d::RunResult reduced = fe2d::ReducedRun(full, scene, options, 1).run(motion);
    const fe2d::RunResult whole = full.run(motion);
    HardResult result = compared(whole, whole.slip, 3.0 * reduced.truncation_error);
    result.value_a = reduced.slip;
    result.complementarity = std::max(*result.complementarity, reduced.counts.largest_residual);
    result.status = word(reduced.status);
    if (reduced.modes != 1) result.status = fmt::format("{} modes", reduced.modes);
    return result;
}

/// The dam dry on a rigid base, cut at its neck; both planes slide, at times together.
HardResult two_planes(bool at_the_joint)
{
    Scene scene = stiff_dam(0.35);
    scene.foundation.reset();
    scene.curtain.reset();
    scene.reservoir.reset();
    scene.uplift.reset();
    scene.lift_joints.emplace_back();
    scene.lift_joints.back().elevation = 51.5;
    scene.lift_joints.back().strength.friction = 0.30;
    GroundMotion motion = sines(5.0, 8.0);
    for (std::size_t i = 0; i < motion.accel_h.size(); ++i)
        motion.accel_h[i] += 1.5 * std::sin(std::numbers::pi * static_cast<double>(i) / 800.0);
    const double upper = 2500.0 * 12.0 * 11.0, whole = 2500.0 * 1599.75;
    const exact::TwoSlips rigid = exact::two_blocks(motion, whole - upper, upper, 0.35, 0.30);
    const fe2d::RunResult run = fe_run(scene, motion, 3);
    const double expected = at_the_joint ? rigid.joint : rigid.base;
    HardResult result = compared(run, expected, 0.01 * std::abs(expected));
    if (at_the_joint) result.value_a = run.lifts.at(0).slip;
    return result;
}

} // namespace

void add_law_cases(HardCases& cases)
{
    for (const int power : {6, 8, 10, 12, 14})
        cases.push_back({.id = fmt::format("hard.law.penalty-1e{}", power),
                         .why = power < 10
                                    ? "a spring so soft that the block swings on it at the motion's own frequencies"
                                    : "a spring that the step does not resolve, beside the give of the block",
                         .method_a = fmt::format("FE, stiff block, {}e{} N/m3", 1, power),
                         .method_b = "rigid block behind a spring, steps of 0.05 of its period",
                         .tolerance = "1 %: slides end at step ends, 0.0003 s",
                         .run = [power] { return penalty(std::pow(10.0, power)); }});
    cases.push_back({.id = "hard.law.slip-of-five-metres",
                     .why = "ten elements of the rock pass below each node of the dam",
                     .method_a = "FE, finite sliding",
                     .method_b = "FE, small sliding",
                     .tolerance = "1e-3: the box ends 5 m of 150 m nearer, the curtain is 1 m thin",
                     .run = five_metres});
    for (const bool joint : {false, true})
        cases.push_back({.id = joint ? "hard.law.two-planes-joint" : "hard.law.two-planes-base",
                         .why = "base and lift joint slide at once, each carries what the other lets through",
                         .quantity = joint ? "slip of the joint" : "slip of the base",
                         .method_a = "FE, moduli x 1e4, rigid base",
                         .method_b = "two rigid blocks by impulses",
                         .tolerance = "1 %: slides end at step ends, 0.00125 s",
                         .run = [joint] { return two_planes(joint); }});
    cases.push_back({.id = "hard.law.one-mode",
                     .why = "one elastic mode of the dam, all others are left as flexibility without inertia",
                     .method_a = "FE reduced to one mode",
                     .method_b = "FE in full",
                     .tolerance = "three times its own estimate of the error, the estimate's claim",
                     .run = one_mode});
}

} // namespace damslip::hard
