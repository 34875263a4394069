// Constants, ranges and stability limits of the schemes, and their action on one oscillator against the characteristic
// polynomial (exact/time_schemes.hpp), which is derived without the step equations.
#include "core/input_error.hpp"
#include "fe2d/time/linear_integrator.hpp"
#include "verification/cases/fe_time_models.hpp"
#include "verification/exact/damped_oscillator.hpp"
#include "verification/exact/time_schemes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace damslip;
using Eigen::VectorXd;
using std::numbers::pi;

exact::SchemeParameters parameters(const fe2d::Scheme& s)
{
    return {s.alpha, s.gamma, s.beta};
}

VectorXd single_entry(double value)
{
    return VectorXd::Constant(1, value);
}

/// (u, v, a) one step later, without load.
Eigen::Vector3d one_step(fe2d::LinearIntegrator& integrator, double dt, const Eigen::Vector3d& start)
{
    const fe2d::State before =
        integrator.state(single_entry(start[0]), single_entry(start[1]), single_entry(start[2]), single_entry(0.0));
    fe2d::State after;
    const auto& step = integrator.step_operator(dt);
    integrator.finish_step(step, before, single_entry(0.0), integrator.free_step(step, before, single_entry(0.0)),
                           after);
    return {after.displacement[0], after.velocity[0], after.acceleration[0]};
}

/// The amplification matrix of the program, column by column from unit states scaled to one unit: (u, Δt v, Δt² a).
Eigen::Matrix3d amplification_matrix(const fe2d::Scheme& scheme, double ratio, double omega_dt)
{
    const double dt = 0.02;
    fe2d::LinearIntegrator integrator(verification::oscillator(omega_dt / dt, ratio, 3.7), scheme);
    const Eigen::Vector3d unit(1.0, 1.0 / dt, 1.0 / (dt * dt));
    Eigen::Matrix3d matrix;
    for (int column = 0; column < 3; ++column) {
        const Eigen::Vector3d start = unit[column] * Eigen::Vector3d::Unit(column);
        matrix.col(column) = one_step(integrator, dt, start).cwiseQuotient(unit);
    }
    return matrix;
}

const fe2d::Scheme schemes[] = {fe2d::average_acceleration(),
                                fe2d::linear_acceleration(),
                                fe2d::newmark(0.6, 0.3025),
                                fe2d::hht(-0.05),
                                fe2d::hht(-0.2),
                                fe2d::hht(-1.0 / 3.0)};

// Invariants (trace, sum of principal minors, determinant) are the coefficients of the characteristic polynomial, so
// equal invariants are equal eigenvalues; they stay well conditioned where eigenvalues meet. Entries are below about
// 10: 1e-12 is round-off.
TEST(FeTimeScheme, amplification_matrix_has_the_roots_of_the_characteristic_polynomial)
{
    for (const auto& scheme : schemes)
        for (double ratio : {0.0, 0.05, 0.4})
            for (double omega_dt : {0.01, 0.3, 1.0, 2.5, 3.4}) {
                const Eigen::Matrix3d m = amplification_matrix(scheme, ratio, omega_dt);
                const double minors = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0) + m(0, 0) * m(2, 2) - m(0, 2) * m(2, 0) +
                                      m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1);
                const auto z = exact::scheme_roots(parameters(scheme), ratio, omega_dt);
                EXPECT_NEAR(m.trace(), (z[0] + z[1] + z[2]).real(), 1e-12);
                EXPECT_NEAR(minors, (z[0] * z[1] + z[0] * z[2] + z[1] * z[2]).real(), 1e-12);
                EXPECT_NEAR(m.determinant(), (z[0] * z[1] * z[2]).real(), 1e-12);
            }
}

// A run shows ζ̄ and T̄: with the third root gone, u_{n+1} - 2Re(z) u_n + |z|² u_{n-1} = 0 from two pairs of samples.
// What is left of the third root after 60 steps is below 0.7^60 = 5e-10 of the pair (largest case), hence 1e-8.
TEST(FeTimeScheme, decay_and_period_of_a_run_follow_the_principal_roots)
{
    for (const auto& scheme : schemes) {
        const double dt = 0.02, omega_dt = 2.0 * pi * 0.1, ratio = 0.02;
        fe2d::LinearIntegrator integrator(verification::oscillator(omega_dt / dt, ratio), scheme);
        Eigen::Vector3d x(1.0, 0.0, -omega_dt * omega_dt / (dt * dt));
        double u[64];
        for (int n = 0; n < 64; ++n) {
            u[n] = x[0];
            x = one_step(integrator, dt, x);
        }
        // [u61 -u60; u62 -u61] (2Re z, |z|²)ᵀ = (u62, u63)ᵀ
        const double det = u[60] * u[62] - u[61] * u[61];
        const double twice_real = (u[60] * u[63] - u[61] * u[62]) / det;
        const double modulus = std::sqrt((u[61] * u[63] - u[62] * u[62]) / det);
        const double angle = std::acos(0.5 * twice_real / modulus);
        const auto expected = exact::numerical_vibration(parameters(scheme), ratio, omega_dt);
        EXPECT_NEAR(-std::log(modulus) / angle, expected.damping_ratio, 1e-8);
        EXPECT_NEAR(omega_dt * std::sqrt(1.0 - ratio * ratio) / angle, expected.period_ratio, 1e-8);
    }
}

// Known figures: average acceleration lengthens the period by Ω²/12 and has no damping; at α = -1/3 and Δt = 0.01 s an
// 18 Hz mode is about 14 % too slow.
TEST(FeTimeScheme, known_period_errors)
{
    const auto average = exact::numerical_vibration({0.0, 0.5, 0.25}, 0.0, 0.01);
    EXPECT_NEAR(average.period_ratio - 1.0, 0.01 * 0.01 / 12.0, 1e-9);
    EXPECT_NEAR(average.damping_ratio, 0.0, 1e-13);
    const auto stiff = exact::numerical_vibration(parameters(fe2d::hht(-1.0 / 3.0)), 0.0, 2.0 * pi * 18.0 * 0.01);
    EXPECT_NEAR(stiff.period_ratio, 1.14, 0.01);
}

TEST(FeTimeScheme, hht_is_stable_at_any_step)
{
    for (double alpha : {0.0, -0.05, -0.1, -0.2, -0.3, -1.0 / 3.0})
        for (double ratio : {0.0, 0.05})
            for (double omega_dt = 1e-3; omega_dt < 1e7; omega_dt *= 3.0) {
                const Eigen::Matrix3d m = amplification_matrix(fe2d::hht(alpha), ratio, omega_dt);
                EXPECT_LE(std::abs(exact::scheme_roots(parameters(fe2d::hht(alpha)), ratio, omega_dt)[0]), 1.0 + 1e-7);
                EXPECT_TRUE(m.allFinite());
            }
}

// Undamped linear acceleration: trace 2 - Ω²/(1+Ω²/6) = -2 at Ω² = 12, so Δt/T = √12/2π = 0.55133. 2e-5 above it the
// growth is 1.005 per step, e^100 in 20 000 steps; 2e-5 below, a bounded beat of amplitude about 1/√(2e-5).
TEST(FeTimeScheme, linear_acceleration_is_stable_up_to_0_551_periods)
{
    const double limit = std::sqrt(12.0) / (2.0 * pi);
    EXPECT_NEAR(limit, 0.551, 5e-4);
    EXPECT_DOUBLE_EQ(fe2d::stability_limit(fe2d::linear_acceleration()), std::sqrt(12.0));
    const double dt = 0.01;
    for (double side : {-1.0, 1.0}) {
        const double omega = 2.0 * pi * limit * (1.0 + side * 2e-5) / dt;
        fe2d::LinearIntegrator integrator(verification::oscillator(omega, 0.0), fe2d::linear_acceleration());
        Eigen::Vector3d x(1.0, 0.0, -omega * omega);
        double largest = 0.0;
        for (int n = 0; n < 20000; ++n) {
            x = one_step(integrator, dt, x);
            largest = std::max(largest, std::abs(x[0]));
            if (largest > 1e30) break;
        }
        if (side < 0.0) {
            EXPECT_LT(largest, 1e3);
        } else {
            EXPECT_GT(largest, 1e20);
        }
    }
}

TEST(FeTimeScheme, unstable_or_meaningless_settings_are_refused)
{
    EXPECT_THROW(fe2d::hht(0.01), InputError);
    EXPECT_THROW(fe2d::hht(-0.34), InputError);
    EXPECT_THROW(fe2d::hht(std::nan("")), InputError);
    EXPECT_THROW(fe2d::newmark(0.49, 0.25), InputError);
    EXPECT_THROW(fe2d::newmark(0.5, 0.0), InputError);
    EXPECT_THROW(fe2d::newmark(1.01, 0.6), InputError);
    const fe2d::Scheme linear = fe2d::linear_acceleration();
    const double omega = 2.0 * pi * 10.0;
    EXPECT_NO_THROW(fe2d::check_step(linear, 0.0551, omega));
    EXPECT_THROW(fe2d::check_step(linear, 0.0552, omega), InputError);
    EXPECT_THROW(fe2d::check_step(fe2d::average_acceleration(), 0.0, omega), InputError);
    const fe2d::LinearSystem massless = verification::lattice({.massless_rows = 2});
    EXPECT_TRUE(std::isinf(fe2d::highest_frequency(massless)));
    EXPECT_THROW(fe2d::check_step(linear, 1e-9, fe2d::highest_frequency(massless)), InputError);
    EXPECT_NO_THROW(fe2d::check_step(fe2d::hht(-0.05), 1.0, fe2d::highest_frequency(massless)));
    try {
        fe2d::hht(0.2);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("time.alpha = 0.2"), std::string::npos);
    }
}

// Largest eigenvalue of a chain fixed at one end and free at the other, unit mass and stiffness: ω_k = 2
// sin((2k-1)π/(2(2n+1))), so the n-th is 2 cos(π/(2n+1)). As many Lanczos steps as unknowns: exact up to round-off.
TEST(FeTimeScheme, highest_frequency_of_a_uniform_chain)
{
    const Eigen::Index n = 9;
    std::vector<Eigen::Triplet<double>> k, m;
    for (Eigen::Index i = 0; i < n; ++i) {
        m.emplace_back(i, i, 1.0);
        k.emplace_back(i, i, i + 1 < n ? 2.0 : 1.0);
        if (i + 1 < n) {
            k.emplace_back(i, i + 1, -1.0);
            k.emplace_back(i + 1, i, -1.0);
        }
    }
    fe2d::LinearSystem chain;
    chain.mass.resize(n, n);
    chain.mass.setFromTriplets(m.begin(), m.end());
    chain.stiffness.resize(n, n);
    chain.stiffness.setFromTriplets(k.begin(), k.end());
    chain.damping.resize(n, n);
    EXPECT_NEAR(fe2d::highest_frequency(chain), 2.0 * std::cos(pi / (2.0 * 9.0 + 1.0)), 1e-12);
}

// More unknowns than Lanczos steps: the largest eigenvalue comes out all the same, to 1e-6 as the header says.
TEST(FeTimeScheme, highest_frequency_of_a_lattice)
{
    const fe2d::LinearSystem system = verification::lattice({.nx = 12, .ny = 14});
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> all(
        Eigen::MatrixXd(system.stiffness), Eigen::MatrixXd(system.mass), Eigen::EigenvaluesOnly);
    const double highest = std::sqrt(all.eigenvalues().maxCoeff());
    EXPECT_NEAR(fe2d::highest_frequency(system), highest, 1e-6 * highest);
}

} // namespace
