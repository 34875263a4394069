// Dam and rock whose meshes do not match, by slip or by size.
#include "verification/cases/fe_run_scenes.hpp"

#include "fe2d/run/contact_structure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::Index;
using Eigen::VectorXd;
using fe2d::test::options_of;
using fe2d::test::sliding_dam;

std::vector<double> places(double begin, double size, int elements)
{
    std::vector<double> result;
    for (int k = 0; k <= elements; ++k) result.push_back(begin + size * k);
    return result;
}

VectorXd vector_of(const std::vector<double>& values)
{
    return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

VectorXd areas(const std::vector<double>& x)
{
    VectorXd area = VectorXd::Zero(static_cast<Index>(x.size()));
    for (std::size_t k = 0; k + 1 < x.size(); ++k) {
        area[static_cast<Index>(k)] += 0.5 * (x[k + 1] - x[k]);
        area[static_cast<Index>(k + 1)] += 0.5 * (x[k + 1] - x[k]);
    }
    return area;
}

/// ∫ N_j dx over [begin, end], in closed form of the hat functions.
VectorXd hats(const std::vector<double>& x, double begin, double end)
{
    VectorXd result = VectorXd::Zero(static_cast<Index>(x.size()));
    for (std::size_t k = 0; k + 1 < x.size(); ++k) {
        const double a = std::max(begin, x[k]), b = std::min(end, x[k + 1]), h = x[k + 1] - x[k];
        if (b <= a) continue;
        const double right = ((b - x[k]) * (b - x[k]) - (a - x[k]) * (a - x[k])) / (2.0 * h);
        result[static_cast<Index>(k)] += b - a - right;
        result[static_cast<Index>(k + 1)] += right;
    }
    return result;
}

// Contact patch test: a constant pressure on the dam's nodes, p A_i, arrives at the rock as the nodal forces that
// belong to p over the same length, and a linear displacement of the rock is seen without error. Then a state of
// constant stress passes through the joint. Tolerance: sums of about 10 products of order 1.
TEST(FePairing, patch_test_with_meshes_2_to_3_and_irrational_offset)
{
    const auto dam = places(0.0, 3.0, 14);
    for (const double size : {3.0, 2.0, 4.5, 3.0 / std::numbers::pi}) {
        const auto rock = places(-6.0, size, static_cast<int>(std::ceil(60.0 / size)));
        const Pairing pairing(dam, rock);
        for (const double slip : {0.0, std::numbers::sqrt2, -std::numbers::e, 2.0, 5.999}) {
            const Pairing::Matrix p = pairing.weights(slip);
            const VectorXd on_rock = p.transpose() * areas(dam);
            EXPECT_LT((on_rock - hats(rock, slip, 42.0 + slip)).cwiseAbs().maxCoeff(), 1e-12 * size) << size << slip;
            const VectorXd seen = p * vector_of(rock);
            EXPECT_LT((seen - vector_of(dam)).cwiseAbs().maxCoeff() - std::abs(slip), 1e-12 * 42.0);
            EXPECT_LT((seen.array() - slip - vector_of(dam).array()).abs().maxCoeff(), 1e-12 * 42.0) << size << slip;
        }
    }
}

TEST(FePairing, equal_meshes_without_slip_face_node_to_node)
{
    const auto dam = places(0.0, 0.75, 60);
    const auto rock = places(-1.5, 0.75, 64);
    const Pairing pairing(dam, rock);
    const Pairing::Matrix p = pairing.weights(0.0);
    for (Index i = 0; i < p.rows(); ++i)
        for (Index j = 0; j < p.cols(); ++j) EXPECT_NEAR(p.coeff(i, j), j == i + 2 ? 1.0 : 0.0, 1e-13);
    EXPECT_TRUE(pairing.reaches(1.5));
    EXPECT_FALSE(pairing.reaches(1.51));
    EXPECT_FALSE(pairing.reaches(-1.6));
}

// No jump where a node passes another: P(s) is a convolution of hats, its second difference is O(ds²).
TEST(FePairing, is_smooth_across_elements)
{
    const Pairing pairing(places(0.0, 1.0, 10), places(-2.0, 1.0, 14));
    const double ds = 1e-4;
    double largest = 0.0;
    for (double s = -0.01; s < 0.01; s += ds) {
        const Eigen::MatrixXd bend = pairing.weights(s + ds) - 2.0 * pairing.weights(s) + pairing.weights(s - ds);
        largest = std::max(largest, bend.cwiseAbs().maxCoeff());
    }
    EXPECT_LT(largest, 20.0 * ds * ds); // second derivatives of ψ*N/A: at most 9/h² inside, 18/h² at the end nodes
}

/// One push: constant acceleration for a while, then still ground.
GroundMotion push(double acceleration, double seconds, double duration)
{
    GroundMotion motion;
    motion.dt = 0.01;
    motion.accel_h.assign(static_cast<std::size_t>(std::lround(duration / motion.dt)) + 1, 0.0);
    for (std::size_t k = 50; k < 50 + static_cast<std::size_t>(seconds / motion.dt); ++k)
        motion.accel_h[k] = acceleration;
    return motion;
}

// The dam slides 0.05, 0.5 and 5 m over flexible rock. The rock is wide and uniform, so where the dam stands hardly
// matters: the slip is that of the small-sliding run to 1e-4 (the box ends 5 m of 150 m nearer, the curtain is 1 m thin).
TEST(FeFiniteSliding, slides_metres_over_flexible_rock)
{
    Scene scene = sliding_dam(0.70);
    RunOptions options = options_of(scene);
    scene.time.substeps = 1;
    const EarthquakeRun small(scene, options);
    scene.contact.sliding = JointPath::finite;
    scene.contact.max_slip = 8.0;
    const EarthquakeRun finite(scene, options);
    const double pushes[][2] = {{1.5, 0.12}, {1.5, 0.36}, {1.5, 1.2}};
    for (const auto& [acceleration, seconds] : pushes) {
        const GroundMotion motion = push(acceleration, seconds, 14.0);
        const RunResult a = small.run(motion), b = finite.run(motion);
        ASSERT_EQ(b.status, Status::at_rest) << text_of(b.notes);
        EXPECT_NEAR(b.slip, a.slip, 1e-4 * a.slip) << acceleration;
        EXPECT_EQ(b.counts.unresolved, 0);
        EXPECT_LT(b.energy_error, 1e-10) << acceleration;
        EXPECT_EQ(b.after.status, StageStatus::ok) << text_of(b.after.notes());
        // At rest the joint carries the loads, wherever the dam stands; after the longest push 1.3e-5 of N' still
        // rings, with and without finite sliding.
        const double normal = b.history.normal_force.front();
        EXPECT_NEAR(b.history.normal_force.back(), normal, 5e-5 * normal);
        EXPECT_NEAR(b.history.normal_force.back(), a.history.normal_force.back(), 5e-6 * normal);
        // No jump at element crossings: while it slides, N' stays within the waves that the small run has too.
        double jump_small = 0.0, jump_finite = 0.0;
        for (std::size_t k = 1; k < std::min(a.history.time.size(), b.history.time.size()); ++k) {
            jump_small = std::max(jump_small, std::abs(a.history.normal_force[k] - a.history.normal_force[k - 1]));
            jump_finite = std::max(jump_finite, std::abs(b.history.normal_force[k] - b.history.normal_force[k - 1]));
        }
        EXPECT_LT(jump_finite, 1.1 * jump_small) << acceleration;
    }
}

TEST(FeFiniteSliding, leaving_the_meshed_plane_is_a_status)
{
    Scene scene = sliding_dam(0.70);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    scene.contact.sliding = JointPath::finite;
    scene.contact.max_slip = 0.1;
    const RunResult result = EarthquakeRun(scene, options).run(push(3.0, 2.4, 8.0));
    EXPECT_EQ(result.status, Status::left_plane);
    EXPECT_NE(text_of(result.notes).find("max_slip"), std::string::npos) << text_of(result.notes);
    EXPECT_GT(result.slip, 0.1);
    EXPECT_GT(result.history.time.size(), 100u);
}

TEST(FeFiniteSliding, is_asked_for_in_the_scene)
{
    Scene scene = sliding_dam(0.70);
    EXPECT_FALSE(EarthquakeRun(scene, options_of(scene)).structure().slides_far());
    scene.contact.sliding = JointPath::finite;
    scene.contact.max_slip = 3.0;
    const EarthquakeRun run(scene, options_of(scene));
    ASSERT_TRUE(run.structure().slides_far());
    EXPECT_GE(run.structure().pairing().reach_downstream(), 3.0);
    EXPECT_LT(run.structure().pairing().reach_downstream(), 3.0 + *scene.mesh.contact_size);
}

// Without motion nothing happens, whatever the rock it stands on.
TEST(FeFiniteSliding, start_is_in_equilibrium)
{
    Scene scene = sliding_dam(0.70);
    RunOptions options = options_of(scene);
    scene.time.substeps = 0;
    scene.contact.sliding = JointPath::finite;
    const RunResult result = EarthquakeRun(scene, options).run(push(0.0, 0.1, 10.0));
    EXPECT_LT(result.max_slip, 1e-12);
}

} // namespace
