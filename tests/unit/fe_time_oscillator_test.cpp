// One oscillator through the integrator: closed solutions, measured orders, the discrete steady state, initial
// conditions.
#include "fe2d/time/linear_integrator.hpp"
#include "verification/cases/fe_time_models.hpp"
#include "verification/exact/damped_oscillator.hpp"
#include "verification/exact/time_schemes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace {

using namespace damslip;
using Eigen::VectorXd;

VectorXd scalar(double value)
{
    return VectorXd::Constant(1, value);
}

/// Runs from rest or given start to t_end under load(t) per unit mass.
fe2d::State run(const exact::DampedOscillator& o, const fe2d::Scheme& scheme, double dt, int steps, exact::Motion start,
                const std::function<double(double)>& load)
{
    fe2d::LinearIntegrator integrator(verification::oscillator(o.omega, o.ratio), scheme);
    fe2d::State before = integrator.start(scalar(start.displacement), scalar(start.velocity), scalar(load(0.0))), after;
    const auto& step = integrator.step_operator(dt);
    for (int n = 1; n <= steps; ++n) {
        const VectorXd load_after = scalar(load(n * dt));
        integrator.finish_step(step, before, load_after, integrator.free_step(step, before, load_after), after);
        std::swap(before, after);
    }
    return before;
}

/// Observed order between t/n and t/(2n). The error is measured in (u, v/ω), so that no zero crossing of one of them
/// matters.
double observed_order(const fe2d::Scheme& scheme, exact::Motion start, const std::function<double(double)>& load,
                      const exact::Motion& solution, const exact::DampedOscillator& o)
{
    const double t = 1.7;
    double error[2];
    for (int k = 0; k < 2; ++k) {
        const int steps = 3200 << k;
        const fe2d::State end = run(o, scheme, t / steps, steps, start, load);
        error[k] =
            std::hypot(end.displacement[0] - solution.displacement, (end.velocity[0] - solution.velocity) / o.omega);
    }
    return std::log2(error[0] / error[1]);
}

const fe2d::Scheme second_order_schemes[] = {fe2d::average_acceleration(), fe2d::linear_acceleration(),
                                             fe2d::hht(-0.05), fe2d::hht(-1.0 / 3.0)};

// e = c Δt² (1 + d Δt + ...): with ωΔt = 0.006 the order is within a few ωΔt of 2. First order would show as 1.
TEST(FeTimeOscillator, second_order_in_free_vibration_under_a_step_and_a_harmonic_load)
{
    const exact::DampedOscillator o{12.0, 0.05};
    for (const auto& scheme : second_order_schemes) {
        EXPECT_NEAR(observed_order(
                        scheme, {0.3, -2.0}, [](double) { return 0.0; }, o.free(0.3, -2.0, 1.7), o),
                    2.0, 0.02);
        EXPECT_NEAR(observed_order(
                        scheme, {0.0, 0.0}, [](double) { return 5.0; }, o.step(5.0, 1.7), o),
                    2.0, 0.02);
        const auto load = [](double t) { return 5.0 * std::sin(7.0 * t); };
        EXPECT_NEAR(observed_order(scheme, {0.0, 0.0}, load, o.harmonic(5.0, 7.0, 1.7), o), 2.0, 0.02);
    }
}

// γ > ½ without HHT's weighting is of first order only: a scheme mistaken for HHT would show here.
TEST(FeTimeOscillator, newmark_with_gamma_above_one_half_is_of_first_order)
{
    const exact::DampedOscillator o{12.0, 0.05};
    const auto no_load = [](double) { return 0.0; };
    EXPECT_NEAR(observed_order(fe2d::newmark(0.6, 0.3025), {0.3, 0.0}, no_load, o.free(0.3, 0.0, 1.7), o), 1.0, 0.02);
}

// Started in the discrete steady state of exact/time_schemes.hpp the run must stay in it: exact at any step, so that a
// wrong factor of C (the printed C/(βΔt) for γC/(βΔt)) or a load weighted otherwise shows at once. Round-off of 400
// steps: 1e-12.
TEST(FeTimeOscillator, discrete_steady_state_is_kept_exactly)
{
    const double omega = 20.0, ratio = 0.3, load_omega = 13.0, dt = 0.03;
    for (const auto& scheme : second_order_schemes) {
        const auto steady =
            exact::discrete_steady_state({scheme.alpha, scheme.gamma, scheme.beta}, omega, ratio, load_omega, dt);
        fe2d::LinearIntegrator integrator(verification::oscillator(omega, ratio), scheme);
        fe2d::State before = integrator.state(scalar(steady.displacement.real()), scalar(steady.velocity.real()),
                                              scalar(steady.acceleration.real()), scalar(1.0)),
                    after;
        const auto& step = integrator.step_operator(dt);
        for (int n = 1; n <= 400; ++n) {
            const VectorXd load = scalar(std::cos(load_omega * n * dt));
            integrator.finish_step(step, before, load, integrator.free_step(step, before, load), after);
            std::swap(before, after);
            const auto phase = std::polar(1.0, load_omega * n * dt);
            ASSERT_NEAR(before.displacement[0], (steady.displacement * phase).real(),
                        1e-12 * std::abs(steady.displacement));
            ASSERT_NEAR(before.velocity[0], (steady.velocity * phase).real(), 1e-12 * std::abs(steady.velocity));
        }
    }
}

TEST(FeTimeOscillator, start_is_in_equilibrium_with_the_initial_conditions)
{
    const fe2d::LinearIntegrator integrator(verification::oscillator(3.0, 0.1, 2.0), fe2d::hht(-0.1));
    const fe2d::State state = integrator.start(scalar(0.5), scalar(-1.5), scalar(4.0), scalar(0.25));
    // m a = R + Bᵀλ - c v - k u = 4 + 0.25 - (2·0.1·3·2)(-1.5) - (9·2) 0.5 = -2.95
    EXPECT_NEAR(state.acceleration[0], -2.95 / 2.0, 1e-14);
    EXPECT_EQ(state.displacement[0], 0.5);
    EXPECT_EQ(state.velocity[0], -1.5);
    EXPECT_NEAR(state.unbalanced[0] + state.inertia_force[0], 0.0, 1e-14);
}

} // namespace
