// Elastic slip in front of Coulomb's law, and strength that changes with slip, on pairs solved by hand.
#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/run/strength.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// One pair, mu = 0.5, V = diag(2, 1), γ_e = 0.1: stick stiffness 0.5 λ_n / 0.1 = 5 λ_n.
class OnePair : public ::testing::Test {
protected:
    ContactReport solve(double normal, double shear)
    {
        const ContactReport report = law_.solve(Vector2d(normal, shear), uniform_law(1, 0.5), elastic_, solution_);
        EXPECT_TRUE(report.resolved());
        EXPECT_LT(report.residual, 1e-10);
        return report;
    }

    MatrixXd stiffness_ = Vector2d(2.0, 1.0).asDiagonal().toDenseMatrix();
    SlipTolerance law_{stiffness_, VectorXd::Constant(1, 0.1), {}};
    VectorXd elastic_ = VectorXd::Zero(1);
    ContactSolution solution_;
};
using FeSlipTolerance = OnePair;

// -0.2 + y = -5 y
TEST_F(FeSlipTolerance, a_sticking_pair_gives_way_by_its_stiffness)
{
    solve(1.0, -0.2);
    EXPECT_EQ(solution_.states[0], ContactState::stick);
    EXPECT_NEAR(elastic_[0], 0.2 / 6.0, 1e-15);
    EXPECT_NEAR(solution_.force[1], -1.0 / 6.0, 1e-15);
    EXPECT_EQ(solution_.displacement[1], 0.0);
}

// -0.8 + y = -0.5: of y = 0.3, 0.1 are elastic. Unloading by 0.3: -0.2 + y = -5 (0.1 + y). Then the pressure halves:
// -0.25 + y = -2.5 (0.05 + y), the pair gives way though its load has not changed.
TEST_F(FeSlipTolerance, slip_at_the_limit_unloading_and_falling_pressure)
{
    solve(1.0, -0.8);
    EXPECT_EQ(solution_.states[0], ContactState::slip_downstream);
    EXPECT_NEAR(elastic_[0], 0.1, 1e-15);
    EXPECT_NEAR(solution_.displacement[1], 0.2, 1e-15);
    EXPECT_NEAR(solution_.force[1], -0.5, 1e-15);

    solve(1.0, -0.2);
    EXPECT_EQ(solution_.states[0], ContactState::stick);
    EXPECT_NEAR(elastic_[0], 0.05, 1e-15);
    EXPECT_NEAR(solution_.force[1], -0.25, 1e-15);
    EXPECT_EQ(solution_.displacement[1], 0.0);

    solve(0.5, -0.25);
    EXPECT_NEAR(elastic_[0], 0.05 + 0.125 / 3.5, 1e-15);

    // upstream, from the other side of the limit: 0.9 + y = 0.25, e ends at -0.1
    const double before = elastic_[0];
    solve(0.5, 0.9);
    EXPECT_EQ(solution_.states[0], ContactState::slip_upstream);
    EXPECT_NEAR(elastic_[0], -0.1, 1e-15);
    EXPECT_NEAR(solution_.displacement[1], -0.65 + 0.1 + before, 1e-14);
}

// Tension: λ = 0, opening 1/2, and the whole gap, what was elastic included, is slip.
TEST_F(FeSlipTolerance, an_open_pair_forgets_its_elastic_slip)
{
    elastic_[0] = 0.05;
    solve(-1.0, -0.25);
    EXPECT_EQ(solution_.states[0], ContactState::open);
    EXPECT_EQ(elastic_[0], 0.0);
    EXPECT_NEAR(solution_.displacement[0], 0.5, 1e-15);
    EXPECT_NEAR(solution_.displacement[1], 0.25 + 0.05, 1e-15);
}

// Pressure rises with slip, V_nt = 0.5: -0.3 + y = -5 (1 + y/2) y, or 2.5 y² + 6 y - 0.3 = 0.
TEST(FeSlipToleranceCoupled, stiffness_follows_the_pressure_within_a_step)
{
    MatrixXd stiffness(2, 2);
    stiffness << 2.0, 0.5, 0.5, 1.0;
    SlipTolerance law(stiffness, VectorXd::Constant(1, 0.1), {});
    VectorXd elastic = VectorXd::Zero(1);
    ContactSolution solution;
    EXPECT_TRUE(law.solve(Vector2d(1.0, -0.3), uniform_law(1, 0.5), elastic, solution).resolved());
    EXPECT_NEAR(elastic[0], (-6.0 + std::sqrt(39.0)) / 5.0, 1e-12); // residual 1e-10 and a last quadratic step
}

// The constant stiffness, by hand: V_t = 1, k A = 4: -0.3 + y = -4 y, slip from 0.5 on: -0.9 + y = -0.5, 0.125 elastic.
TEST(FeElasticStick, one_pair)
{
    Contact penalty;
    penalty.enforcement = ContactEnforcement::penalty;
    penalty.tangential_stiffness = 2.0;
    JointSolver joint(Vector2d(2.0, 1.0).asDiagonal().toDenseMatrix(), VectorXd::Constant(1, 2.0), penalty);
    VectorXd elastic = VectorXd::Zero(1);
    ContactSolution solution;
    joint.solve(Vector2d(1.0, -0.3), uniform_law(1, 0.5), elastic, solution);
    EXPECT_NEAR(elastic[0], 0.06, 1e-15);
    EXPECT_NEAR(solution.displacement[1], 0.0, 1e-15);
    elastic.setZero();
    joint.solve(Vector2d(1.0, -0.9), uniform_law(1, 0.5), elastic, solution);
    EXPECT_NEAR(elastic[0], 0.125, 1e-15);
    EXPECT_NEAR(solution.displacement[1], 0.4 - 0.125, 1e-15);
    // Unloading from there, λ⁰ = -0.2: -0.2 + y = -4 (0.125 + y).
    joint.solve(Vector2d(1.0, -0.2), uniform_law(1, 0.5), elastic, solution);
    EXPECT_NEAR(elastic[0], 0.125 - 0.3 / 5.0, 1e-15);
    EXPECT_EQ(solution.displacement[1], 0.0);
}

// Twelve pairs on a random elastic base: every problem is resolved, with and without separation, and γ_e -> 0 is the
// exact law with an error of first order.
TEST(FeSlipToleranceRandom, is_resolved_and_tends_to_the_exact_law)
{
    std::mt19937 random(3);
    const auto uniform = [&random] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };
    constexpr Eigen::Index m = 12;
    for (int trial = 0; trial < 100; ++trial) {
        MatrixXd a(2 * m, 2 * m);
        for (double& x : a.reshaped()) x = uniform() * 0.3;
        const MatrixXd v = a * a.transpose() + MatrixXd::Identity(2 * m, 2 * m);
        VectorXd stuck(2 * m);
        for (double& x : stuck) x = uniform();
        stuck.head(m).array() += 0.8;
        ContactLaw law = uniform_law(m, 0.3, 0.02);
        for (const JointOpening separation : {JointOpening::allowed, JointOpening::none}) {
            law.separation = separation;
            SlipTolerance soft(v, VectorXd::Constant(m, 0.2), {});
            VectorXd elastic = VectorXd::Zero(m);
            ContactSolution solution;
            const ContactReport report = soft.solve(stuck, law, elastic, solution);
            EXPECT_TRUE(report.resolved()) << trial;
            EXPECT_LT(report.residual, 1e-9) << trial;
        }
        law.separation = JointOpening::allowed;
        ContactSolver rigid(v);
        ContactSolution exact, near;
        ASSERT_TRUE(rigid.solve(stuck, law, exact).resolved());
        SlipTolerance stiff(v, VectorXd::Constant(m, 1e-7), {});
        VectorXd elastic = VectorXd::Zero(m);
        ASSERT_TRUE(stiff.solve(stuck, law, elastic, near).resolved());
        // Gaps differ by 1e-7 at most in each of 12 pairs, forces by that times the rows of V (sums below 20).
        EXPECT_LT((near.force - exact.force).cwiseAbs().maxCoeff(), 1e-7 * 100.0) << trial;
    }
}

Plane two_pairs()
{
    Plane plane;
    plane.distance = Vector2d(0.0, 3.0);
    plane.area = Vector2d(2.0, 1.0);
    return plane;
}

ContactMemory slipped(double slip, ContactState state)
{
    ContactMemory memory(2);
    memory.slip[0] = slip;
    memory.states[0] = state;
    return memory;
}

TEST(FeStrength, cohesion_acts_on_the_area_and_is_lost_where_a_pair_slips_or_opens)
{
    Contact contact;
    contact.friction = 0.7;
    contact.cohesion = 100.0;
    contact.bond.loss = BondLoss::pairs;
    Strength strength(contact, two_pairs());
    EXPECT_EQ(strength.law().cohesion, Vector2d(200.0, 100.0));
    strength.follow(slipped(0.0, ContactState::stick));
    EXPECT_EQ(strength.law().cohesion, Vector2d(200.0, 100.0));
    strength.follow(slipped(1e-6, ContactState::slip_upstream));
    EXPECT_EQ(strength.law().cohesion, Vector2d(0.0, 100.0));
    strength.follow(slipped(1e-6, ContactState::stick)); // and does not come back
    EXPECT_EQ(strength.law().cohesion, Vector2d(0.0, 100.0));
    Strength opened(contact, two_pairs());
    opened.follow(slipped(0.0, ContactState::open));
    EXPECT_EQ(opened.law().cohesion, Vector2d(0.0, 100.0));

    contact.cohesion_lost_at_slip = false;
    Strength lasting(contact, two_pairs());
    lasting.follow(slipped(0.01, ContactState::slip_downstream));
    EXPECT_EQ(lasting.law().cohesion, Vector2d(200.0, 100.0));
}

TEST(FeStrength, cohesion_is_lost_together_when_all_closed_pairs_have_reached_their_strength)
{
    Contact contact;
    contact.friction = 0.5;
    contact.cohesion = 100.0; // 200 and 100 N/m on the pairs
    Strength strength(contact, two_pairs());
    ContactMemory memory(2);
    memory.states = {ContactState::slip_downstream, ContactState::stick};
    memory.force << 1000.0, 1000.0, -700.0, -599.0; // 700 and 600 are their strengths
    strength.follow(memory);
    EXPECT_EQ(strength.law().cohesion, Vector2d(200.0, 100.0)); // one pair at its strength is not the plane
    memory.states = {ContactState::open, ContactState::stick};
    memory.force << 0.0, 1000.0, 0.0, -500.0;
    strength.follow(memory);
    EXPECT_EQ(strength.law().cohesion, Vector2d(0.0, 100.0)); // an open pair has none while it is open
    memory.states = {ContactState::stick, ContactState::stick};
    memory.force << 1000.0, 1000.0, -600.0, -500.0;
    strength.follow(memory);
    EXPECT_EQ(strength.law().cohesion, Vector2d(200.0, 100.0));
    memory.states = {ContactState::slip_downstream, ContactState::slip_downstream};
    memory.force << 1000.0, 1000.0, -700.0, -600.0;
    strength.follow(memory);
    EXPECT_EQ(strength.law().cohesion, Vector2d(0.0, 0.0));
    memory.states = {ContactState::stick, ContactState::stick}; // and does not come back
    strength.follow(memory);
    EXPECT_EQ(strength.law().cohesion, Vector2d(0.0, 0.0));
}

TEST(FeStrength, friction_falls_with_the_slip_of_each_pair_there_and_back)
{
    Contact contact;
    contact.friction = 0.8;
    contact.residual_friction = 0.6;
    contact.residual_slip = 0.01;
    for (const Interpolation path : {Interpolation::steps, Interpolation::linear}) {
        contact.residual_path = path;
        Strength strength(contact, two_pairs());
        strength.follow(slipped(0.005, ContactState::slip_downstream));
        EXPECT_NEAR(strength.law().friction[0], path == Interpolation::linear ? 0.7 : 0.8, 1e-15);
        strength.follow(slipped(-0.001, ContactState::slip_upstream)); // 0.011 of path
        EXPECT_EQ(strength.law().friction, Vector2d(0.6, 0.8));
    }
    contact.residual_slip = 0.0;
    Strength at_once(contact, two_pairs());
    EXPECT_EQ(at_once.law().friction[0], 0.8);
    at_once.follow(slipped(1e-9, ContactState::slip_downstream));
    EXPECT_EQ(at_once.law().friction[0], 0.6);
}

TEST(FeStrength, friction_table_by_steps_or_linear)
{
    Contact contact;
    contact.friction_table = {{0.0, 0.8}, {0.01, 0.7}, {0.03, 0.5}};
    for (const Interpolation path : {Interpolation::steps, Interpolation::linear}) {
        contact.residual_path = path;
        Strength strength(contact, two_pairs());
        EXPECT_EQ(strength.law().friction[0], 0.8);
        strength.follow(slipped(0.02, ContactState::slip_downstream));
        EXPECT_NEAR(strength.law().friction[0], path == Interpolation::linear ? 0.6 : 0.7, 1e-15);
        strength.follow(slipped(0.05, ContactState::slip_downstream));
        EXPECT_EQ(strength.law().friction[0], 0.5);
    }
}

} // namespace
