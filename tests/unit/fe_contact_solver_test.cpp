// Contact as a small dense problem: Newton on the states against Lemke's method and hand-solved cases.
#include "fe2d/contact/contact_solver.hpp"
#include "fe2d/contact/contact_problem.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using damslip::JointOpening;
using namespace damslip::fe2d;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Symmetric positive definite W = soft part of low rank (a body that moves as a whole) + elastic part with decaying
/// neighbours. `stiffness_ratio` >> 1: nearly rigid.
MatrixXd interface_flexibility(Index pairs, double stiffness_ratio, std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    MatrixXd rigid = MatrixXd::Zero(2 * pairs, 3), elastic(2 * pairs, 2 * pairs);
    for (Index i = 0; i < pairs; ++i) {
        const double x = pairs > 1 ? 2.0 * static_cast<double>(i) / static_cast<double>(pairs - 1) - 1.0 : 0.0;
        rigid(i, 0) = 1.0;
        rigid(i, 1) = x;
        rigid(pairs + i, 1) = 0.4;
        rigid(pairs + i, 2) = 1.0;
    }
    for (Index i = 0; i < 2 * pairs; ++i)
        for (Index j = 0; j < 2 * pairs; ++j)
            elastic(i, j) = uniform(random) * std::exp(-0.3 * std::abs(static_cast<double>(i - j)));
    const MatrixXd e = elastic * elastic.transpose() + 0.05 * MatrixXd::Identity(2 * pairs, 2 * pairs);
    return rigid * rigid.transpose() + e / stiffness_ratio;
}

double difference(const VectorXd& a, const VectorXd& b)
{
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

// One pair on springs: all states by hand. V = diag(2, 1), mu = 0.5: λ⁰ decides.
TEST(FeContactSolver, one_pair_in_each_state_by_hand)
{
    const ContactLaw law = uniform_law(1, 0.5);
    ContactSolver solver(Eigen::Vector2d(2.0, 1.0).asDiagonal().toDenseMatrix());
    ContactSolution s;
    // stuck: |0.4| < 0.5 * 1
    EXPECT_EQ(solver.solve(Eigen::Vector2d(1.0, -0.4), law, s).path, ContactPath::newton);
    EXPECT_EQ(s.states[0], ContactState::stick);
    EXPECT_EQ(s.displacement, VectorXd::Zero(2));
    // pushed downstream: the ground must give -0.8, friction gives -0.5: slip 0.3 downstream
    solver.solve(Eigen::Vector2d(1.0, -0.8), law, s);
    EXPECT_EQ(s.states[0], ContactState::slip_downstream);
    EXPECT_NEAR(s.displacement[1], 0.3, 1e-15);
    EXPECT_NEAR(s.force[1], -0.5, 1e-15);
    // the other way
    solver.solve(Eigen::Vector2d(1.0, 0.8), law, s);
    EXPECT_EQ(s.states[0], ContactState::slip_upstream);
    EXPECT_NEAR(s.displacement[1], -0.3, 1e-15);
    // tension opens: x = -V⁻¹ λ⁰
    solver.solve(Eigen::Vector2d(-1.0, 0.8), law, s);
    EXPECT_EQ(s.states[0], ContactState::open);
    EXPECT_NEAR(s.displacement[0], 0.5, 1e-15);
    EXPECT_NEAR(s.displacement[1], -0.8, 1e-15);
    // without separation it stays shut and carries no shear
    ContactLaw glued = law;
    glued.separation = JointOpening::none;
    solver.solve(Eigen::Vector2d(-1.0, 0.8), glued, s);
    EXPECT_EQ(s.states[0], ContactState::pulled);
    EXPECT_EQ(s.displacement[0], 0.0);
    EXPECT_NEAR(s.force[1], 0.0, 1e-15);
    EXPECT_NEAR(s.force[0], -1.0, 1e-15);
    // cohesion: strength 0.5 + 0.2
    ContactLaw cohesive = uniform_law(1, 0.5, 0.2);
    solver.solve(Eigen::Vector2d(1.0, -0.8), cohesive, s);
    EXPECT_NEAR(s.displacement[1], 0.1, 1e-15);
}

// Warm-started sequences of random load on random structures, soft to nearly rigid. Each result satisfies the contact
// conditions, and Lemke's method on the complementarity form finds the same forces. Where mu is moderate the solution
// is unique, so the two must agree to round-off times the condition of V (stiffness ratio 1e4: 1e-16 * 1e6).
TEST(FeContactSolver, sequences_agree_with_lemke)
{
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    int solved = 0, beyond_newton = 0;
    for (const double ratio : {1.0, 30.0, 1e4})
        for (const Index m : {1, 2, 5, 12}) {
            const MatrixXd w = interface_flexibility(m, ratio, random), v = w.inverse();
            const MatrixXd stiffness = 0.5 * (v + v.transpose());
            const ContactLaw law = uniform_law(m, 0.6);
            ContactSolver solver(stiffness);
            ContactSolution s;
            VectorXd free = VectorXd::Zero(2 * m);
            for (int step = 0; step < 40; ++step) {
                for (Index i = 0; i < 2 * m; ++i) free[i] = 0.7 * free[i] + 0.5 * normal(random) - (i < m ? 0.25 : 0.0);
                const VectorXd stuck = -stiffness * free;
                const ContactReport report = solver.solve(stuck, law, s);
                ASSERT_TRUE(report.resolved());
                EXPECT_LT(report.residual, 1e-9) << "m " << m << " ratio " << ratio << " step " << step;
                beyond_newton += report.path != ContactPath::newton;
                ContactSolution check;
                check.states.resize(static_cast<std::size_t>(m));
                int pivots = 0;
                const ContactProblem problem{stiffness, stuck, law};
                if (!solve_by_lemke(problem, check, pivots)) continue;
                ++solved;
                EXPECT_LT((s.force - check.force).cwiseAbs().maxCoeff(), 1e-8 * stuck.cwiseAbs().maxCoeff())
                    << "m " << m << " ratio " << ratio << " step " << step;
            }
        }
    EXPECT_EQ(solved, 480);
    EXPECT_GT(beyond_newton, 0); // the safeguards have been needed
}

// Gauss-Seidel alone, enough sweeps, ends at the same place (well-conditioned V: geometric convergence).
TEST(FeContactSolver, gauss_seidel_alone_converges)
{
    std::mt19937 random(3);
    const Index m = 6;
    const MatrixXd w = interface_flexibility(m, 1.0, random), v = w.inverse();
    const MatrixXd stiffness = 0.5 * (v + v.transpose());
    const ContactLaw law = uniform_law(m, 0.5);
    VectorXd free(2 * m);
    for (Index i = 0; i < 2 * m; ++i) free[i] = i < m ? -0.3 + 0.15 * static_cast<double>(i) : 0.4;
    const VectorXd stuck = -stiffness * free;
    ContactSolver solver(stiffness);
    ContactSolution newton, sweeps;
    ASSERT_TRUE(solver.solve(stuck, law, newton).resolved());
    sweeps.states.assign(static_cast<std::size_t>(m), ContactState::stick);
    sweeps.displacement = VectorXd::Zero(2 * m);
    const double scale = stuck.cwiseAbs().maxCoeff();
    gauss_seidel({stiffness, stuck, law}, sweeps, 20000, 1e-15 * scale);
    EXPECT_LT((sweeps.force - newton.force).cwiseAbs().maxCoeff(), 1e-10 * scale);
}

// A kept base with its borders is, after many single changes, as good as a new one.
TEST(FeContactSolver, borders_of_the_base_do_not_drift)
{
    std::mt19937 random(11);
    std::uniform_int_distribution<int> any(0, 3), which(0, 19);
    const Index m = 20;
    const MatrixXd v = interface_flexibility(m, 50.0, random).inverse(), stiffness = 0.5 * (v + v.transpose());
    const ContactLaw law = uniform_law(m, 0.7);
    const VectorXd stuck = VectorXd::LinSpaced(2 * m, -1.0, 2.0);
    ReleasedSystem kept(stiffness);
    ContactSolution s;
    s.states.assign(static_cast<std::size_t>(m), ContactState::stick);
    for (int k = 0; k < 150; ++k) {
        s.states[static_cast<std::size_t>(which(random))] = static_cast<ContactState>(any(random));
        ASSERT_TRUE(kept.set(s.states, law));
        ASSERT_TRUE(kept.solve(law, stuck, s));
    }
    EXPECT_GT(kept.updates(), 90);
    ReleasedSystem fresh(stiffness);
    ContactSolution other = s;
    ASSERT_TRUE(fresh.set(other.states, law) && fresh.solve(law, stuck, other));
    EXPECT_LT(difference(s.displacement, other.displacement), 1e-11);
}

// The owner of V changes its diagonal between solutions: what was factorised before follows it.
TEST(FeContactSolver, a_changed_diagonal_is_followed)
{
    std::mt19937 random(12);
    std::uniform_int_distribution<int> any(0, 3), which(0, 29);
    std::uniform_real_distribution<double> factor(1.0, 1.5);
    const Index m = 30;
    const MatrixXd v = interface_flexibility(m, 50.0, random).inverse();
    MatrixXd stiffness = 0.5 * (v + v.transpose());
    const ContactLaw law = uniform_law(m, 0.7);
    const VectorXd stuck = VectorXd::LinSpaced(2 * m, -1.0, 2.0);
    ReleasedSystem kept(stiffness);
    ContactSolution s;
    s.states.assign(static_cast<std::size_t>(m), ContactState::slip_downstream);
    ASSERT_TRUE(kept.set(s.states, law)); // a base that all later sets border
    for (int k = 0; k < 60; ++k) {
        const Index pair = which(random);
        s.states[static_cast<std::size_t>(pair)] = static_cast<ContactState>(any(random));
        for (const Index unknown : {pair, static_cast<Index>(which(random)) + m}) {
            stiffness(unknown, unknown) *= factor(random);
            kept.row_changed(unknown);
        }
        ASSERT_TRUE(kept.set(s.states, law) && kept.solve(law, stuck, s));
        ReleasedSystem fresh(stiffness);
        ContactSolution other = s;
        ASSERT_TRUE(fresh.set(other.states, law) && fresh.solve(law, stuck, other));
        EXPECT_LT(difference(s.displacement, other.displacement), 1e-11) << k;
    }
    EXPECT_LT(kept.rebuilds(), 60);
}

// A structure with a rigid mode: all stuck is fine, all slipping is a mechanism, and says so.
TEST(FeContactSolver, a_mechanism_is_reported)
{
    const Index m = 3;
    MatrixXd stiffness = MatrixXd::Zero(2 * m, 2 * m);
    stiffness.topLeftCorner(m, m).setIdentity();
    stiffness.bottomRightCorner(m, m) << 1, -1, 0, -1, 2, -1, 0, -1, 1; // chain of springs, free to move along
    ContactSolver solver(stiffness);
    ContactSolution s;
    VectorXd stuck(2 * m);
    stuck << 1, 1, 1, -0.2, -0.4, -0.1; // sum of shear 0.7 < mu 3 with mu 0.3: one pair slips, the others hold
    EXPECT_TRUE(solver.solve(stuck, uniform_law(m, 0.3), s).resolved());
    EXPECT_LT(complementarity_residual({stiffness, stuck, uniform_law(m, 0.3)}, s), 1e-14);
    const ContactReport report = solver.solve(stuck, uniform_law(m, 0.2), s); // 0.7 > 0.6
    EXPECT_FALSE(report.resolved());
    EXPECT_TRUE(report.mechanism);
}

// A pair pulled apart, or one that is pulled and may not part, carries no shear whatever its cohesion: λ⁰ = (-2, 1) with
// V = diag(4, 1) opens by 0.5 and slips by -1. That is the solution, so nothing of the contact conditions is violated.
TEST(FeContactSolver, cohesion_does_not_count_where_the_joint_has_parted)
{
    const MatrixXd stiffness = Eigen::Vector2d(4.0, 1.0).asDiagonal().toDenseMatrix();
    const VectorXd stuck = Eigen::Vector2d(-2.0, 1.0);
    for (const JointOpening separation : {JointOpening::allowed, JointOpening::none}) {
        ContactLaw law = uniform_law(1, 0.5, 10.0);
        law.separation = separation;
        ContactSolver solver(stiffness);
        ContactSolution s;
        const ContactReport report = solver.solve(stuck, law, s);
        EXPECT_TRUE(report.resolved());
        EXPECT_EQ(s.force[1], 0.0);
        EXPECT_NEAR(s.displacement[1], -1.0, 1e-15);
        EXPECT_LT(report.residual, 1e-14);
        // With shear left on it, it is one.
        s.force[1] = 1.0;
        EXPECT_NEAR(complementarity_residual({stiffness, stuck, law}, s), 1.0, 1e-14);
    }
}

} // namespace
