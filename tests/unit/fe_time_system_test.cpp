// Systems with many unknowns: the step equations themselves, low-rank damping, interface forces, massless unknowns.
#include "fe2d/time/linear_integrator.hpp"
#include "verification/cases/fe_time_models.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace damslip;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using verification::uneven_vector;

const fe2d::Scheme implicit_schemes[] = {fe2d::average_acceleration(), fe2d::newmark(0.7, 0.4), fe2d::hht(-0.05),
                                         fe2d::hht(-1.0 / 3.0)};

fe2d::LowRank some_low_rank(Index size)
{
    fe2d::LowRank low_rank;
    low_rank.columns.resize(size, 2);
    low_rank.columns << uneven_vector(size, 0.2), uneven_vector(size, 1.4);
    low_rank.core.resize(2, 2);
    low_rank.core << 3.0, -1.0, -1.0, 0.4; // indefinite would do as well; A must stay positive definite
    return low_rank;
}

fe2d::SparseMatrix sparse(const MatrixXd& dense)
{
    return dense.sparseView();
}

double relative(const VectorXd& a, const VectorXd& b)
{
    return (a - b).norm() / b.norm();
}

// (2-25) and Newmark's two assumptions put to the result of a step, with load, interface forces at both ends and
// low-rank damping, at two successive step sizes. Round-off only: forces are of order 1e3.
TEST(FeTimeSystem, every_step_satisfies_the_equations_of_the_scheme)
{
    for (const auto& scheme : implicit_schemes) {
        fe2d::LinearSystem system = verification::lattice({.mass_coefficient = 1.1, .stiffness_coefficient = 0.004});
        const Index n = system.size();
        system.damping_low_rank = some_low_rank(n);
        fe2d::LinearIntegrator integrator(system, scheme);
        fe2d::State before = integrator.start(uneven_vector(n, 0.1), uneven_vector(n, 2.0),
                                              50.0 * uneven_vector(n, 1.0), 30.0 * uneven_vector(n, 4.0)),
                    after;
        const MatrixXd damping = MatrixXd(system.damping) + system.damping_low_rank.columns *
                                                                system.damping_low_rank.core *
                                                                system.damping_low_rank.columns.transpose();
        const auto external = [&](const fe2d::State& s) {
            return VectorXd(damping * s.velocity + system.stiffness * s.displacement - s.load - s.interface_force);
        };
        EXPECT_LT((system.mass * before.acceleration + external(before)).norm(), 1e-9);
        for (double dt : {0.01, 0.04}) {
            const auto& step = integrator.step_operator(dt);
            const VectorXd load = 70.0 * uneven_vector(n, dt), interface = 20.0 * uneven_vector(n, 3.0 + dt);
            const fe2d::FreeStep free = integrator.free_step(step, before, load);
            integrator.finish_step(step, before, load, free, {interface, step.solve(interface)}, after);
            const double w = 1.0 + scheme.alpha;
            EXPECT_LT((system.mass * after.acceleration + w * external(after) - scheme.alpha * external(before)).norm(),
                      1e-9);
            const VectorXd u = before.displacement + dt * before.velocity +
                               dt * dt * ((0.5 - scheme.beta) * before.acceleration + scheme.beta * after.acceleration);
            const VectorXd v =
                before.velocity + dt * ((1.0 - scheme.gamma) * before.acceleration + scheme.gamma * after.acceleration);
            EXPECT_LT(relative(after.displacement, u), 1e-13);
            EXPECT_LT(relative(after.velocity, v), 1e-13);
            EXPECT_LT(relative(after.unbalanced, external(after)), 1e-12);
            std::swap(before, after);
        }
        EXPECT_EQ(integrator.factorisations(), 2u);
        integrator.step_operator(0.01);
        EXPECT_EQ(integrator.factorisations(), 2u);
    }
}

// A⁻¹ by Woodbury against the matrix filled in.
TEST(FeTimeSystem, low_rank_damping_equals_the_full_matrix)
{
    fe2d::LinearSystem system = verification::lattice({.stiffness_coefficient = 0.01}), filled = system;
    const Index n = system.size();
    system.damping_low_rank = some_low_rank(n);
    filled.damping += sparse(system.damping_low_rank.columns * system.damping_low_rank.core *
                             system.damping_low_rank.columns.transpose());
    const auto constants = fe2d::step_constants(fe2d::hht(-0.1), 0.02);
    const fe2d::StepOperator with_factors(system, constants), with_entries(filled, constants);
    const VectorXd load = uneven_vector(n, 0.7);
    EXPECT_LT(relative(with_factors.solve(load), with_entries.solve(load)), 1e-13);
    const fe2d::SparseMatrix map = sparse(uneven_vector(n * 20, 0.3).reshaped(20, n));
    const auto a = with_factors.flexibility(map), b = with_entries.flexibility(map);
    EXPECT_LT((a.delassus - b.delassus).norm(), 1e-13 * b.delassus.norm());
    EXPECT_LT((a.response - b.response).norm(), 1e-13 * b.response.norm());
}

/// Two lattices side by side as one system without connection, the second massless (dam and rock), and the map B whose
/// rows are the differences of `ties` unknowns: first lattice minus second.
struct Pair {
    fe2d::LinearSystem apart, tied;
    fe2d::SparseMatrix differences, embedding; ///< B; and u_apart = embedding u_tied
};

fe2d::SparseMatrix block_diagonal(const fe2d::SparseMatrix& a, const fe2d::SparseMatrix& b)
{
    MatrixXd all = MatrixXd::Zero(a.rows() + b.rows(), a.cols() + b.cols());
    all.topLeftCorner(a.rows(), a.cols()) = MatrixXd(a);
    all.bottomRightCorner(b.rows(), b.cols()) = MatrixXd(b);
    return sparse(all);
}

Pair dam_on_massless_rock()
{
    const Index ties = 4;
    const fe2d::LinearSystem dam =
        verification::lattice({.nx = 4, .ny = 5, .mass_coefficient = 0.9, .stiffness_coefficient = 0.003});
    const fe2d::LinearSystem rock =
        verification::lattice({.nx = 4, .ny = 3, .massless_rows = 3, .stiffness_coefficient = 0.003});
    const Index n_dam = dam.size(), n_rock = rock.size(), n = n_dam + n_rock;
    Pair pair;
    pair.apart.mass = block_diagonal(dam.mass, rock.mass);
    pair.apart.damping = block_diagonal(dam.damping, rock.damping);
    pair.apart.stiffness = block_diagonal(dam.stiffness, rock.stiffness);
    MatrixXd b = MatrixXd::Zero(ties, n), embedding = MatrixXd::Zero(n, n - ties);
    embedding.topLeftCorner(n - ties, n - ties).setIdentity();
    for (Index k = 0; k < ties; ++k) { // bottom row of the dam on the top row of the rock, which comes last
        b(k, k) = 1.0;
        b(k, n - ties + k) = -1.0;
        embedding(n - ties + k, k) = 1.0;
    }
    pair.differences = sparse(b);
    pair.embedding = sparse(embedding);
    const fe2d::SparseMatrix transposed = pair.embedding.transpose();
    pair.tied.mass = transposed * pair.apart.mass * pair.embedding;
    pair.tied.damping = transposed * pair.apart.damping * pair.embedding;
    pair.tied.stiffness = transposed * pair.apart.stiffness * pair.embedding;
    return pair;
}

// The hook for contact: two bodies held together by interface forces found from the Delassus operator must move as the
// tied model, with massless rock, damping, and -αBᵀλ₀ of every step. A force weighted otherwise would move the massless
// side. 200 steps of round-off against motions of order one: 1e-10.
TEST(FeTimeSystem, interface_forces_that_close_the_gap_reproduce_the_tied_model)
{
    const Pair pair = dam_on_massless_rock();
    const Index n = pair.apart.size(), n_tied = pair.tied.size();
    for (const auto& scheme : implicit_schemes) {
        fe2d::LinearIntegrator apart(pair.apart, scheme), tied(pair.tied, scheme);
        const VectorXd shape = pair.apart.mass * uneven_vector(n, 0.4);
        const auto load = [&](double t) { return VectorXd(std::sin(9.0 * t) * shape); };
        fe2d::State a0 = apart.start(VectorXd::Zero(n), VectorXd::Zero(n), load(0.0)), a1;
        fe2d::State t0 = tied.start(VectorXd::Zero(n_tied), VectorXd::Zero(n_tied),
                                    pair.embedding.transpose() * load(0.0)),
                    t1;
        const double dt = 0.02;
        const auto& step = apart.step_operator(dt);
        const auto& tied_step = tied.step_operator(dt);
        const fe2d::InterfaceFlexibility flexibility = step.flexibility(pair.differences);
        for (int k = 1; k <= 200; ++k) {
            const VectorXd load1 = load(k * dt), tied_load1 = pair.embedding.transpose() * load1;
            const fe2d::FreeStep free = apart.free_step(step, a0, load1);
            const VectorXd gap = pair.differences * (a0.displacement + free.increment);
            const VectorXd lambda = flexibility.delassus.ldlt().solve(-gap);
            apart.finish_step(step, a0, load1, free,
                              {pair.differences.transpose() * lambda, flexibility.response * lambda}, a1);
            tied.finish_step(tied_step, t0, tied_load1, tied.free_step(tied_step, t0, tied_load1), t1);
            ASSERT_LT((pair.differences * a1.displacement).norm(), 1e-11); // B u₁ = g* + Wλ₁ = 0
            ASSERT_LT((a1.displacement - pair.embedding * t1.displacement).norm(), 1e-10);
            ASSERT_LT((a1.velocity - pair.embedding * t1.velocity).norm(), 1e-9);
            std::swap(a0, a1);
            std::swap(t0, t1);
        }
        EXPECT_GT(a0.displacement.norm(), 0.01); // it did move
        EXPECT_LT(apart.massless_imbalance(a0), 1e-10);
    }
}

// M singular: the start takes accelerations from the unknowns with mass and reports a state that the others cannot
// hold.
TEST(FeTimeSystem, start_with_massless_unknowns)
{
    const fe2d::LinearSystem system = verification::lattice({.massless_rows = 2, .stiffness_coefficient = 0.01});
    const Index n = system.size();
    const fe2d::LinearIntegrator integrator(system, fe2d::hht(-0.05));
    VectorXd load = uneven_vector(n, 0.6);
    const VectorXd still = MatrixXd(system.stiffness).ldlt().solve(load);
    fe2d::State state = integrator.start(still, VectorXd::Zero(n), load);
    EXPECT_LT(state.acceleration.norm(), 1e-10); // equilibrium: nothing starts to move
    EXPECT_LT(integrator.massless_imbalance(state), 1e-12);
    state = integrator.start(still, VectorXd::Zero(n), VectorXd(load + system.mass * VectorXd::Ones(n)));
    EXPECT_TRUE(state.acceleration.head(8).isZero(0.0));
    EXPECT_LT((state.acceleration.tail(n - 8) - VectorXd::Ones(n - 8)).norm(), 1e-10);
    load[0] += 1.0;
    EXPECT_GT(integrator.massless_imbalance(integrator.start(still, VectorXd::Zero(n), load)), 0.01);
}

// In equilibrium under constant load nothing moves, over any number of steps, whatever the scheme.
TEST(FeTimeSystem, equilibrium_is_kept)
{
    const fe2d::LinearSystem system =
        verification::lattice({.massless_rows = 2, .mass_coefficient = 0.0, .stiffness_coefficient = 0.01});
    const Index n = system.size();
    const VectorXd load = uneven_vector(n, 0.6), still = MatrixXd(system.stiffness).ldlt().solve(load);
    for (const auto& scheme : implicit_schemes) {
        fe2d::LinearIntegrator integrator(system, scheme);
        fe2d::State before = integrator.start(still, VectorXd::Zero(n), load), after;
        const auto& step = integrator.step_operator(0.01);
        for (int k = 0; k < 1000; ++k) {
            integrator.finish_step(step, before, load, integrator.free_step(step, before, load), after);
            std::swap(before, after);
        }
        EXPECT_LT(relative(before.displacement, still), 1e-12);
    }
}

} // namespace
