// Response spectra against closed solutions of the oscillator on piecewise-linear ground acceleration.
#include "records/measure/measures.hpp"
#include "verification/exact/oscillator.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace {

using namespace damslip::records;
using damslip::exact::RampedOscillator;
using std::numbers::pi;

std::vector<double> jagged()
{
    std::vector<double> a;
    unsigned x = 12345;
    for (int k = 0; k < 60; ++k)
        a.push_back(static_cast<double>((x = x * 1103515245u + 12345u) >> 16 & 1023) / 512.0 - 1.0);
    return a;
}

// One step from any state is the closed solution; the series is summed to round-off, amplified by the closed form's own
// cancellation for small w h, hence relative 1e-12 at w h >= 0.1.
TEST(RecordSpectrum, one_step_is_the_closed_solution)
{
    for (const double zeta : {0.0, 0.05, 0.7})
        for (const double w : {10.0, 39.0}) {
            const RampedOscillator exact{w, zeta, 1.3, -40.0, 0.02, -0.3};
            const double h = 0.01;
            const OscillatorState s = OscillatorStep(w, zeta, h).advance({0.02, -0.3}, 1.3, 1.3 - 40.0 * h);
            EXPECT_NEAR(s.displacement, exact.displacement(h), 1e-12 * 0.02) << w << " " << zeta;
            EXPECT_NEAR(s.velocity, exact.velocity(h), 1e-12 * 0.3) << w << " " << zeta;
        }
}

// w = 0 is the free mass: u = -(a0/3 + a1/6) h^2, v = -(a0 + a1) h/2. Where the closed form divides by w^3, the series
// does not.
TEST(RecordSpectrum, free_mass_is_the_limit)
{
    const OscillatorState s = OscillatorStep(0.0, 0.05, 0.5).advance({}, 2.0, -1.0);
    EXPECT_NEAR(s.displacement, -(2.0 / 3.0 - 1.0 / 6.0) * 0.25, 1e-15);
    EXPECT_NEAR(s.velocity, -0.25, 1e-15);
}

// A constant acceleration, longer than T/2: PSA = A (1 + exp(-pi zeta/sqrt(1 - zeta^2))), and without damping S_a is
// the same. Cubic between steps of T/16: (2 pi/16)^4/384 = 6e-5 of the oscillating part.
TEST(RecordSpectrum, step_of_ground_acceleration)
{
    const std::vector<double> a(400, 2.0);
    for (const double zeta : {0.0, 0.02, 0.05, 0.2})
        for (const double period : {0.013, 0.0777, 0.31, 1.9}) {
            const auto point = response_spectrum(a, 0.01, std::vector{period}, zeta).points[0];
            const double exact = damslip::exact::step_pseudo_acceleration(2.0, zeta);
            EXPECT_NEAR(point.pseudo_acceleration / exact, 1.0, 6e-5) << period << " " << zeta;
            if (zeta == 0.0) {
                EXPECT_NEAR(point.absolute_acceleration / exact, 1.0, 6e-5);
            }
        }
}

// Dense sampling (400 points an interval) of the closed solution strung together over a jagged record: it bounds the
// true peak from below, short of it by (w dt/400)^2/8 < 4e-4 at T = 0.02 s, dt = 0.02 s... 2.5e-5; the cubic adds 6e-5.
TEST(RecordSpectrum, jagged_record_against_dense_sampling)
{
    const std::vector<double> a = jagged();
    const double dt = 0.02;
    for (const double zeta : {0.0, 0.05})
        for (const double period : {0.02, 0.05, 0.13, 0.5, 3.0}) {
            const double w = 2.0 * pi / period;
            double u0 = 0.0, v0 = 0.0, s_d = 0.0, s_v = 0.0, s_a = 0.0;
            const auto follow = [&](double a0, double a1, int points) {
                const RampedOscillator exact{w, zeta, a0, (a1 - a0) / dt, u0, v0};
                for (int j = 1; j <= points; ++j) {
                    const double t = dt * j / points, u = exact.displacement(t), v = exact.velocity(t);
                    s_d = std::max(s_d, std::abs(u));
                    s_v = std::max(s_v, std::abs(v));
                    s_a = std::max(s_a, std::abs(w * w * u + 2.0 * zeta * w * v));
                }
                u0 = exact.displacement(dt);
                v0 = exact.velocity(dt);
            };
            for (std::size_t k = 1; k < a.size(); ++k) follow(a[k - 1], a[k], 400);
            for (int k = 0; k < static_cast<int>(std::ceil(period / dt)); ++k) follow(0.0, 0.0, 400);
            const auto point = response_spectrum(a, dt, std::vector{period}, zeta).points[0];
            EXPECT_NEAR(point.displacement / s_d, 1.0, 1e-4) << period << " " << zeta;
            EXPECT_NEAR(point.velocity / s_v, 1.0, 1e-4) << period << " " << zeta;
            EXPECT_NEAR(point.absolute_acceleration / s_a, 1.0, 1e-4) << period << " " << zeta;
            EXPECT_NEAR(point.pseudo_acceleration, w * w * point.displacement, 1e-12 * point.pseudo_acceleration);
            EXPECT_EQ(
                peak_absolute_acceleration(a, dt, 1.0 / period, zeta),
                response_spectrum(a, dt, std::vector{1.0 / (1.0 / period)}, zeta).points[0].absolute_acceleration);
        }
}

// Seven steps at once are seven steps, under the same straight line; the terms are of the size of the state.
TEST(RecordSpectrum, repeated_steps_are_one)
{
    for (const double zeta : {0.0, 0.05, 1.0, 5.0}) {
        const double w = 30.0, h = 2.0 / (w * (1.0 + 2.0 * zeta)) * 0.9;
        const OscillatorStep step(w, zeta, h);
        for (const int count : {1, 2, 7, 32}) {
            OscillatorState one{0.01, -0.2};
            const OscillatorState at_once = step.repeated(count).advance(one, -3.0, 4.0);
            for (int k = 0; k < count; ++k)
                one = step.advance(one, -3.0 + 7.0 * k / count, -3.0 + 7.0 * (k + 1) / count);
            EXPECT_NEAR(at_once.displacement, one.displacement, 1e-14);
            EXPECT_NEAR(at_once.velocity, one.velocity, 1e-13);
        }
    }
}

// Intervals much longer than the period are divided where a largest value can be only. On a grid so fine that every interval
// is a few steps the same record gives the same peaks.
TEST(RecordSpectrum, long_intervals_hide_no_peak)
{
    const std::vector<double> a = jagged();
    const double dt = 0.01;
    const int parts = 128;
    std::vector<double> fine;
    for (std::size_t k = 0; k + 1 < a.size(); ++k)
        for (int j = 0; j < parts; ++j) fine.push_back(a[k] + (a[k + 1] - a[k]) * j / parts);
    fine.push_back(a.back());
    for (const double period : {dt / 5.0, dt / 30.0, dt / 200.0})
        for (const double zeta : {0.0, 0.02, 0.3, 0.5, 0.6, 0.95, 1.0, 1.5, 4.0, 10.0}) {
            const SpectrumPoint whole = response_spectrum(a, dt, std::vector{period}, zeta).points[0];
            const SpectrumPoint divided = response_spectrum(fine, dt / parts, std::vector{period}, zeta).points[0];
            EXPECT_NEAR(whole.displacement / divided.displacement, 1.0, 1e-4) << dt / period << " " << zeta;
            EXPECT_NEAR(whole.velocity / divided.velocity, 1.0, 1e-4) << dt / period << " " << zeta;
            EXPECT_NEAR(whole.absolute_acceleration / divided.absolute_acceleration, 1.0, 1e-4)
                << dt / period << " " << zeta;
        }
}

// A half cycle shorter than T/2 reaches its peak after the record's end: impulse I on a slow oscillator gives S_d =
// I/w, S_v = I. The triangle of duration 0.02 s on T = 10 s: relative error of the impulse limit (w t_d)^2/24 with t_d
// = 0.01: 2e-6.
TEST(RecordSpectrum, free_vibration_after_the_end_counts)
{
    const std::vector<double> a{0.0, 5.0, 0.0};
    const auto point = response_spectrum(a, 0.01, std::vector{10.0}, 0.0).points[0];
    EXPECT_NEAR(point.displacement / (0.05 / (2.0 * pi / 10.0)), 1.0, 6e-5);
    EXPECT_NEAR(point.velocity / 0.05, 1.0, 6e-5);
}

// T = 0 and far below dt: PGA. Just above the limit the oscillator is followed, and the kinks of the record add T/(2 pi
// dt) at most.
TEST(RecordSpectrum, short_periods_tend_to_pga)
{
    std::vector<double> a = jagged();
    a.front() = 0.0; // a jump at the start would be felt twofold by any period
    double pga = 0.0;
    for (const double x : a) pga = std::max(pga, std::abs(x));
    const auto points = response_spectrum(a, 0.02, std::vector{0.0, 1e-6, 1e-4}, 0.05).points;
    EXPECT_EQ(points[0].absolute_acceleration, pga);
    EXPECT_EQ(points[1].pseudo_acceleration, pga);
    EXPECT_NEAR(points[2].pseudo_acceleration / pga, 1.0, 2e-3);
}

TEST(RecordSpectrum, overcritical_damping_and_very_long_periods_stay_finite)
{
    const std::vector<double> a = jagged();
    for (const double zeta : {1.0, 3.0, 10.0})
        for (const double period : {0.01, 1.0, 1000.0}) {
            const auto point = response_spectrum(a, 0.02, std::vector{period}, zeta).points[0];
            EXPECT_TRUE(std::isfinite(point.absolute_acceleration));
            EXPECT_GT(point.displacement, 0.0);
        }
}

TEST(RecordSpectrum, logarithmic_periods_keep_their_ends)
{
    const auto periods = logarithmic_periods(0.05, 2.0, 7);
    EXPECT_EQ(periods.size(), 7u);
    EXPECT_EQ(periods.front(), 0.05);
    EXPECT_EQ(periods.back(), 2.0);
    EXPECT_NEAR(periods[3], std::sqrt(0.1), 1e-15);
}

} // namespace
