// What takes energy out of a sliding run, and what must not: mass damping in its three forms, stiffness damping beside
// contact springs, wrong constants, impacts that give energy.
#include "verification/cases/fe_run_scenes.hpp"

#include "fe2d/time/linear_integrator.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::VectorXd;
using fe2d::test::sines;

constexpr double gravity = 9.81, density = 2400.0;

/// A block on a rigid plane, so stiff that only contact moves.
Scene stiff_block(double base, double height, double friction)
{
    Scene scene = exact::bare_scene({{0, 0}, {base, 0}, {base, height}, {0, height}}, density);
    scene.dam.young_modulus = 30e12;
    scene.dam.poisson_ratio = 0.0;
    scene.contact.friction = friction;
    scene.mesh.size = base / 6.0;
    scene.mesh.contact_size = base / 8.0;
    scene.damping.method = DampingMethod::none;
    return scene;
}

/// a_h = `peak` from one sample after the start on.
GroundMotion push(double peak, double duration)
{
    GroundMotion motion;
    motion.dt = 0.01;
    motion.accel_h.assign(static_cast<std::size_t>(std::lround(duration / motion.dt)) + 1, peak);
    motion.accel_h[0] = 0.0;
    return motion;
}

struct Motion {
    double slip, rate; ///< [m, m/s]
};

/// s and s' after t of s'' = (a_0 + a_1 t) - a_M s' from s = 0, s' = v.
Motion braked(double v, double a0, double a1, double a_m, double t)
{
    if (a_m == 0.0) return {v * t + a0 * t * t / 2 + a1 * t * t * t / 6, v + a0 * t + a1 * t * t / 2};
    // s' = p + q t + (v - p) e^(-a_M t)
    const double q = a1 / a_m, p = (a0 - q) / a_m, e = std::exp(-a_m * t);
    return {p * t + q * t * t / 2 + (v - p) * (1 - e) / a_m, p + q * t + (v - p) * e};
}

// A block pushed by the ground with A = 3 m/s² for 1 s, mu = 0.1, y = mu g, a_M = 2/s. Sliding starts in the first
// interval, where the acceleration grows by A/dt a second, and goes on to the end of the record:
// - damping of the deformation only does not brake: s'' = a_h - y;
// - of the relative velocity: s'' = a_h - y - a_M s', after the push alone s' would fall as e^(-a_M t);
// - of the total velocity: s'' = a_h - y - a_M (s' - V), V the integral of a_h: a block at rest in space is not damped.
// Steps of 0.625 ms: what is wrong in the one where sliding starts is y² dt / A of the speed's 2 m/s, below 1e-3.
TEST(FeRunDissipation, mass_damping_of_a_sliding_block)
{
    const double push_size = 3.0, y = 0.1 * gravity, a_m = 2.0, dt = 0.01, end = 1.0;
    Scene scene = stiff_block(8.0, 1.0, 0.1);
    scene.sliding.run_out_max = 0.1;
    const double slope = push_size / dt, start = y / slope; // of sliding, by the relative demand alone
    const double ramp = dt - start, rest = end - dt;
    const auto expected = [&](MassDamping mass) {
        const double factor = mass == MassDamping::deformation_only ? 0.0 : a_m;
        // a_M V: the ground's speed A t²/(2 dt) in the ramp moves the start by a_M dt/2 of it, 1 % of 3 ms: neglected.
        const bool total = mass == MassDamping::total;
        const Motion first = braked(0.0, 0.0, slope, factor, ramp);
        const double ground_speed = push_size * dt / 2.0;
        const Motion then = braked(first.rate, push_size - y + (total ? a_m * ground_speed : 0.0),
                                   total ? a_m * push_size : 0.0, factor, rest);
        return first.slip + then.slip;
    };
    double slip[3];
    for (const MassDamping mass : {MassDamping::total, MassDamping::relative, MassDamping::deformation_only}) {
        scene.damping.mass = mass;
        RunOptions options;
        options.damping = RayleighConstants{a_m, 0.0};
        scene.time.substeps = 4;
        const RunResult result = EarthquakeRun(scene, options).run(push(push_size, end));
        slip[static_cast<int>(mass)] = result.history.slip[100];
        EXPECT_NEAR(result.history.slip[100], expected(mass), 1e-3 * expected(mass)) << static_cast<int>(mass);
        EXPECT_LT(result.energy_error, 1e-9);
    }
    // The three differ by far more than the tolerance: 1.22, 0.57 and 1.0 m.
    EXPECT_LT(slip[static_cast<int>(MassDamping::relative)],
              0.6 * slip[static_cast<int>(MassDamping::deformation_only)]);
    EXPECT_GT(slip[static_cast<int>(MassDamping::total)], 1.2 * slip[static_cast<int>(MassDamping::relative)]);
}

// A block of mass m on a sticking penalty k under a sudden push below its strength is an oscillator without damping:
// x = (A/w²)(1 - cos w t), w² = k B/m, whatever b_K, which belongs to the block. Were the contact's springs in C, b_K =
// 0.01 s would damp by b_K w/2 = 22 % and ten swings would leave e^-14 of it. Average acceleration, w dt = 0.014: phase
// error (w dt)²/12 = 2e-5 of 60 rad.
TEST(FeRunDissipation, stiffness_damping_does_not_act_on_contact_springs)
{
    const double base = 8.0, height = 1.0, stiffness = 5e6, peak = 0.5;
    const double omega = std::sqrt(stiffness / (density * height));
    Scene scene = stiff_block(base, height, 0.7);
    scene.sliding.run_out_max = 0.1;
    scene.time.alpha = 0.0;
    for (const double b_k : {0.0, 0.001, 0.01}) {
        RunOptions options;
        options.damping = RayleighConstants{0.0, b_k};
        scene.contact.enforcement = ContactEnforcement::penalty;
        scene.contact.tangential_stiffness = stiffness;
        scene.time.substeps = 5;
        const RunResult result = EarthquakeRun(scene, options).run(push(peak, 20.0 * std::numbers::pi / omega));
        const RunHistory& h = result.history;
        double largest = 0.0;
        for (std::size_t k = 1; k < h.time.size() && h.time[k] < 20.0 * std::numbers::pi / omega - 0.02; ++k) {
            // The push grows over one sample: a sudden one half a sample late, to (w dt)²/24 = 1 %.
            const double x = peak / (omega * omega) * (1.0 - std::cos(omega * (h.time[k] - 0.005)));
            largest = std::max(largest, std::abs(h.crest_x[k] - x));
        }
        EXPECT_LT(largest, 0.02 * peak / (omega * omega)) << "b_K " << b_k;
        EXPECT_EQ(result.max_slip, 0.0);
    }
}

/// State of a run on a rigid base as the ledger of the linear integrator wants it.
State ledger_state(const DynamicContact& run, const RunDamping& damping, const SplitLoad& load, const State* before)
{
    const ContactStructure& s = run.structure();
    const DynamicState& now = run.state();
    State state;
    state.displacement = now.u;
    state.velocity = now.v;
    state.acceleration = now.a;
    state.load = load.dam + now.ground.h * s.inertia_x() - now.ground.v * s.inertia_y();
    state.interface_force = VectorXd::Zero(now.u.size());
    state.interface_force.tail(2 * s.plane().pairs()) = s.plane().to_interface(now.contact.force);
    state.stiffness_force = s.stiffness() * now.u;
    state.momentum = s.mass() * now.v;
    state.inertia_force = s.mass() * now.a;
    state.damping_force =
        damping.constants.mass * (s.dam_mass() * now.v) + damping.constants.stiffness * (s.stiffness() * now.v);
    state.unbalanced = state.damping_force + state.stiffness_force - state.load - state.interface_force;
    state.unbalanced_before = before ? before->unbalanced : state.unbalanced;
    return state;
}

/// Imbalance over the largest energy of a second ledger, which is told that the steps were made with `told`.
double imbalance(const Scheme& scheme, const Scheme& told)
{
    Scene scene = fe2d::test::sliding_dam(0.70, 1.0, 5.0);
    scene.foundation.reset();
    scene.curtain.reset();
    RunOptions options = fe2d::test::options_of(scene);
    options.damping = RayleighConstants{1.9, 0.0006};
    const EarthquakeRun run(scene, options);
    const ContactStructure& structure = run.structure();
    const Eigen::Index m = structure.plane().pairs();
    StaticContact statics(structure);
    Strength strength(scene.contact, structure.plane());
    ContactMemory memory(m);
    run.statics(statics, strength, memory);
    const SplitLoad load = structure.split(load_stages(scene, run.model(), options.uplift).last());
    const RunDamping damping{run.damping(), MassDamping::relative};
    ContactOptions plain;
    plain.landing = Landing::ringing; // the ledger knows no landings
    DynamicContact dynamics(structure, damping, scheme, load, statics.displacements(load, memory), memory, {}, plain);

    State before = ledger_state(dynamics, damping, load, nullptr);
    EnergyLedger ledger(before);
    const GroundMotion motion = sines(2.0, 3.0);
    VectorXd slip = memory.slip, opening = memory.opening, force = memory.force;
    for (std::size_t k = 1; k < motion.accel_h.size(); ++k) {
        dynamics.advance(motion.dt, {motion.accel_h[k], motion.accel_v[k]}, strength.law());
        const State after = ledger_state(dynamics, damping, load, &before);
        const ContactMemory& c = dynamics.state().contact;
        const VectorXd mean = 0.5 * (force + c.force);
        ledger.add_step(
            before, after, step_constants(told, motion.dt),
            {.friction = -mean.tail(m).dot(c.slip - slip), .normal = mean.head(m).dot(c.opening - opening)});
        slip = c.slip;
        opening = c.opening;
        force = c.force;
        before = after;
    }
    EXPECT_GT(ledger.energy().friction, 1e4);
    return std::abs(ledger.imbalance()) / ledger.largest_scale();
}

// A ledger of its own over the states of a sliding run closes to round-off of 300 steps. Steps made with a constant 1 %
// off, which the ledger does not know of, open it by four orders of magnitude at least.
TEST(FeRunDissipation, a_wrong_constant_opens_the_ledger_of_a_sliding_run)
{
    const Scheme right = hht(-0.1);
    const double closed = imbalance(right, right);
    EXPECT_LT(closed, 1e-11);
    for (double Scheme::*constant : {&Scheme::alpha, &Scheme::gamma, &Scheme::beta}) {
        Scheme wrong = right;
        wrong.*constant *= 1.01;
        const double open = imbalance(wrong, right);
        EXPECT_GT(open, 1e-7);
        EXPECT_GT(open, 1e4 * closed);
    }
}

// An undamped, nearly rigid block thrown up and down at 2 g by steps far longer than its periods, without numerical
// damping: impacts at step ends give it energy. The run says so and stops; what it has done is kept.
TEST(FeRunDissipation, impacts_that_give_energy_are_a_status)
{
    Scene scene = stiff_block(8.0, 8.0, 0.7);
    scene.time.alpha = 0.0;
    RunOptions options;
    scene.time.substeps = 0;
    GroundMotion motion = sines(15.0, 6.0);
    for (double& a : motion.accel_v) a *= 1.5;
    const RunResult result = EarthquakeRun(scene, options).run(motion);
    ASSERT_EQ(result.status, Status::diverged) << text_of(result.notes);
    EXPECT_GT(result.end_time, 0.5); // not before it was thrown up
    EXPECT_LT(result.end_time, 6.0);
    ASSERT_FALSE(result.history.time.empty());
    EXPECT_DOUBLE_EQ(result.history.time.back(), result.end_time);
    EXPECT_EQ(result.history.slip.size(), result.history.time.size());
    EXPECT_EQ(result.slip, result.history.slip.back());
    const double given = result.history.energy.back().contact_normal;
    EXPECT_GT(given, 10.0);
    EXPECT_NE(text_of(result.notes).find(fmt::format("Stopped at {:.2f} s", result.end_time)), std::string::npos)
        << text_of(result.notes);
    EXPECT_NE(text_of(result.notes).find(fmt::format("{:.3g} J/m", given)), std::string::npos) << text_of(result.notes);
    EXPECT_NE(text_of(result.notes).find("smaller step"), std::string::npos) << text_of(result.notes);
}

// Linear acceleration with steps many times longer than it is stable for, on a joint that cannot open: the scheme itself
// makes the energy.
TEST(FeRunDissipation, a_scheme_that_gives_energy_is_a_status)
{
    Scene scene = stiff_block(8.0, 8.0, 0.7);
    scene.contact.separation = JointOpening::none;
    scene.damping.method = DampingMethod::none;
    scene.time.scheme = TimeScheme::newmark;
    scene.time.beta = 1.0 / 6.0;
    RunOptions options;
    scene.time.substeps = 0;
    const GroundMotion motion = sines(4.0, 2.0);
    const RunResult result = EarthquakeRun(scene, options).run(motion);
    ASSERT_EQ(result.status, Status::diverged) << text_of(result.notes);
    EXPECT_LT(result.end_time, 1.0);
    EXPECT_LT(result.history.energy.back().numerical, -10.0);
    EXPECT_NE(text_of(result.notes).find("the time scheme has put"), std::string::npos) << text_of(result.notes);
}

} // namespace
