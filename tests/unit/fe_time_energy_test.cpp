// The energy ledger: closure, the numerical dissipation against the amplification matrix, and what opens it.
#include "fe2d/time/energy.hpp"
#include "verification/cases/fe_time_models.hpp"
#include "verification/exact/time_schemes.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {

using namespace damslip;
using Eigen::Index;
using Eigen::VectorXd;
using verification::uneven_vector;

struct Outcome {
    fe2d::Energy energy;
    double relative_imbalance; ///< largest of all steps over the largest energy of the run [-]
};

/// 300 steps, the last 100 at half the step size, shaken and loaded, with damping, low-rank damping and massless
/// unknowns. `spoil` may make the constants wrong.
Outcome shaken_lattice(const fe2d::Scheme& scheme, const std::function<void(fe2d::StepConstants&)>& spoil = {})
{
    fe2d::LinearSystem system =
        verification::lattice({.massless_rows = 2, .mass_coefficient = 0.7, .stiffness_coefficient = 0.002});
    const Index n = system.size();
    system.damping_low_rank.columns = system.mass * uneven_vector(n, 0.5);
    system.damping_low_rank.core = Eigen::MatrixXd::Constant(1, 1, 0.3);
    const fe2d::LinearIntegrator integrator(system, scheme);
    const VectorXd dead = 20.0 * uneven_vector(n, 0.9), shaking = system.mass * VectorXd::Ones(n);
    const VectorXd still = Eigen::MatrixXd(system.stiffness).ldlt().solve(dead);
    fe2d::State before = integrator.start(still, VectorXd::Zero(n), dead), after;
    fe2d::EnergyLedger ledger(before);
    double worst = 0.0;
    for (double dt : {0.02, 0.01}) {
        const fe2d::StepConstants constants = fe2d::step_constants(scheme, dt);
        fe2d::StepConstants used = constants;
        if (spoil) spoil(used);
        const fe2d::StepOperator step(system, used);
        for (int k = 0, steps = dt == 0.02 ? 200 : 100; k < steps; ++k) {
            const double t = before.time + dt;
            const VectorXd load = dead + 6.0 * std::sin(t * (4.0 + 2.0 * t)) * shaking;
            integrator.finish_step(step, before, load, integrator.free_step(step, before, load), after);
            ledger.add_step(before, after, constants);
            worst = std::max(worst, std::abs(ledger.imbalance()));
            std::swap(before, after);
        }
    }
    return {ledger.energy(), worst / ledger.largest_scale()};
}

// Round-off of 300 steps, each about 1e-15 of the largest energy: 1e-12, as required of the program.
TEST(FeTimeEnergy, ledger_closes)
{
    for (const auto& scheme : {fe2d::average_acceleration(), fe2d::hht(0.0), fe2d::newmark(0.5, 0.3),
                               fe2d::newmark(0.7, 0.4), fe2d::hht(-0.05), fe2d::hht(-0.2), fe2d::hht(-1.0 / 3.0)}) {
        const Outcome outcome = shaken_lattice(scheme);
        EXPECT_LT(outcome.relative_imbalance, 1e-12) << "alpha " << scheme.alpha << " gamma " << scheme.gamma;
        EXPECT_GT(outcome.energy.damping, 0.0);
        EXPECT_GT(outcome.energy.external, 0.0);
    }
}

TEST(FeTimeEnergy, average_acceleration_dissipates_nothing_and_hht_does)
{
    EXPECT_EQ(shaken_lattice(fe2d::average_acceleration()).energy.numerical, 0.0);
    EXPECT_GT(shaken_lattice(fe2d::hht(-0.05)).energy.numerical, 0.0);
    EXPECT_GT(shaken_lattice(fe2d::hht(-1.0 / 3.0)).energy.numerical,
              shaken_lattice(fe2d::hht(-0.05)).energy.numerical);
}

// Each constant off by one part in a thousand, in turn, must open the ledger by far more than round-off.
TEST(FeTimeEnergy, a_wrong_integration_constant_opens_the_ledger)
{
    using Constant = double fe2d::StepConstants::*;
    for (Constant constant : {&fe2d::StepConstants::a0, &fe2d::StepConstants::a1, &fe2d::StepConstants::a2,
                              &fe2d::StepConstants::a3, &fe2d::StepConstants::a4, &fe2d::StepConstants::a5}) {
        const Outcome outcome = shaken_lattice(fe2d::hht(-0.1), [&](fe2d::StepConstants& c) { c.*constant *= 1.001; });
        EXPECT_GT(outcome.relative_imbalance, 1e-7);
    }
    const Outcome weight = shaken_lattice(fe2d::hht(-0.1), [](fe2d::StepConstants& c) { c.scheme.alpha *= 1.001; });
    EXPECT_GT(weight.relative_imbalance, 1e-7);
}

// Undamped free vibration in one mode: over whole decays the dissipation must be the energy the amplification matrix
// takes away, 1 - |z|^2n of the start. Both ends lie in the principal pair (third root gone), at the same phase: ratio
// of energies.
TEST(FeTimeEnergy, numerical_dissipation_is_the_decay_of_the_amplification_matrix)
{
    const double dt = 0.02, omega_dt = 0.8;
    for (double alpha : {-0.05, -0.2, -1.0 / 3.0}) {
        const fe2d::Scheme scheme = fe2d::hht(alpha);
        fe2d::LinearIntegrator integrator(verification::oscillator(omega_dt / dt, 0.0, 2.5), scheme);
        const auto z = exact::scheme_roots({scheme.alpha, scheme.gamma, scheme.beta}, 0.0, omega_dt);
        // Start in the principal pair: u = Re zⁿ with a and v from Newmark's relations for u = zⁿ
        // (exact/time_schemes.hpp).
        const std::complex<double> p = scheme.beta * z[0] * z[0] + (0.5 + scheme.gamma - 2.0 * scheme.beta) * z[0] +
                                       (0.5 - scheme.gamma + scheme.beta);
        const std::complex<double> a = (z[0] - 1.0) * (z[0] - 1.0) / (dt * dt * p);
        const std::complex<double> v = dt * (scheme.gamma * z[0] + 1.0 - scheme.gamma) * a / (z[0] - 1.0);
        const VectorXd none = VectorXd::Zero(1);
        const auto scalar = [](double x) { return VectorXd::Constant(1, x); };
        fe2d::State before = integrator.state(scalar(1.0), scalar(v.real()), scalar(a.real()), none), after;
        // F of the step before: u = Re z⁻¹.
        before.unbalanced_before = before.stiffness_force * (1.0 / z[0]).real();
        fe2d::EnergyLedger ledger(before);
        const double start = ledger.energy().kinetic + ledger.energy().strain;
        const auto& step = integrator.step_operator(dt);
        for (int n = 1; n <= 50; ++n) {
            integrator.finish_step(step, before, none, integrator.free_step(step, before, none), after);
            ledger.add_step(before, after, step.constants());
            std::swap(before, after);
            const std::complex<double> phase = std::pow(z[0], n);
            const double u = phase.real(), vn = (v * phase).real();
            const double k = 2.5 * std::pow(omega_dt / dt, 2);
            const double left = 0.5 * k * u * u + 0.5 * 2.5 * vn * vn;
            ASSERT_NEAR(ledger.energy().numerical, start - left, 1e-11 * start);
        }
        EXPECT_GT(ledger.energy().numerical, 0.01 * start);
    }
}

// Work of interface forces as the caller reports it: normal minus friction minus radiated must be what Bᵀλ did.
TEST(FeTimeEnergy, interface_work_has_its_columns)
{
    const fe2d::LinearSystem system = verification::lattice({.mass_coefficient = 0.5});
    const Index n = system.size();
    fe2d::LinearIntegrator integrator(system, fe2d::hht(-0.1));
    fe2d::State before = integrator.start(uneven_vector(n, 0.0), VectorXd::Zero(n), VectorXd::Zero(n)), after;
    fe2d::EnergyLedger ledger(before);
    const auto& step = integrator.step_operator(0.02);
    for (int k = 0; k < 50; ++k) {
        const VectorXd force = -40.0 * uneven_vector(n, 0.1 * k), none = VectorXd::Zero(n);
        integrator.finish_step(step, before, none, integrator.free_step(step, before, none), {force, step.solve(force)},
                               after);
        const double work =
            0.5 * (before.interface_force + after.interface_force).dot(after.displacement - before.displacement);
        ledger.add_step(before, after, step.constants(), {.friction = 2.0 - work, .normal = 3.0, .radiated = 1.0});
        std::swap(before, after);
    }
    EXPECT_LT(std::abs(ledger.imbalance()), 1e-12 * ledger.largest_scale());
    EXPECT_DOUBLE_EQ(ledger.energy().contact_normal, 150.0);
    EXPECT_DOUBLE_EQ(ledger.energy().radiated, 50.0);
}

} // namespace
