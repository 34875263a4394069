// Rayleigh constants and damping of the deformation only.
#include "core/input_error.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/time/linear_integrator.hpp"
#include "verification/cases/fe_time_models.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace damslip;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double hz = 2.0 * std::numbers::pi;

// (2-56), (2-57). Table 5-5 prints 0.422 for a_M; by hand 2·0.05·2π·1.54·2.29/3.83 = 0.57855, b_K = 0.1/(2π·3.83) =
// 0.0041555.
TEST(FeDamping, rayleigh_constants_of_table_5_5_corrected)
{
    const auto c = fe2d::rayleigh_constants(0.05, 1.54 * hz, 2.29 * hz);
    EXPECT_NEAR(c.mass, 0.579, 5e-4);
    EXPECT_NEAR(c.stiffness, 0.0042, 5e-5);
    EXPECT_NEAR(c.mass, 0.57855, 5e-6);
    EXPECT_NEAR(c.stiffness, 0.0041555, 5e-8);
}

// Table 6-6 prints 0.777 for 1.54 and 6.25 Hz, 0.916 for 1.91 and 6.21 Hz, frequencies rounded to 0.01 Hz (half a percent).
TEST(FeDamping, rayleigh_constants_of_table_6_6)
{
    EXPECT_NEAR(fe2d::rayleigh_constants(0.05, 1.54 * hz, 6.25 * hz).mass, 0.777, 0.004);
    EXPECT_NEAR(fe2d::rayleigh_constants(0.05, 1.91 * hz, 6.21 * hz).mass, 0.916, 0.004);
    EXPECT_NEAR(fe2d::rayleigh_constants(0.05, 1.54 * hz, 6.25 * hz).stiffness, 0.002, 5e-4);
}

TEST(FeDamping, without_a_mode_there_is_no_damping_by_modes)
{
    EXPECT_THROW(fe2d::choose_damping(Damping{}, {}, 1.0, {}), NotConverged);
}

TEST(FeDamping, ratio_is_met_at_both_frequencies_and_lowest_at_their_geometric_mean)
{
    const double a = 3.6 * hz, b = 18.0 * hz, middle = std::sqrt(a * b);
    const auto c = fe2d::rayleigh_constants(0.05, a, b);
    EXPECT_NEAR(fe2d::damping_ratio(c, a), 0.05, 1e-16);
    EXPECT_NEAR(fe2d::damping_ratio(c, b), 0.05, 1e-16);
    EXPECT_NEAR(fe2d::damping_ratio(c, middle), 0.1 * middle / (a + b), 1e-16);
    EXPECT_GT(fe2d::damping_ratio(c, 0.5 * a), 0.05);
    EXPECT_GT(fe2d::damping_ratio(c, 2.0 * b), 0.05);
    const auto single = fe2d::rayleigh_constants(0.05, a, a); // limit: a_M = ζω, b_K = ζ/ω
    EXPECT_NEAR(single.mass, 0.05 * a, 1e-14);
    EXPECT_NEAR(single.stiffness, 0.05 / a, 1e-16);
}

/// A dam (4 x 6 lattice, all unknowns horizontal) over a massless rock (4 x 3); unknowns of the dam first. The lowest
/// dam row stands on the highest rock row.
struct DamOverRock {
    fe2d::SparseMatrix mass, stiffness; ///< not connected
    VectorXd rigid, weights;            ///< r and w
    MatrixXd tied;                      ///< columns: motions with a tied base
};

DamOverRock dam_over_rock()
{
    const Index base = 4, n_dam = 24, n_rock = 12, n = n_dam + n_rock;
    const auto dam = verification::lattice({.nx = base, .ny = 6}), rock = verification::lattice({.nx = base, .ny = 3});
    MatrixXd mass = MatrixXd::Zero(n, n), stiffness = MatrixXd::Zero(n, n);
    mass.topLeftCorner(n_dam, n_dam) = MatrixXd(dam.mass);
    stiffness.topLeftCorner(n_dam, n_dam) = MatrixXd(dam.stiffness);
    for (Index k = 0; k < base; ++k) { // the lattice's springs to the ground would hold a dam that must float
        double row = 0.0;
        for (Index j = 0; j < n_dam; ++j) row += j == k ? 0.0 : stiffness(k, j);
        stiffness(k, k) = -row;
    }
    stiffness.bottomRightCorner(n_rock, n_rock) = MatrixXd(rock.stiffness);
    DamOverRock model;
    model.mass = mass.sparseView();
    model.stiffness = stiffness.sparseView();
    model.rigid = VectorXd::Zero(n);
    model.rigid.head(n_dam).setOnes();
    model.weights = VectorXd::Zero(n);
    const double areas[] = {0.125, 0.25, 0.375, 0.25}; // uneven shares of the base, sum 1
    model.tied = MatrixXd::Zero(n, n - base);
    model.tied.topLeftCorner(n - base, n - base).setIdentity();
    for (Index k = 0; k < base; ++k) {
        model.weights[k] = areas[k];
        model.weights[n - base + k] = -areas[k];
        model.tied(n - base + k, k) = 1.0;
    }
    return model;
}

MatrixXd dense(const fe2d::LowRank& c)
{
    return c.columns * c.core * c.columns.transpose();
}

// C_M = a_M (I - r wᵀ)ᵀ M (I - r wᵀ), multiplied out entry by entry; positive semi-definite by its form.
TEST(FeDamping, deformation_only_is_the_projected_mass)
{
    const DamOverRock model = dam_over_rock();
    const Index n = model.mass.rows();
    const MatrixXd c = 1.7 * MatrixXd(model.mass) +
                       dense(fe2d::deformation_only_correction(1.7, model.mass, model.rigid, model.weights));
    const MatrixXd projector = MatrixXd::Identity(n, n) - model.rigid * model.weights.transpose();
    EXPECT_LT((c - 1.7 * projector.transpose() * MatrixXd(model.mass) * projector).norm(), 1e-13 * c.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(c).eigenvalues().minCoeff(), -1e-13 * c.norm());
}

TEST(FeDamping, uniform_slip_feels_no_deformation_only_damping)
{
    const DamOverRock model = dam_over_rock();
    VectorXd force = 1.7 * (model.mass * model.rigid);
    const double undiminished = force.norm();
    fe2d::deformation_only_correction(1.7, model.mass, model.rigid, model.weights).add_product(model.rigid, 1.0, force);
    EXPECT_LT(force.norm(), 1e-14 * undiminished);
}

// Tied base: wᵀu̇ = 0, so C_M acts as a_M M: Rayleigh constants on modes 1 and 5 give exactly 5 % in both, and every
// other mode what damping_ratio says.
TEST(FeDamping, tied_modes_keep_their_damping)
{
    const DamOverRock model = dam_over_rock();
    const MatrixXd m = model.tied.transpose() * MatrixXd(model.mass) * model.tied;
    const MatrixXd k = model.tied.transpose() * MatrixXd(model.stiffness) * model.tied;
    // The rock has no mass: the inverse problem, K⁻¹M; its 24 largest eigenvalues are the modes.
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(m, k);
    const auto frequency = [&](Index mode) { return 1.0 / std::sqrt(modes.eigenvalues()[m.rows() - 1 - mode]); };
    const auto constants = fe2d::rayleigh_constants(0.05, frequency(0), frequency(4));
    const MatrixXd full =
        constants.mass * MatrixXd(model.mass) + constants.stiffness * MatrixXd(model.stiffness) +
        dense(fe2d::deformation_only_correction(constants.mass, model.mass, model.rigid, model.weights));
    const MatrixXd c = model.tied.transpose() * full * model.tied;
    for (Index mode = 0; mode < 10; ++mode) {
        const VectorXd shape = modes.eigenvectors().col(m.rows() - 1 - mode);
        const double ratio = shape.dot(c * shape) / (2.0 * frequency(mode) * shape.dot(m * shape));
        EXPECT_NEAR(ratio, fe2d::damping_ratio(constants, frequency(mode)), 1e-12);
        if (mode == 0 || mode == 4) {
            EXPECT_NEAR(ratio, 0.05, 1e-12);
        }
    }
}

// The dam let go, pushed and left to itself: with deformation-only damping it slides on at its speed, with a_M M it is
// braked as e^{-a_M t}. 200 steps of Δt = 0.01 s, a_M = 1.7: e^-3.4 = 0.033 (average acceleration:
// (1-a_MΔt/2)/(1+a_MΔt/2) per step).
TEST(FeDamping, a_sliding_dam_is_braked_by_the_ordinary_damping_only)
{
    const DamOverRock model = dam_over_rock();
    fe2d::LinearSystem system{model.mass, 1.7 * model.mass, model.stiffness, {}};
    for (bool deformation_only : {false, true}) {
        if (deformation_only)
            system.damping_low_rank = fe2d::deformation_only_correction(1.7, model.mass, model.rigid, model.weights);
        fe2d::LinearIntegrator integrator(system, fe2d::average_acceleration());
        const VectorXd none = VectorXd::Zero(system.size());
        fe2d::State before = integrator.start(none, model.rigid, none), after;
        const auto& step = integrator.step_operator(0.01);
        for (int n = 0; n < 200; ++n) {
            integrator.finish_step(step, before, none, integrator.free_step(step, before, none), after);
            std::swap(before, after);
        }
        const double expected = deformation_only ? 1.0 : std::pow((1.0 - 0.0085) / (1.0 + 0.0085), 200);
        EXPECT_LT((before.velocity - expected * model.rigid).norm(), 1e-10);
    }
}

} // namespace
