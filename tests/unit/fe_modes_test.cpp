// Natural modes: normalisation, orthogonality, effective masses, massless rock, repeatability.
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe_scenes.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

Scene coarse_dam(bool on_rock)
{
    Scene scene = on_rock ? test::reference_dam_on_rock() : test::reference_dam();
    scene.mesh.size = 8.0;
    scene.mesh.contact_size = 8.0;
    return scene;
}

TEST(FeModes, orthonormal_in_mass_and_stiffness)
{
    const Model model = build_model(test::reference_dam_on_rock());
    const NaturalModes modes = natural_modes(model, 8);
    ASSERT_EQ(modes.status, ModesStatus::ok);
    const Eigen::MatrixXd m = modes.shape.transpose() * (model.mass * modes.shape),
                          k = modes.shape.transpose() * (model.stiffness * modes.shape);
    EXPECT_LT((m - Eigen::MatrixXd::Identity(8, 8)).lpNorm<Eigen::Infinity>(), 1e-9);
    const Eigen::VectorXd omega2 = (2.0 * M_PI * modes.frequency).cwiseAbs2();
    const Eigen::MatrixXd diagonal = omega2.asDiagonal();
    EXPECT_LT((k - diagonal).lpNorm<Eigen::Infinity>(), 1e-8 * omega2.maxCoeff());
    for (int i = 0; i + 1 < 8; ++i) EXPECT_LT(modes.frequency[i], modes.frequency[i + 1]);
    for (int i = 0; i < 8; ++i) { // largest entry positive
        Eigen::Index largest = 0;
        modes.shape.col(i).cwiseAbs().maxCoeff(&largest);
        EXPECT_GT(modes.shape(largest, i), 0.0);
    }
}

// All modes of a small model, against Eigen's dense generalised solver on the statically condensed (massive) unknowns;
// together they carry the whole mass in both directions, because the base of the dam moves with the rock here.
TEST(FeModes, all_modes_of_a_small_model)
{
    const Model model = build_model(coarse_dam(true));
    int massive = 0;
    for (int i = 0; i < model.dofs.count; ++i) massive += model.mass.coeff(i, i) > 0.0;
    const NaturalModes modes = natural_modes(model, massive);
    ASSERT_EQ(modes.frequency.size(), massive);
    EXPECT_NEAR(modes.effective_share.row(0).sum(), 1.0, 1e-9);
    EXPECT_NEAR(modes.effective_share.row(1).sum(), 1.0, 1e-9);

    const Eigen::MatrixXd k = model.stiffness, m = model.mass;
    const int n = model.dofs.count - massive; // dam unknowns come first and all have mass; the rest is massless rock
    ASSERT_EQ(dam_dof_count(model.mesh, model.dofs), massive);
    const Eigen::MatrixXd condensed =
        k.topLeftCorner(massive, massive) -
        k.topRightCorner(massive, n) * k.bottomRightCorner(n, n).ldlt().solve(k.bottomLeftCorner(n, massive));
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(condensed, m.topLeftCorner(massive, massive));
    for (int i = 0; i < 20; ++i)
        EXPECT_NEAR(modes.frequency[i], std::sqrt(dense.eigenvalues()[i]) / (2.0 * M_PI), 1e-8 * modes.frequency[i]);
    const NaturalModes few = natural_modes(model, 5); // by Lanczos instead of the whole spectrum
    EXPECT_LT((few.frequency - modes.frequency.head(5)).cwiseAbs().maxCoeff(), 1e-8);
}

// A rigid base keeps the mass of its own nodes: the effective masses sum to less than the total, by no more than the
// base row's share.
TEST(FeModes, rigid_base)
{
    const Model model = build_model(coarse_dam(false));
    const NaturalModes modes = natural_modes(model, model.dofs.count);
    EXPECT_LT(modes.effective_share.row(0).sum(), 1.0);
    EXPECT_GT(modes.effective_share.row(0).sum(), 0.85);
}

// Added mass on a vertical face works in x only, and rigorously through n n^T: f drops, y's total mass does not change.
TEST(FeModes, added_mass_moves_with_the_normal_of_the_face)
{
    Scene scene = coarse_dam(true);
    scene.reservoir = Reservoir{.level = 62.5};
    const Model dry = build_model(scene), wet = build_model(scene, {.added_mass = [](Point, double) { return 30e3; }});
    EXPECT_NEAR(wet.total_mass[0] - dry.total_mass[0], 30e3 * 62.5, 1e-3);
    EXPECT_NEAR(wet.total_mass[1] - dry.total_mass[1], 0.0, 1e-6);
    EXPECT_LT(natural_modes(wet, 1).frequency[0], natural_modes(dry, 1).frequency[0]);
    scene.section.polygon = {{0, 0}, {60, 0}, {30, 62.5}, {20, 62.5}}; // upstream face 20 : 62.5, phi = atan(0.32)
    double angle = 0.0;
    const Model inclined = build_model(scene, {.added_mass = [&](Point, double phi) { return angle = phi, 1000.0; }});
    EXPECT_NEAR(angle, std::atan2(20.0, 62.5), 1e-12);
    const double length = std::hypot(20.0, 62.5), cosine = 62.5 / length;
    EXPECT_NEAR(inclined.added_mass.sum(),
                1000.0 * length * (cosine * cosine + (1 - cosine * cosine) - 2 * cosine * 20.0 / length), 1e-3);
}

TEST(FeModes, same_model_same_bits)
{
    const Model model = build_model(test::reference_dam_on_rock());
    const NaturalModes one = natural_modes(model, 5), two = natural_modes(model, 5);
    EXPECT_EQ(one.frequency, two.frequency);
    EXPECT_EQ(one.shape, two.shape);
}

TEST(FeModes, a_floating_dam_and_a_massless_dam_are_reported)
{
    Scene scene = coarse_dam(false);
    EXPECT_EQ(natural_modes(build_model(scene, {.base = Base::separate}), 3).status, ModesStatus::solver_failed);
    scene.dam.density = 0.0;
    EXPECT_EQ(natural_modes(build_model(scene), 3).status, ModesStatus::no_mass);
}

} // namespace
