// Scaling, subdividing, baseline and the two components on one grid.
#include "records/measure/measures.hpp"
#include "records/transform/transform.hpp"

#include "core/input_error.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::records;

Record make(double dt, std::vector<double> a)
{
    return Record{"r", dt, std::move(a), {}, {}};
}

TEST(RecordTransform, scaling_and_polarity)
{
    EXPECT_EQ(scaled(make(0.1, {1.0, -2.0}), -1.0).acceleration, (std::vector<double>{-1.0, 2.0}));
    EXPECT_EQ(scaled_to_pga(make(0.1, {1.0, -2.0}), 3.0).acceleration, (std::vector<double>{1.5, -3.0}));
    EXPECT_THROW(scaled_to_pga(make(0.1, {0.0, 0.0}), 3.0), InputError);
}

TEST(RecordTransform, subdividing_is_linear_and_keeps_the_samples)
{
    const Record fine = subdivided(make(0.4, {0.0, 4.0, -4.0}), 4);
    EXPECT_DOUBLE_EQ(fine.dt, 0.1);
    EXPECT_EQ(fine.acceleration, (std::vector<double>{0, 1, 2, 3, 4, 2, 0, -2, -4}));
    EXPECT_EQ(resampled(make(0.4, {0.0, 4.0, -4.0}), 0.1).acceleration, fine.acceleration);
    EXPECT_TRUE(resampled(make(0.4, {0.0, 4.0, -4.0}), 0.1).warnings.empty());
    EXPECT_THROW(subdivided(make(0.4, {0.0, 4.0, -4.0}), 5'000'000), InputError);
}

TEST(RecordTransform, resampling_to_no_divisor_says_what_it_cost)
{
    const Record out = resampled(make(0.2, {0.0, 2.0, 0.0, 0.0}), 0.15);
    ASSERT_EQ(out.acceleration.size(), 5u);
    EXPECT_NEAR(out.acceleration[1], 1.5, 1e-12);
    EXPECT_NEAR(out.acceleration[2], 1.0, 1e-12);
    ASSERT_EQ(out.warnings.size(), 1u);
    EXPECT_NE(out.warnings[0].find("PGA 2 m/s2 became 1.5 m/s2"), std::string::npos) << out.warnings[0];
    EXPECT_THROW(resampled(make(0.2, {0.0, 2.0}), 1.0), InputError);
}

// A record that is the polynomial itself comes out as zero; added to another record, the same remainder is left.
TEST(RecordTransform, baseline_takes_the_polynomial_off)
{
    std::vector<double> a(301);
    for (std::size_t k = 0; k < a.size(); ++k) {
        const double x = static_cast<double>(k) / 300.0;
        a[k] = 0.3 - 0.7 * x + 2.0 * x * x;
    }
    for (const BaselineFit fit : {BaselineFit::acceleration, BaselineFit::velocity}) {
        const auto result = baseline_corrected(make(0.01, a), {BaselineDegree::quadratic, fit});
        for (const double left : result.record.acceleration) EXPECT_NEAR(left, 0.0, 1e-13);
        ASSERT_EQ(result.coefficients.size(), 3u);
        EXPECT_NEAR(result.coefficients[0], 0.3, 1e-12);
        EXPECT_NEAR(result.coefficients[1], -0.7, 1e-12);
        EXPECT_NEAR(result.coefficients[2], 2.0, 1e-12);
    }
    EXPECT_THROW(baseline_corrected(make(0.01, {1.0, 2.0, 3.0})), InputError);
}

// The velocity fit leaves less velocity than any neighbour of its coefficient: the definition of the least square.
TEST(RecordTransform, velocity_fit_is_a_minimum)
{
    std::vector<double> a(200);
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = std::sin(0.3 * static_cast<double>(k)) + 0.2;
    const auto sum_of_v2 = [](const Record& r) {
        double v = 0.0, sum = 0.0;
        for (std::size_t k = 1; k < r.acceleration.size(); ++k) {
            v += 0.5 * (r.acceleration[k - 1] + r.acceleration[k]);
            sum += v * v;
        }
        return sum;
    };
    const Record best = baseline_corrected(make(0.01, a), {BaselineDegree::constant, BaselineFit::velocity}).record;
    for (const double shift : {-1e-3, 1e-3}) {
        Record other = best;
        for (double& x : other.acceleration) x += shift;
        EXPECT_LT(sum_of_v2(best), sum_of_v2(other));
    }
}

TEST(RecordTransform, ground_motion_pads_and_starts_at_zero)
{
    const GroundMotion m =
        make_ground_motion(make(0.02, {0.0, 1.0, 2.0}), make(0.02, {0.5, 1.0, 2.0, 3.0, 0.0}), {2.0, {}, -1});
    EXPECT_EQ(m.accel_h, (std::vector<double>{0, 0, -2, -4, 0, 0}));
    EXPECT_EQ(m.accel_v, (std::vector<double>{0, 1, 2, 4, 6, 0}));
    ASSERT_EQ(m.notes.size(), 2u);
    EXPECT_EQ(
        m.notes[0],
        "horizontal component filled up with 2 zero samples to the length of the other (its last sample is -4 m/s2)");
    EXPECT_EQ(m.notes[1], "a zero sample was put 0.02 s before the first, which is 1 m/s2");
}

TEST(RecordTransform, ground_motion_leaves_a_clean_pair_alone)
{
    const GroundMotion m = make_ground_motion(make(0.02, {0.0, 1.0, 2.0}), std::nullopt);
    EXPECT_EQ(m.accel_h, (std::vector<double>{0, 1, 2}));
    EXPECT_TRUE(m.accel_v.empty());
    EXPECT_TRUE(m.notes.empty());
}

TEST(RecordTransform, ground_motion_scales_both_by_the_horizontal_peak)
{
    const GroundMotion m = make_ground_motion(make(0.02, {0.0, -2.0, 1.0}), make(0.02, {0.0, 0.5, 0.0}), {1.5, 1.0, 1});
    EXPECT_EQ(m.accel_h, (std::vector<double>{0.0, -1.5, 0.75}));
    EXPECT_EQ(m.accel_v, (std::vector<double>{0.0, 0.375, 0.0}));
}

// 0.02 and 0.015 s share 0.005 s: both are subdivided and the motion is unchanged; 0.01 and 0.007 share nothing near.
TEST(RecordTransform, ground_motion_finds_the_common_step)
{
    const GroundMotion m = make_ground_motion(make(0.02, {0.0, 4.0, 0.0, 4.0}), make(0.015, {0.0, 3.0, 0.0, 3.0, 0.0}));
    EXPECT_NEAR(m.dt, 0.005, 1e-18);
    EXPECT_EQ(m.accel_h, (std::vector<double>{0, 1, 2, 3, 4, 3, 2, 1, 0, 1, 2, 3, 4}));
    EXPECT_EQ(m.accel_v, (std::vector<double>{0, 1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 0}));
    ASSERT_EQ(m.notes.size(), 1u);

    const GroundMotion odd = make_ground_motion(make(0.0213, {0.0, 4.0, 0.0}), make(0.01, {0.0, 1.0, 0.0}));
    EXPECT_EQ(odd.dt, 0.01);
    ASSERT_GE(odd.notes.size(), 1u);
    EXPECT_NE(odd.notes[0].find("horizontal component resampled"), std::string::npos);
}

} // namespace
