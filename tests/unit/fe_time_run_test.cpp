// Earthquake runs of a dam tied to its base.
#include "core/input_error.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/time/integrate.hpp"
#include "fe_scenes.hpp"
#include "verification/exact/oscillator.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace damslip;
using Eigen::VectorXd;
using std::numbers::pi;

/// A small model of the reference dam: 6 m elements.
fe2d::Model small_model(Scene scene)
{
    scene.mesh.size = 6.0;
    scene.mesh.contact_size = 5.0;
    fe2d::ModelOptions options;
    if (scene.reservoir)
        options.added_mass = [](Point p, double) {
            return 0.875 * 1000.0 * std::sqrt(62.5 * std::max(0.0, 62.5 - p.y));
        };
    return fe2d::build_model(scene, options);
}

/// Pulses that start at zero, uneven in both components.
GroundMotion pulses(double dt, int samples, bool vertical = true)
{
    GroundMotion motion;
    motion.dt = dt;
    for (int k = 0; k < samples; ++k) {
        const double t = k * dt;
        motion.accel_h.push_back(2.0 * std::sin(2.0 * pi * 2.5 * t) * std::sin(pi * t / (dt * samples)));
        if (vertical) motion.accel_v.push_back(1.1 * std::sin(2.0 * pi * 4.0 * t) * std::sin(pi * t / (dt * samples)));
    }
    return motion;
}

fe2d::TiedRunOptions options_of(const Scene& scene, const fe2d::Model& model, const GroundMotion& motion)
{
    const auto loads = fe2d::static_loads(scene, model);
    fe2d::TiedRunOptions options;
    options.damping = fe2d::damping_of(scene, model, motion);
    options.static_load =
        fe2d::sum_of(loads.gravity, model.dofs.count) + fe2d::sum_of(loads.impounding, model.dofs.count);
    for (const auto& list : {loads.gravity, loads.impounding})
        for (const auto& load : list) options.static_resultant += load.resultant;
    return options;
}

Scene full_dam_on_rock()
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.reservoir = Reservoir{.level = 62.5};
    return scene;
}

TEST(FeTimeRun, default_scheme_is_hht_with_a_twentieth)
{
    const fe2d::Scheme scheme = fe2d::TiedRunOptions{}.scheme, expected = fe2d::hht(-0.05);
    EXPECT_DOUBLE_EQ(scheme.alpha, expected.alpha);
    EXPECT_DOUBLE_EQ(scheme.gamma, expected.gamma);
    EXPECT_DOUBLE_EQ(scheme.beta, expected.beta);
}

// Without ground motion the static state stays: drift of the crest over 20 s below round-off of a 1 cm displacement.
TEST(FeTimeRun, zero_record_keeps_the_static_state)
{
    const Scene scene = full_dam_on_rock();
    const fe2d::Model model = small_model(scene);
    GroundMotion still;
    still.dt = 0.01;
    still.accel_h.assign(2001, 0.0);
    const auto history = fe2d::integrate(model, still, options_of(scene, model, still));
    ASSERT_EQ(history.status, fe2d::TiedRunStatus::complete) << text_of(history.ending);
    EXPECT_EQ(history.steps, 2000);
    EXPECT_LT(history.peak_crest_x, 1e-13);
    EXPECT_GT(std::abs(history.rows[0].crest_x), 1e-4);
    EXPECT_LT(history.largest_imbalance, 1e-12);
    // Thrust ½ρgh² and the weight.
    EXPECT_NEAR(history.rows.back().base_shear, 0.5 * 9810.0 * 62.5 * 62.5, 1e-6 * history.rows.back().base_shear);
    EXPECT_NEAR(history.rows.back().base_normal, 1599.75 * 2500.0 * 9.81, 1e-6 * history.rows.back().base_normal);
}

// Rock condensed or whole: the same history to 1e-12 of its peaks (round-off of two different factorisations, a few hundred
// steps), displacements inside the rock included.
TEST(FeTimeRun, condensed_rock_gives_the_run_of_the_whole_rock)
{
    const Scene scene = full_dam_on_rock();
    const fe2d::Model model = small_model(scene);
    const GroundMotion motion = pulses(0.01, 301);
    fe2d::TiedRunOptions options = options_of(scene, model, motion);
    const auto condensed = fe2d::integrate(model, motion, options);
    options.rock = fe2d::RockTreatment::whole;
    const auto whole = fe2d::integrate(model, motion, options);
    ASSERT_EQ(condensed.rows.size(), whole.rows.size());
    EXPECT_LT(condensed.unknowns, whole.unknowns);
    for (std::size_t k = 0; k < whole.rows.size(); ++k) {
        ASSERT_NEAR(condensed.rows[k].crest_x, whole.rows[k].crest_x, 1e-12 * std::abs(whole.rows[0].crest_x));
        ASSERT_NEAR(condensed.rows[k].base_shear, whole.rows[k].base_shear, 1e-9 * whole.peak_base_shear);
    }
    EXPECT_LT((condensed.displacement - whole.displacement).norm(), 1e-11 * whole.displacement.norm());
    EXPECT_GT(whole.peak_crest_x, 1e-4);
}

TEST(FeTimeRun, energy_closes_for_every_scheme_with_rock_water_and_both_components)
{
    const Scene scene = full_dam_on_rock();
    const fe2d::Model model = small_model(scene);
    const GroundMotion motion = pulses(0.01, 401);
    fe2d::TiedRunOptions options = options_of(scene, model, motion);
    for (const auto& scheme : {fe2d::average_acceleration(), fe2d::hht(-0.05), fe2d::hht(-1.0 / 3.0)}) {
        options.scheme = scheme;
        const auto history = fe2d::integrate(model, motion, options);
        EXPECT_LT(history.largest_imbalance, 1e-12);
        EXPECT_GT(history.rows.back().energy.damping, 0.0);
    }
}

// E x 1e6: the dam is a rigid body. Base shear = thrust + (m + m_w) a_h, normal force = weight + m a_v, crest moves with the
// ground; b_K-damping only, so that the stiff modes do not ring. Compliance left: 1e-6 of the elastic dam's.
TEST(FeTimeRun, rigid_dam_hands_the_inertia_to_its_base)
{
    Scene scene = fe2d::test::reference_dam();
    scene.dam.young_modulus = 25e15;
    scene.reservoir = Reservoir{.level = 62.5};
    const fe2d::Model model = small_model(scene);
    const GroundMotion motion = pulses(0.01, 201);
    fe2d::TiedRunOptions options = options_of(scene, model, motion);
    options.damping = {};
    options.damping.constants.stiffness = 1e-3;
    const auto history = fe2d::integrate(model, motion, options);
    const double mass = 1599.75 * 2500.0, scale = mass * 2.0;
    for (const auto& row : history.rows) {
        ASSERT_NEAR(row.base_shear, 0.5 * 9810.0 * 62.5 * 62.5 + model.total_mass.x() * row.ground_accel_h,
                    1e-3 * scale);
        ASSERT_NEAR(row.base_normal, mass * (9.81 + row.ground_accel_v), 1e-3 * scale);
        ASSERT_NEAR(row.crest_accel_x, -row.ground_accel_h, 1e-3 * 2.0);
    }
    EXPECT_NEAR(model.total_mass.x() - mass, 7.0 / 12.0 * 1000.0 * 62.5 * 62.5, 2e-3 * mass);
    // Mass damping of the total velocity adds a_M m v_g: on a rigid dam nothing else has a velocity.
    options.damping.constants.mass = 0.8;
    options.damping.mass = MassDamping::total;
    const auto total = fe2d::integrate(model, motion, options);
    double velocity = 0.0;
    for (std::size_t k = 1; k < total.rows.size(); ++k) {
        velocity += 0.005 * (total.rows[k].ground_accel_h + total.rows[k - 1].ground_accel_h);
        ASSERT_NEAR(total.rows[k].base_shear - history.rows[k].base_shear, 0.8 * mass * velocity, 1e-3 * scale);
    }
}

// A pulse of a_h > 0 (ground accelerates upstream) must throw the dam downstream; a_v > 0 must press it down.
TEST(FeTimeRun, signs_of_the_ground_motion)
{
    const Scene scene = fe2d::test::reference_dam();
    const fe2d::Model model = small_model(scene);
    GroundMotion motion;
    motion.dt = 0.005;
    motion.accel_h.assign(20, 1.0);
    motion.accel_h[0] = 0.0;
    auto history = fe2d::integrate(model, motion, {});
    EXPECT_GT(history.rows.back().crest_x, 0.0);
    EXPECT_GT(history.rows.back().base_shear, 0.0);
    motion.accel_v = motion.accel_h;
    motion.accel_h.assign(20, 0.0);
    history = fe2d::integrate(model, motion, {});
    EXPECT_LT(history.rows.back().crest_y, 0.0);
    EXPECT_GT(history.rows.back().base_normal, 0.0);
}

// Every mode integrated exactly for the piecewise linear record (exact/oscillator.hpp) and summed: the time steps' own error is
// left, largest over the samples of the record. It is of second order and small.
TEST(FeTimeRun, converges_to_the_exact_modal_solution)
{
    const Scene scene = fe2d::test::reference_dam();
    Scene coarse = scene;
    coarse.mesh.size = 15.0;
    coarse.mesh.contact_size = 15.0;
    const fe2d::Model model = fe2d::build_model(coarse);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(Eigen::MatrixXd(model.stiffness),
                                                                          Eigen::MatrixXd(model.mass));
    const GroundMotion motion = pulses(0.02, 41);
    const int x = model.dofs(model.mesh.crest.back(), 0);
    const auto constants =
        fe2d::rayleigh_constants(0.05, std::sqrt(modes.eigenvalues()[0]), std::sqrt(modes.eigenvalues()[4]));
    std::vector<double> exact(motion.accel_h.size(), 0.0);
    for (Eigen::Index n = 0; n < modes.eigenvalues().size(); ++n) {
        const VectorXd shape = modes.eigenvectors().col(n);
        // q'' + 2ζω q' + ω² q = Γ_x a_h - Γ_y a_v = -(a0 + slope t) in each interval
        const double w = std::sqrt(modes.eigenvalues()[n]), zeta = fe2d::damping_ratio(constants, w);
        ASSERT_LT(zeta, 1.0); // so chosen: the mesh is coarse
        const double gamma_x = shape.dot(model.inertia_x), gamma_y = shape.dot(model.inertia_y);
        const auto load = [&](std::size_t k) { return -(gamma_x * motion.accel_h[k] - gamma_y * motion.accel_v[k]); };
        double q = 0.0, v = 0.0;
        for (std::size_t k = 0; k + 1 < motion.accel_h.size(); ++k) {
            const exact::RampedOscillator o{w, zeta, load(k), (load(k + 1) - load(k)) / motion.dt, q, v};
            q = o.displacement(motion.dt);
            v = o.velocity(motion.dt);
            exact[k + 1] += shape[x] * q;
        }
    }
    fe2d::TiedRunOptions options;
    options.damping.constants = constants;
    for (const auto& scheme : {fe2d::average_acceleration(), fe2d::hht(-0.05), fe2d::hht(-0.3)}) {
        options.scheme = scheme;
        double error[2] = {0.0, 0.0}, largest = 0.0;
        for (int k = 0; k < 2; ++k) {
            options.keep_every = 64 << k;
            options.dt = motion.dt / options.keep_every;
            const auto history = fe2d::integrate(model, motion, options);
            for (std::size_t i = 0; i < exact.size(); ++i) {
                error[k] = std::max(error[k], std::abs(history.rows[i].crest_x - exact[i]));
                largest = std::max(largest, std::abs(exact[i]));
            }
        }
        EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.1) << scheme.alpha;
        EXPECT_LT(error[1], 1e-3 * largest);
    }
}

// Rayleigh damping of the scene: 5 % on modes 1 and 5, seen in the notes and in the constants.
TEST(FeTimeRun, damping_of_the_scene)
{
    Scene scene = full_dam_on_rock();
    const fe2d::Model model = small_model(scene);
    const GroundMotion motion = pulses(0.01, 401);
    const auto modes = fe2d::modal_masses(fe2d::natural_modes(model, 5));
    auto choice = fe2d::damping_of(scene, model, motion);
    EXPECT_NEAR(fe2d::damping_ratio(choice.constants, modes[0].frequency), 0.05, 1e-9);
    EXPECT_NEAR(fe2d::damping_ratio(choice.constants, modes[4].frequency), 0.05, 1e-9);
    EXPECT_EQ(choice.mass, MassDamping::deformation_only);
    scene.damping.mass_coefficient = 1.5;
    EXPECT_EQ(fe2d::damping_of(scene, model, motion).constants.mass, 1.5);
    EXPECT_EQ(fe2d::damping_of(scene, model, motion).constants.stiffness, choice.constants.stiffness);
    scene.damping = {};
    scene.damping.method = DampingMethod::modified_rayleigh;
    choice = fe2d::damping_of(scene, model, motion);
    ASSERT_TRUE(choice.modified.has_value());
    EXPECT_GT(choice.modified->mass_share, 0.7);
    if (choice.modified->status == fe2d::ModifiedRayleighStatus::found) {
        EXPECT_LT(choice.modified->relative_imbalance, 1e-6);
    }
    scene.damping.method = DampingMethod::none;
    EXPECT_EQ(fe2d::damping_of(scene, model, motion).constants.stiffness, 0.0);
}

TEST(FeTimeRun, cancelling_keeps_what_was_done)
{
    const Scene scene = fe2d::test::reference_dam();
    const fe2d::Model model = small_model(scene);
    const GroundMotion motion = pulses(0.01, 201);
    fe2d::TiedRunOptions options;
    options.keep_every = 10;
    const auto complete = fe2d::integrate(model, motion, options);
    EXPECT_EQ(complete.rows.size(), 21u);
    options.progress = [](const fe2d::RunProgress& progress) {
        return progress.step < 55 ? fe2d::RunAnswer::go_on : fe2d::RunAnswer::stop;
    };
    const auto part = fe2d::integrate(model, motion, options);
    EXPECT_EQ(part.status, fe2d::TiedRunStatus::cancelled);
    EXPECT_EQ(part.steps, 55);
    ASSERT_EQ(part.rows.size(), 6u);
    EXPECT_EQ(part.rows.back().crest_x, complete.rows[5].crest_x); // same bits
    EXPECT_NE(text_of(part.ending).find("stopped by the user at 0.55 s of 2 s"), std::string::npos);
    EXPECT_TRUE(part.displacement.allFinite());
}

TEST(FeTimeRun, steps_that_do_not_fit_are_refused)
{
    const fe2d::Model model = small_model(fe2d::test::reference_dam());
    const GroundMotion motion = pulses(0.01, 21);
    fe2d::TiedRunOptions options;
    for (double dt : {0.003, 0.02, 0.0, -0.01}) {
        options.dt = dt;
        EXPECT_THROW(fe2d::integrate(model, motion, options), InputError) << dt;
    }
    options.dt = 0.01;
    options.scheme = fe2d::linear_acceleration();
    EXPECT_THROW(fe2d::integrate(model, motion, options), InputError); // highest frequency some kHz
    options.dt = 0.01 / 64;
    EXPECT_EQ(fe2d::integrate(model, motion, options).status, fe2d::TiedRunStatus::complete);
}

} // namespace
