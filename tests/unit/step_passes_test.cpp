// Passes of a step against the same formulas by Eigen's expressions: not a bit differs.
#include "fe2d/run/step_passes.hpp"

#include "core/version.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace damslip::fe2d;
using damslip::vector_level;
using damslip::VectorLevel;
using Eigen::Index;
using Eigen::VectorXd;

/// Numbers of many sizes, no two vectors alike.
std::vector<VectorXd> uneven_vectors(std::size_t count, Index size)
{
    std::vector<VectorXd> vectors;
    for (std::size_t k = 0; k < count; ++k) {
        VectorXd v(size);
        for (Index i = 0; i < size; ++i) {
            const double place = static_cast<double>(i) + 0.37 * static_cast<double>(k);
            v[i] = std::sin(1.7 * place + 0.3) * std::pow(10.0, 4.0 * std::sin(0.9 * place));
        }
        vectors.push_back(v);
    }
    return vectors;
}

StepConstants constants()
{
    return step_constants({}, 0.01);
}

TEST(StepPasses, SumsOfWorkHaveTheSameBitsOnEveryLevel)
{
    if (vector_level() == VectorLevel::sse2) return; // one level here: nothing to compare
    for (const Index size : {2, 4, 6, 8, 50, 1000, 1002}) {
        const auto v = uneven_vectors(18, size);
        const WorkVectors work{v[0], v[1],  v[2],  v[3],  v[4],  v[5],  v[6],  v[7],  v[8],
                               v[9], v[10], v[11], v[12], v[13], v[14], v[15], v[16], v[17]};
        EXPECT_TRUE(work_sums(work, VectorLevel::sse2) == work_sums(work, VectorLevel::avx2)) << size;
    }
}

// No two sums are of the same vectors.
TEST(StepPasses, SumsOfWorkAreThoseOfTheirNames)
{
    const auto v = uneven_vectors(18, 10);
    const WorkVectors w{v[0], v[1],  v[2],  v[3],  v[4],  v[5],  v[6],  v[7],  v[8],
                        v[9], v[10], v[11], v[12], v[13], v[14], v[15], v[16], v[17]};
    const VectorXd k_du = w.stiffness - w.stiffness_before, m_da = w.mass_accel - w.mass_accel_before;
    const WorkSums sums = work_sums(w);
    const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-14 * std::abs(b); };
    EXPECT_TRUE(same(sums.kinetic, w.velocity.dot(w.mass_rate)));
    EXPECT_TRUE(same(sums.mass_damping, w.step.dot(w.dam_mass_rate + w.dam_mass_rate_before)));
    EXPECT_TRUE(same(sums.stiffness_damping, k_du.dot(w.velocity + w.velocity_before)));
    EXPECT_TRUE(same(sums.load, w.step.dot(w.load)));
    EXPECT_TRUE(same(sums.ground, w.step.dot(w.ground + w.ground_before)));
    EXPECT_TRUE(same(sums.step_inertia, w.step.dot(m_da)));
    EXPECT_TRUE(same(sums.change_inertia, (w.accel - w.accel_before).dot(m_da)));
    EXPECT_TRUE(same(sums.inertia, w.accel.dot(w.mass_accel)));
    EXPECT_TRUE(same(sums.inertia_before, w.accel_before.dot(w.mass_accel_before)));
    EXPECT_TRUE(same(sums.force, w.step.dot(w.force)));
    EXPECT_TRUE(same(sums.force_before2, w.step.dot(w.force_before2)));
    EXPECT_TRUE(same(sums.rate, w.velocity.dot(k_du)));
    EXPECT_TRUE(same(sums.rate_before2, w.velocity_before2.dot(k_du)));
}

TEST(StepPasses, LoadsForcesAndNewmarksFormulasAreThoseOfTheirExpressions)
{
    const StepConstants c = constants();
    const GroundAcceleration start{.h = 0.7, .v = -0.4}, end{.h = -1.3, .v = 0.9};
    for (const Index size : {1, 2, 7, 50, 1002}) {
        const auto v = uneven_vectors(9, size);
        VectorXd b, expected = v[0] + 0.9 * (end.h * v[1] - end.v * v[2]) - (-0.1) * (start.h * v[1] - start.v * v[2]);
        ground_load(-0.1, start, end, v[0], v[1], v[2], b);
        EXPECT_TRUE(b == expected) << size;

        expected = b - v[3] + v[4] + 1.1 * v[5] + 2.3 * v[6] + 0.7 * v[7] + 0.01 * v[8];
        add_to_load(v[3], v[4], {{1.1, v[5]}, {2.3, v[6]}, {0.7, v[7]}, {0.01, v[8]}}, b);
        EXPECT_TRUE(b == expected) << size;

        VectorXd load, force;
        instant_forces(end, 0.31, v[1], v[2], v[3], v[4], v[5], load, force);
        EXPECT_TRUE(load == end.h * v[1] - end.v * v[2]) << size;
        EXPECT_TRUE(force == 0.31 * v[3] + v[4] - v[5] - load) << size;

        VectorXd x = v[0], rate = v[1], accel = v[2];
        move_on(c, v[3], x, rate, accel);
        EXPECT_TRUE(x == v[0] + v[3]) << size;
        EXPECT_TRUE(rate == c.a1 * v[3] - c.a4 * v[1] - c.a5 * v[2]) << size;
        EXPECT_TRUE(accel == c.a0 * v[3] - c.a2 * v[1] - c.a3 * v[2]) << size;
    }
}

} // namespace
