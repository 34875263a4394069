// Direct solver: known solutions, statuses, counters, repeatability.
#include "fe2d/solver/linear_solver.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace {

using namespace damslip::fe2d;

/// 5-point Laplacian on n x n inner points: positive definite.
Eigen::SparseMatrix<double> laplacian(int n)
{
    std::vector<Eigen::Triplet<double>> entries;
    const auto at = [n](int i, int j) { return i * n + j; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            entries.emplace_back(at(i, j), at(i, j), 4.0);
            if (i + 1 < n)
                entries.emplace_back(at(i, j), at(i + 1, j), -1.0), entries.emplace_back(at(i + 1, j), at(i, j), -1.0);
            if (j + 1 < n)
                entries.emplace_back(at(i, j), at(i, j + 1), -1.0), entries.emplace_back(at(i, j + 1), at(i, j), -1.0);
        }
    Eigen::SparseMatrix<double> a(n * n, n * n);
    a.setFromTriplets(entries.begin(), entries.end());
    return a;
}

TEST(FeSolver, simplicial_and_supernodal_find_the_known_solution)
{
    const auto a = laplacian(30);
    const Eigen::MatrixXd x = Eigen::MatrixXd::NullaryExpr(
        900, 35, [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + double(i) + 7.0 * double(j)); });
    for (const Factorisation kind : {Factorisation::simplicial, Factorisation::supernodal}) {
        LinearSolver solver({.factorisation = kind});
        ASSERT_TRUE(solver.factorise(a).ok()) << text_of(solver.report().note());
        EXPECT_EQ(solver.report().supernodal, kind == Factorisation::supernodal);
        const Eigen::MatrixXd b = a * x; // 35 columns: two full blocks of 16 and a rest
        EXPECT_LT((solver.solve(b) - x).lpNorm<Eigen::Infinity>(), 1e-12); // condition about 400
        EXPECT_EQ((solver.solve(Eigen::VectorXd(b.col(0))) - solver.solve(b).col(0)).lpNorm<Eigen::Infinity>() < 1e-12,
                  true);
    }
}

TEST(FeSolver, says_what_it_did)
{
    LinearSolver solver;
    EXPECT_EQ(text_of(solver.report().note()), "Nothing has been factorised yet.");
    solver.factorise(laplacian(10));
    EXPECT_EQ(text_of(solver.report().note()).find("Factorised: 100 unknowns, "), 0u) << text_of(solver.report().note());
    LinearSolver moved = std::move(solver); // keeps its factor
    const auto a = laplacian(10);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(100, -1.0, 1.0);
    EXPECT_LT((moved.solve(Eigen::VectorXd(a * x)) - x).lpNorm<Eigen::Infinity>(), 1e-13);
    Eigen::SparseMatrix<double> mechanism(2, 2); // two masses on one spring
    mechanism.insert(0, 0) = mechanism.insert(1, 1) = 1.0;
    mechanism.insert(0, 1) = mechanism.insert(1, 0) = -1.0;
    moved = LinearSolver();
    moved.factorise(mechanism);
    EXPECT_NE(text_of(moved.report().note()).find("2 unknowns"), std::string::npos) << text_of(moved.report().note());
    EXPECT_EQ(text_of(moved.report().note()).find("Factorised"), std::string::npos);
}

TEST(FeSolver, counts_what_it_does)
{
    LinearSolver solver;
    const auto a = laplacian(10);
    solver.factorise(a);
    solver.factorise(2.0 * a);
    EXPECT_EQ(solver.report().analyses, 1); // same pattern: the ordering is kept
    EXPECT_EQ(solver.report().factorisations, 2);
    EXPECT_EQ(solver.report().unknowns, 100);
    EXPECT_EQ(solver.report().nonzeros_matrix, 460);
    EXPECT_GT(solver.report().nonzeros_factor, 280);
    EXPECT_GT(solver.report().bytes, 12 * solver.report().nonzeros_factor);
    solver.factorise(laplacian(11));
    EXPECT_EQ(solver.report().analyses, 2);
    EXPECT_EQ(solver.solves(), 3); // the checks
}

TEST(FeSolver, a_mechanism_is_reported_not_solved)
{
    Eigen::SparseMatrix<double> a = laplacian(10);
    for (int i = 0; i < 100; ++i) { // row sums zero: the constant vector is free
        double sum = 0.0;
        for (Eigen::SparseMatrix<double>::InnerIterator it(a, i); it; ++it) sum += it.row() == i ? 0.0 : it.value();
        a.coeffRef(i, i) = -sum;
    }
    for (const Factorisation kind : {Factorisation::simplicial, Factorisation::supernodal}) {
        LinearSolver solver({.factorisation = kind});
        const SolverStatus status = solver.factorise(a).status;
        EXPECT_TRUE(status == SolverStatus::singular || status == SolverStatus::not_positive_definite)
            << text_of(solver.report().note());
    }
    a.coeffRef(0, 0) = -4.0;
    LinearSolver solver;
    EXPECT_EQ(solver.factorise(a).status, SolverStatus::not_positive_definite);
}

// [[A, B], [B^T, -C]] with rows of very different size, as solid and fluid have: inertia (n, m) and round-off residual
// after scaling.
TEST(FeSolver, quasi_definite_with_badly_scaled_blocks)
{
    const int n = 100;
    const Eigen::MatrixXd k = Eigen::MatrixXd(laplacian(10));
    Eigen::MatrixXd full = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    full.topLeftCorner(n, n) = 1e11 * k;
    full.bottomRightCorner(n, n) = -1e-8 * k;
    for (int i = 0; i < 10; ++i) full(i, n + i) = full(n + i, i) = 0.7;
    const Eigen::SparseMatrix<double> a = full.sparseView();
    LinearSolver solver({.definiteness = Definiteness::quasi_definite});
    ASSERT_TRUE(solver.factorise(a).ok()) << text_of(solver.report().note());
    EXPECT_EQ(solver.report().negative_pivots, n);
    EXPECT_LT(solver.report().residual, 1e-13);
    LinearSolver wrong;
    EXPECT_EQ(wrong.factorise(a).status, SolverStatus::not_positive_definite);
}

TEST(FeSolver, same_matrix_same_bits)
{
    const auto a = laplacian(20);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(400, -1.0, 2.0);
    for (const Factorisation kind : {Factorisation::simplicial, Factorisation::supernodal}) {
        LinearSolver one({.factorisation = kind}), two({.factorisation = kind});
        one.factorise(a);
        two.factorise(3.0 * a);
        two.factorise(a); // an earlier matrix leaves no trace
        EXPECT_EQ(one.solve(b), two.solve(b));
    }
}

} // namespace
