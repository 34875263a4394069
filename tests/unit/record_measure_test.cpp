// Measures of an accelerogram against closed solutions of piecewise-linear acceleration.
#include "records/measure/measures.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace {

using namespace damslip::records;
using damslip::Record;
using std::numbers::pi;

// Triangle 0 -> A -> 0, each side t_d: I_A = pi/(2g) 2 A^2 t_d/3, CAV = PGV = A t_d, final displacement A t_d^2
// (centroid at t_d).
TEST(RecordMeasure, triangle_is_exact)
{
    Record record{"triangle", 0.5, {0.0, 3.0, 0.0}, {}, {}};
    const Measures m = measure(record);
    EXPECT_DOUBLE_EQ(m.duration, 1.0);
    EXPECT_DOUBLE_EQ(m.pga, 3.0);
    EXPECT_DOUBLE_EQ(m.pga_time, 0.5);
    EXPECT_DOUBLE_EQ(m.arias_intensity, pi / (2.0 * 9.80665) * 2.0 * 9.0 * 0.5 / 3.0);
    EXPECT_DOUBLE_EQ(m.cumulative_velocity, 1.5);
    EXPECT_DOUBLE_EQ(m.pgv, 1.5);
    EXPECT_DOUBLE_EQ(m.final_velocity, 1.5);
    EXPECT_DOUBLE_EQ(m.final_displacement, 0.75);
    EXPECT_DOUBLE_EQ(m.pgd, 0.75);
}

// Rising side: the running integral is (t/t_d)^3/2 of the total, so share s <= 1/2 arrives at t_d (2 s)^(1/3); by
// symmetry share 1 - s arrives at t_d (2 - (2 s)^(1/3)). Round-off of a cube root found by iteration: 1e-14.
TEST(RecordMeasure, significant_duration_is_found_inside_the_interval)
{
    const std::vector<double> a{0.0, -4.0, 0.0};
    const double t5 = std::cbrt(0.1), t75 = 2.0 - std::cbrt(0.5), t95 = 2.0 - std::cbrt(0.1);
    EXPECT_NEAR(significant_duration(a, 1.0, 0.05, 0.75), t75 - t5, 1e-14);
    EXPECT_NEAR(significant_duration(a, 1.0, 0.05, 0.95), t95 - t5, 1e-14);
    EXPECT_NEAR(significant_duration(a, 1.0, 0.0, 1.0), 2.0, 1e-5); // the ends are triple roots: eps^(1/3)
    EXPECT_EQ(significant_duration(std::vector<double>(5, 0.0), 1.0, 0.05, 0.95), 0.0);
}

// a = 2 -> -1 over 3 s: zero at 2 s; |a| has the triangles 2*2/2 and 1*1/2.
TEST(RecordMeasure, cav_counts_both_sides_of_a_zero_crossing)
{
    EXPECT_DOUBLE_EQ(cumulative_absolute_velocity(std::vector<double>{2.0, -1.0}, 3.0), 2.5);
    EXPECT_DOUBLE_EQ(cumulative_absolute_velocity(std::vector<double>{-2.0, 0.0}, 3.0), 3.0);
}

// a = 2 - t, 0 ... 6 s: v = 2t - t^2/2 peaks inside at t = 2 with 2 and ends at -6; u = t^2 - t^3/6 peaks at t = 4 (v =
// 0) with 16/3 and ends at 0. None of the three extremes is on a sample.
TEST(RecordMeasure, extremes_between_samples_count)
{
    const Peaks p = motion_peaks(std::vector<double>{2.0, -4.0}, 6.0);
    EXPECT_DOUBLE_EQ(p.velocity, 6.0);
    EXPECT_NEAR(p.displacement, 16.0 / 3.0, 1e-14);
    EXPECT_NEAR(p.final_displacement, 0.0, 1e-14);
    const Peaks q = motion_peaks(std::vector<double>{2.0, -2.0}, 4.0); // v = 2t - t^2/2: 2 at t = 2, 0 at both ends
    EXPECT_DOUBLE_EQ(q.velocity, 2.0);
    EXPECT_DOUBLE_EQ(q.final_velocity, 0.0);
}

// Whole periods of a sine that fill a power of two of samples hold one Fourier line only: T_m is its period. 1024
// samples at 1/50 s are 20.48 s long, so nothing is padded. The line's neighbours hold round-off only.
TEST(RecordMeasure, mean_period_of_a_sine)
{
    std::vector<double> a(1024);
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = std::sin(2.0 * pi * 32.0 * static_cast<double>(k) / 1024.0);
    ASSERT_TRUE(mean_period(a, 0.02).has_value());
    EXPECT_NEAR(*mean_period(a, 0.02), 1024.0 * 0.02 / 32.0, 1e-12);
    EXPECT_FALSE(mean_period(std::vector<double>(100, 0.0), 0.01).has_value());
    EXPECT_FALSE(mean_period(std::vector<double>{1.0, 2.0}, 3.0).has_value()); // Nyquist below the band
}

// Two lines of squared amplitudes 1 and 4 at 1 and 5 Hz: T_m = (1/1 + 4/5)/5.
TEST(RecordMeasure, mean_period_weighs_squared_amplitudes)
{
    std::vector<double> a(1000);
    const double dt = 0.032; // 32 s, 1000 samples: padded to 1024, so choose 1024 below
    a.resize(1024);
    for (std::size_t k = 0; k < a.size(); ++k) {
        const double phase = 2.0 * pi * static_cast<double>(k) / 1024.0;
        a[k] = std::sin(32.0 * phase) + 2.0 * std::cos(160.0 * phase);
    }
    const double f1 = 32.0 / (1024.0 * dt), f2 = 160.0 / (1024.0 * dt);
    EXPECT_NEAR(*mean_period(a, dt), (1.0 / f1 + 4.0 / f2) / 5.0, 1e-12);
}

TEST(RecordMeasure, subdividing_changes_nothing)
{
    const std::vector<double> coarse{0.3, -1.0, 2.0, 0.5, -0.7};
    std::vector<double> fine;
    for (std::size_t k = 0; k + 1 < coarse.size(); ++k)
        for (int j = 0; j < 8; ++j) fine.push_back(coarse[k] + (coarse[k + 1] - coarse[k]) * j / 8.0);
    fine.push_back(coarse.back());
    EXPECT_NEAR(arias_intensity(coarse, 0.8), arias_intensity(fine, 0.1), 1e-14);
    EXPECT_NEAR(cumulative_absolute_velocity(coarse, 0.8), cumulative_absolute_velocity(fine, 0.1), 1e-14);
    EXPECT_NEAR(significant_duration(coarse, 0.8, 0.05, 0.95), significant_duration(fine, 0.1, 0.05, 0.95), 1e-13);
    EXPECT_NEAR(motion_peaks(coarse, 0.8).displacement, motion_peaks(fine, 0.1).displacement, 1e-13);
}

} // namespace
