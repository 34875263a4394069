// Massless rock condensed onto the unknowns it shares with the dam.
#include "fe2d/time/condensation.hpp"
#include "fe2d/time/linear_integrator.hpp"
#include "verification/cases/fe_time_models.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace {

using namespace damslip;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using verification::uneven_vector;

TEST(FeTimeCondensation, stiffness_load_and_recovery_against_the_dense_solution)
{
    const fe2d::SparseMatrix k = verification::lattice({.nx = 9, .ny = 7}).stiffness;
    std::vector<Index> kept;
    for (Index i = 0; i < 19; ++i) kept.push_back((i * 23 + 40) % k.rows()); // scattered, more than one block of 16
    const fe2d::CondensedBody body(k, kept);
    ASSERT_TRUE(body.report().ok());
    const VectorXd load = uneven_vector(k.rows(), 0.3), u = MatrixXd(k).ldlt().solve(load);
    const VectorXd u_kept = u(kept);
    EXPECT_LT((body.stiffness() * u_kept - body.condense_load(load)).norm(), 1e-11);
    EXPECT_LT((body.recover(u_kept, load) - u).norm(), 1e-12 * u.norm());
    EXPECT_TRUE(body.stiffness().isApprox(body.stiffness().transpose(), 0.0));
}

// Dam (20 unknowns with mass) on rock (lower 4 rows without mass, the uppermost of them shared), stiffness damping in
// both, dead load inside the rock, shaken: the condensed model gives the same motion to 1e-12 of its largest value, and
// the rock's inner displacements come back. Exact for any scheme and step because the inner equations are b(K v) + K u
// = f with K u = f at the start.
TEST(FeTimeCondensation, condensed_rock_moves_as_the_full_rock)
{
    const Index nx = 5, rock_rows = 4, n_rock = nx * rock_rows;
    fe2d::LinearSystem full =
        verification::lattice({.nx = nx, .ny = 8, .massless_rows = rock_rows, .stiffness_coefficient = 0.006});
    const Index n = full.size();
    const VectorXd dead_load = 3.0 * uneven_vector(n, 0.9), shaking = full.mass * VectorXd::Ones(n);
    const VectorXd still = MatrixXd(full.stiffness).ldlt().solve(dead_load);

    // Springs between lattice points belong to the rock where both ends do; the rest is the dam's.
    fe2d::SparseMatrix rock = verification::lattice({.nx = nx, .ny = rock_rows}).stiffness;
    {
        MatrixXd dense = MatrixXd(full.stiffness).topLeftCorner(n_rock, n_rock);
        for (Index i = n_rock - nx; i < n_rock; ++i)
            dense(i, i) += full.stiffness.coeff(i, i + nx); // without the spring above
        rock = dense.sparseView();
    }
    std::vector<Index> kept(nx), place(nx);
    std::iota(kept.begin(), kept.end(), n_rock - nx); // in the rock's numbering and in the full one
    std::iota(place.begin(), place.end(), 0);         // in the reduced numbering
    const fe2d::CondensedBody body(rock, kept);

    const Index n_reduced = n - n_rock + nx;
    const auto reduce = [&](const fe2d::SparseMatrix& m) {
        return fe2d::SparseMatrix(MatrixXd(MatrixXd(m).bottomRightCorner(n_reduced, n_reduced)).sparseView());
    };
    fe2d::LinearSystem reduced;
    reduced.mass = reduce(full.mass);
    fe2d::SparseMatrix padded(n, n);
    {
        MatrixXd dense = MatrixXd::Zero(n, n);
        dense.topLeftCorner(n_rock, n_rock) = MatrixXd(rock);
        padded = dense.sparseView();
    }
    reduced.stiffness = reduce(full.stiffness - padded);
    reduced.damping = 0.006 * reduced.stiffness;
    fe2d::add_dense_block(reduced.stiffness, body.stiffness(), place, 1.0);
    fe2d::add_dense_block(reduced.damping, body.stiffness(), place, 0.006);
    VectorXd reduced_dead = dead_load.tail(n_reduced);
    VectorXd rock_load = dead_load.head(n_rock);
    VectorXd inner_only = rock_load;
    inner_only.tail(nx).setZero(); // the kept part is already in reduced_dead
    reduced_dead.head(nx) += body.condense_load(inner_only);

    for (const auto& scheme : {fe2d::average_acceleration(), fe2d::hht(-0.05), fe2d::hht(-1.0 / 3.0)}) {
        fe2d::LinearIntegrator a(full, scheme), b(reduced, scheme);
        fe2d::State a0 = a.start(still, VectorXd::Zero(n), dead_load), a1;
        fe2d::State b0 = b.start(still.tail(n_reduced), VectorXd::Zero(n_reduced), reduced_dead), b1;
        const auto& step_a = a.step_operator(0.02);
        const auto& step_b = b.step_operator(0.02);
        double largest = 0.0, difference = 0.0, inner_difference = 0.0;
        for (int k = 1; k <= 500; ++k) {
            const double ground = 4.0 * std::sin(0.02 * k * (3.0 + 0.02 * k));
            const VectorXd load_a = dead_load + ground * shaking,
                           load_b = reduced_dead + ground * shaking.tail(n_reduced);
            a.finish_step(step_a, a0, load_a, a.free_step(step_a, a0, load_a), a1);
            b.finish_step(step_b, b0, load_b, b.free_step(step_b, b0, load_b), b1);
            std::swap(a0, a1);
            std::swap(b0, b1);
            largest = std::max(largest, a0.displacement.cwiseAbs().maxCoeff());
            difference =
                std::max(difference, (a0.displacement.tail(n_reduced) - b0.displacement).cwiseAbs().maxCoeff());
            const VectorXd recovered = body.recover(b0.displacement.head(nx), rock_load);
            inner_difference =
                std::max(inner_difference, (recovered - a0.displacement.head(n_rock)).cwiseAbs().maxCoeff());
        }
        EXPECT_LT(difference, 1e-12 * largest);
        EXPECT_LT(inner_difference, 1e-12 * largest);
        EXPECT_GT((a0.displacement - still).norm(), 1e-3);
    }
}

} // namespace
