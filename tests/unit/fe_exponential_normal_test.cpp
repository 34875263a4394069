// Soft exponential normal contact: the law, pairs solved by hand, and its limits.
#include "fe2d/contact/joint_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double p0 = 1e6, c0 = 1e-3;
const double at_half = p0 / (std::numbers::e - 1.0) * 0.5 * (std::sqrt(std::numbers::e) - 1.0); // p(c0/2)

// Values by hand, and at the penetration limit the tangent takes over without a step.
TEST(FeExponentialPressure, has_its_two_points_and_nothing_overflows)
{
    const ExponentialPressure law(p0, c0);
    EXPECT_NEAR(law.pressure(0.0), p0, 1e-15 * p0);
    EXPECT_EQ(law.pressure(c0), 0.0);
    EXPECT_EQ(law.stiffness(c0), 0.0);
    EXPECT_EQ(law.energy(c0), 0.0);
    EXPECT_EQ(law.pressure(1.0), 0.0);
    EXPECT_NEAR(law.pressure(0.5 * c0), at_half, 1e-15 * p0);
    // -p'(0) = p0/((e-1) c0) (2e - 1);  w(0) = p0 c0/(e-1) ∫ z (exp z - 1) dz over 0 ... 1, the integral being 1/2
    EXPECT_NEAR(law.stiffness(0.0), p0 / c0 * (2.0 * std::numbers::e - 1.0) / (std::numbers::e - 1.0),
                1e-15 * p0 / c0 * 8);
    EXPECT_NEAR(law.energy(0.0), 0.5 * p0 * c0 / (std::numbers::e - 1.0), 1e-15 * p0 * c0);
    const double limit = c0 * (1.0 - ExponentialPressure::deepest);
    EXPECT_NEAR(law.pressure(limit * (1.0 + 1e-12)) / law.pressure(limit), 1.0, 1e-9);
    EXPECT_EQ(law.stiffness(2.0 * limit), law.stiffness(limit));
    EXPECT_TRUE(std::isfinite(law.pressure(-1e6)) && std::isfinite(law.energy(-1e6)));
}

// Central differences over 2h, relative error h²/6 of the third derivative over the first. Near z = 0 w ~ z³/3 and
// p ~ z² + z³/2, so (h/c0)²/(3 z²) and (h/c0)²/(4 z); from z = 1 on the exponential, (h/c0)²/6 (1 + 3/z) at most.
TEST(FeExponentialPressure, stiffness_and_energy_are_derivative_and_integral)
{
    const ExponentialPressure law(p0, c0);
    const double h = 1e-4 * c0;
    for (const double z : {0.01, 0.3, 0.49, 0.51, 1.0, 3.0, 20.0, 50.0}) {
        const double g = c0 * (1.0 - z);
        const double slope = (law.pressure(g + h) - law.pressure(g - h)) / (2.0 * h);
        const double work = (law.energy(g + h) - law.energy(g - h)) / (2.0 * h);
        EXPECT_NEAR(-slope / law.stiffness(g), 1.0, 1e-8 * (0.3 / z + 1.0)) << z;
        EXPECT_NEAR(-work / law.pressure(g), 1.0, 1e-8 * (0.4 / (z * z) + 1.0)) << z;
    }
}

TEST(FeExponentialPressure, clearance_is_the_inverse)
{
    const ExponentialPressure law(p0, c0);
    for (const double z : {1e-9, 1e-4, 0.3, 0.9, 1.0, 1.1, 5.0, 39.0, 40.0, 60.0}) {
        const double g = c0 * (1.0 - z);
        EXPECT_NEAR(law.clearance(law.pressure(g)), g, 1e-14 * c0 * (1.0 + z)) << z;
    }
}

struct Pair {
    ContactSolution solution;
    ContactReport report;
};

Pair one_pair(const MatrixXd& stiffness, const Vector2d& stuck, double area, ContactSolution start = {})
{
    const ExponentialNormal law(stiffness, VectorXd::Constant(1, area), {p0, c0}, {});
    Pair p{std::move(start), {}};
    p.report = law.solve(stuck, uniform_law(1, 0.5), p.solution);
    EXPECT_TRUE(p.report.resolved());
    EXPECT_LT(p.report.residual, 1e-11);
    return p;
}

// A weight on the bed, nothing else holds it (V_n = 0): p(g) = W/A, whatever the start.
TEST(FeExponentialNormal, a_weight_rests_at_its_clearance)
{
    const MatrixXd free = Vector2d(0.0, 1e9).asDiagonal().toDenseMatrix();
    for (const double area : {1.0, 0.2}) {
        EXPECT_NEAR(one_pair(free, Vector2d(p0 * area, 0.0), area).solution.displacement[0], 0.0, 1e-14 * c0);
        EXPECT_NEAR(one_pair(free, Vector2d(at_half * area, 0.0), area).solution.displacement[0], 0.5 * c0, 1e-12 * c0);
    }
    // 1e6 times the pressure at zero clearance: z (exp z - 1) = 1e6 (e - 1). And from there back.
    const Pair deep = one_pair(free, Vector2d(1e12, 0.0), 1.0);
    const double z = 1.0 - deep.solution.displacement[0] / c0;
    EXPECT_NEAR(z * std::expm1(z) / (1e6 * (std::numbers::e - 1.0)), 1.0, 1e-10);
    EXPECT_LE(deep.report.iterations, 12);
    const Pair back = one_pair(free, Vector2d(at_half, 0.0), 1.0, deep.solution);
    EXPECT_NEAR(back.solution.displacement[0], 0.5 * c0, 1e-12 * c0);
    EXPECT_LE(back.report.iterations, 20); // from the deep end about one step per unit of z
}

// On a spring V: λ⁰ + V g = p(g). Open where λ⁰ < -V c0: then g = -λ⁰/V and no shear.
TEST(FeExponentialNormal, a_pair_on_a_spring_presses_or_opens)
{
    const double v = 1e9;
    const MatrixXd spring = Vector2d(v, 1e9).asDiagonal().toDenseMatrix();
    const Pair shut = one_pair(spring, Vector2d(at_half - v * 0.5 * c0, 0.0), 1.0);
    EXPECT_NEAR(shut.solution.displacement[0], 0.5 * c0, 1e-12 * c0);
    EXPECT_NEAR(shut.solution.force[0], at_half, 1e-11 * p0);
    const Pair open = one_pair(spring, Vector2d(-2.0 * v * c0, 3e5), 1.0, shut.solution);
    EXPECT_EQ(open.solution.states[0], ContactState::open);
    EXPECT_NEAR(open.solution.displacement[0], 2.0 * c0, 1e-15);
    EXPECT_EQ(open.solution.force[0], 0.0);
    EXPECT_NEAR(open.solution.displacement[1], -3e-4, 1e-15);
    const Pair again = one_pair(spring, Vector2d(at_half - v * 0.5 * c0, 0.0), 1.0, open.solution);
    EXPECT_NEAR(again.solution.displacement[0], 0.5 * c0, 1e-12 * c0);
}

// mu = 0.5: shear below 0.5 p sticks with no slip at all, above it slips: λ⁰_t + V_t s = -0.5 p.
TEST(FeExponentialNormal, friction_is_that_of_the_present_pressure)
{
    const MatrixXd free = Vector2d(0.0, 1e9).asDiagonal().toDenseMatrix();
    const Pair stick = one_pair(free, Vector2d(p0, -0.49 * p0), 1.0);
    EXPECT_EQ(stick.solution.states[0], ContactState::stick);
    EXPECT_EQ(stick.solution.displacement[1], 0.0);
    const Pair slip = one_pair(free, Vector2d(p0, -0.6 * p0), 1.0);
    EXPECT_EQ(slip.solution.states[0], ContactState::slip_downstream);
    EXPECT_NEAR(slip.solution.displacement[1], 0.1 * p0 / 1e9, 1e-15);
    EXPECT_NEAR(slip.solution.force[1], -0.5 * p0, 1e-9 * p0);
}

struct RandomBase {
    MatrixXd stiffness;
    VectorXd stuck;
};

/// Twelve pairs on a random elastic base, all lengths of order 1.
RandomBase random_base(std::mt19937& random)
{
    const auto uniform = [&random] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };
    constexpr Index m = 12;
    MatrixXd a(2 * m, 2 * m);
    for (double& x : a.reshaped()) x = uniform() * 0.3;
    RandomBase base{a * a.transpose() + MatrixXd::Identity(2 * m, 2 * m), VectorXd(2 * m)};
    for (double& x : base.stuck) x = uniform();
    base.stuck.head(m).array() += 0.3;
    return base;
}

// Every problem is resolved to round-off, from nothing and from the solution of another; and c0 -> 0 is hard contact,
// with an error of first order: gaps differ by c0 (1 + ln p/p0) at most in each of 12 pairs, forces by that times the
// rows of V (sums below 20).
TEST(FeExponentialNormalRandom, is_resolved_and_tends_to_hard_contact)
{
    std::mt19937 random(7);
    constexpr Index m = 12;
    int newton = 0, runs = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const RandomBase base = random_base(random);
        const ContactLaw law = uniform_law(m, 0.5);
        ContactSolver rigid(base.stiffness);
        ContactSolution exact;
        ASSERT_TRUE(rigid.solve(base.stuck, law, exact).resolved());
        ContactSolution last;
        for (const double range : {1.0, 1e-2, 1e-4, 1e-6}) {
            Contact exponential;
            exponential.normal = NormalContact::exponential;
            exponential.pressure_at_zero_clearance = 0.3;
            exponential.clearance_at_zero_pressure = range;
            JointSolver soft(base.stiffness, VectorXd::Ones(m), exponential);
            VectorXd elastic = VectorXd::Zero(m);
            const ContactReport report = soft.solve(base.stuck, law, elastic, last);
            EXPECT_TRUE(report.resolved()) << trial << ", c0 = " << range;
            EXPECT_LT(report.residual, 1e-11) << trial << ", c0 = " << range;
            EXPECT_GE(last.force.head(m).minCoeff(), 0.0);
            newton += report.path == ContactPath::newton;
            ++runs;
            if (range < 1e-3) {
                EXPECT_LT((last.force - exact.force).cwiseAbs().maxCoeff(), range * 400.0) << trial;
            }
        }
    }
    std::printf("Newton alone: %d of %d\n", newton, runs);
}

// Much friction on a base that is loose but for the coupling of its pairs.
TEST(FeExponentialNormalRandom, much_friction_on_a_loose_base_is_resolved)
{
    std::mt19937 random(11);
    constexpr Index m = 12;
    int newton = 0, held = 0;
    for (int trial = 0; trial < 400; ++trial) {
        RandomBase base = random_base(random);
        base.stiffness.diagonal().array() -= 0.98;
        Contact exponential;
        exponential.normal = NormalContact::exponential;
        exponential.pressure_at_zero_clearance = 0.3;
        exponential.clearance_at_zero_pressure = 0.05;
        JointSolver soft(base.stiffness, VectorXd::Ones(m), exponential);
        VectorXd elastic = VectorXd::Zero(m);
        ContactSolution solution;
        const ContactReport report = soft.solve(base.stuck, uniform_law(m, 0.9), elastic, solution);
        newton += report.path == ContactPath::newton;
        held += report.path == ContactPath::gauss_seidel;
        EXPECT_TRUE(report.resolved()) << trial << ", residual " << report.residual;
    }
    std::printf("Newton alone: %d, tangents held: %d of 400\n", newton, held);
}

// The constant stiffness in front of Coulomb's law and the soft pressure together, by hand: V_t = 1, k A = 4:
// -0.3 + y = -4 y; across nothing holds but the law, p(g) A = 2 with p0 = 1, A = 2.
TEST(FeExponentialNormal, gives_way_along_the_plane_too)
{
    Contact law;
    law.enforcement = ContactEnforcement::penalty;
    law.tangential_stiffness = 2.0;
    law.normal = NormalContact::exponential;
    law.pressure_at_zero_clearance = 1.0;
    law.clearance_at_zero_pressure = 0.1;
    JointSolver joint(Vector2d(0.0, 1.0).asDiagonal().toDenseMatrix(), VectorXd::Constant(1, 2.0), law);
    VectorXd elastic = VectorXd::Zero(1);
    ContactSolution solution;
    ASSERT_TRUE(joint.solve(Vector2d(2.0, -0.3), uniform_law(1, 0.5), elastic, solution).resolved());
    EXPECT_NEAR(elastic[0], 0.06, 1e-15);
    EXPECT_NEAR(solution.displacement[0], 0.0, 1e-12);
    EXPECT_NEAR(stored_energy(law, VectorXd::Constant(1, 2.0), VectorXd::Zero(1)),
                2.0 * 0.1 * 0.5 / (std::numbers::e - 1.0), 1e-16);
}

} // namespace
