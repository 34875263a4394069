#include "fe2d/rock/reduced_rock.hpp"
#include "rock_scenes.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <random>

namespace damslip::rock_tests {

using namespace fe2d;

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct SmallRock {
    WaveBoxInput input = small_box();
    WaveBox box = make_wave_box(input);
    ReducedRock rock = reduce_rock(input, box);
    double step = 0.1 * std::numbers::pi / input.highest_frequency; ///< 20 in a wave of the highest frequency [s]
};

const SmallRock& small_rock()
{
    static const SmallRock rock;
    return rock;
}

/// Work of the forces, as RockEnergy has it.
struct Work {
    double alpha;
    VectorXd before, before2;
    double sum = 0.0;

    void add(const VectorXd& force, const VectorXd& step)
    {
        sum += 0.5 * step.dot(force + before) + 0.5 * alpha * step.dot(force - before2);
        before2 = before;
        before = force;
    }
};

} // namespace

// Test 7 of the contract: whatever forces act, from rest the rock gives back no more than it got, and its energy closes.
TEST(RockMotion, IsPassiveAndItsEnergyCloses)
{
    const SmallRock& small = small_rock();
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (const Scheme& scheme : {average_acceleration(), hht(-0.05), hht(-0.3), newmark(0.6, 0.3025)})
        for (const double b_k : {0.0, 0.02}) {
            const RockStep whole(small.rock, b_k, step_constants(scheme, small.step)),
                half(small.rock, b_k, step_constants(scheme, 0.5 * small.step));
            RockMotion motion(small.rock);
            const Index n = small.rock.interface();
            Work work{scheme.alpha, VectorXd::Zero(n), VectorXd::Zero(n)};
            double lowest = 0.0, largest = 0.0, plain = 0.0;
            VectorXd force = VectorXd::Zero(n);
            for (int k = 0; k < 1000; ++k) {
                const RockStep& step = k % 7 == 3 ? half : whole;
                VectorXd next = VectorXd::Zero(n);
                if (k < 200)
                    for (double& value : next) value = normal(random);
                motion.begin(whole); // asked for, given up, made with another step
                motion.begin(step);
                motion.finish((1.0 + scheme.alpha) * next - scheme.alpha * force);
                plain += 0.5 * motion.step().dot(next + force);
                work.add(next, motion.step());
                force = next;
                const RockEnergy& e = motion.energy();
                lowest = std::min(lowest, plain);
                largest = std::max(largest, e.kinetic + e.strain + e.radiated + e.damping);
                EXPECT_NEAR(e.kinetic + e.strain + e.radiated + e.damping + e.numerical, work.sum, 1e-10 * largest);
                EXPECT_GE(e.radiated, 0.0);
            }
            if (scheme.alpha == 0.0 && scheme.gamma == 0.5) {
                EXPECT_GE(lowest, 0.0);
                EXPECT_NEAR(motion.energy().numerical, 0.0, 1e-12 * largest);
            }
            EXPECT_GT(plain, 0.0);
            EXPECT_LT(motion.energy().kinetic + motion.energy().strain, 0.05 * largest); // left
        }
}

// The free step with the compliance times p̃ is the step; displacement, velocity and acceleration are those of Φ q + e.
TEST(RockMotion, StepIsFreeStepAndCompliance)
{
    const SmallRock& small = small_rock();
    const RockStep step(small.rock, 0.01, step_constants(hht(-0.1), small.step));
    RockMotion motion(small.rock);
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    VectorXd constant(small.rock.interface()), sum = VectorXd::Zero(small.rock.interface());
    for (double& value : constant) value = normal(random);
    for (int k = 0; k < 20; ++k) {
        VectorXd force(small.rock.interface());
        for (double& value : force) value = normal(random);
        motion.begin(step, constant);
        const VectorXd expected = motion.free_step() + step.compliance() * force;
        motion.finish(force);
        sum += motion.step();
        EXPECT_LT((motion.step() - expected).norm(), 1e-12 * expected.norm());
        const VectorXd u =
            small.rock.modes * motion.modal_displacement() + small.rock.residual * motion.residual_force();
        EXPECT_LT((motion.displacement() - u).norm(), 1e-12 * u.norm());
        EXPECT_LT((motion.displacement() - sum).norm(), 1e-13 * u.norm());
    }
    EXPECT_GT(smallest_share(step.compliance()), -1e-14);
}

// A constant force and its opposite: rest, to the last bit.
TEST(RockMotion, StaysAtRest)
{
    const SmallRock& small = small_rock();
    const RockStep step(small.rock, 0.01, step_constants(hht(-0.1), small.step));
    RockMotion motion(small.rock);
    for (int k = 0; k < 10; ++k) {
        motion.begin(step);
        motion.finish(VectorXd::Zero(small.rock.interface()));
    }
    EXPECT_EQ(motion.displacement().norm(), 0.0);

    // under a force that stays, to the static displacement
    const VectorXd force = VectorXd::Ones(small.rock.interface());
    for (int k = 0; k < 4000; ++k) {
        motion.begin(step);
        motion.finish(force);
    }
    const VectorXd at_rest = small.rock.static_flexibility() * force;
    EXPECT_LT((motion.displacement() - at_rest).norm(), 1e-3 * at_rest.norm());
}

// Test 6 of the contract for given forces: the same steps by the whole box, a blow with frequencies up to the highest.
TEST(RockMotion, MovesAsTheBoxDoes)
{
    const SmallRock& small = small_rock();
    const WaveBox& box = small.box;
    const double b_k = 0.01, dt = 0.05 * 2.0 * std::numbers::pi / small.input.highest_frequency;
    const StepConstants c = step_constants(hht(-0.05), dt);
    const double w = 0.95, alpha = -0.05;
    const MatrixXd mass(box.mass), stiffness(box.stiffness), damping = MatrixXd(box.damping) + b_k * stiffness;
    const Eigen::LLT<MatrixXd> llt(c.a0 * mass + w * (c.a1 * damping + stiffness));
    const Index n = small.rock.interface();
    VectorXd u = VectorXd::Zero(2 * box.nodes), v = u, a = u;
    const RockStep step(small.rock, b_k, c);
    RockMotion motion(small.rock);
    const MatrixXd shapes = strip_loads(small.input.surface);
    const auto load = [&](double t) -> VectorXd {
        const double s = (t - 60.0 * dt) / (18.0 * dt), pulse = std::exp(-s * s);
        return shapes * Eigen::Vector3d(pulse, -2.0 * s * pulse, 0.5 * pulse);
    };
    VectorXd force = load(0.0);
    double largest = 0.0, difference = 0.0;
    for (int k = 1; k <= 400; ++k) {
        const VectorXd next = load(k * dt), weighted = w * next - alpha * force;
        force = next;
        VectorXd right =
            mass * (c.a2 * v + c.a3 * a) - stiffness * u + damping * ((alpha + w * c.a4) * v + w * c.a5 * a);
        for (Index i = 0; i < n; ++i) right[box.interface[static_cast<std::size_t>(i)]] += weighted[i];
        const VectorXd du = llt.solve(right), a1 = c.a0 * du - c.a2 * v - c.a3 * a;
        v = (c.a1 * du - c.a4 * v - c.a5 * a).eval();
        a = a1;
        u += du;
        motion.begin(step);
        motion.finish(weighted);
        VectorXd at(n);
        for (Index i = 0; i < n; ++i) at[i] = u[box.interface[static_cast<std::size_t>(i)]];
        largest = std::max(largest, at.norm());
        difference = std::max(difference, (at - motion.displacement()).norm());
    }
    EXPECT_LT(difference, 0.005 * largest);
}

// Velocities that jump take kinetic energy, which counts as numerical; the balance stays closed in the steps after.
TEST(RockMotion, JumpsKeepTheEnergyClosed)
{
    const SmallRock& small = small_rock();
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    const Scheme scheme = hht(-0.1);
    const RockStep step(small.rock, 0.01, step_constants(scheme, small.step));
    RockMotion motion(small.rock);
    const Index n = small.rock.interface();
    Work work{scheme.alpha, VectorXd::Zero(n), VectorXd::Zero(n)};
    VectorXd force = VectorXd::Zero(n);
    double largest = 0.0;
    for (int k = 0; k < 60; ++k) {
        VectorXd next(n), impulse(n);
        for (double& value : next) value = normal(random);
        for (double& value : impulse) value = normal(random);
        motion.begin(step);
        motion.finish((1.0 + scheme.alpha) * next - scheme.alpha * force);
        work.add(next, motion.step());
        force = next;
        const RockEnergy& e = motion.energy();
        largest = std::max(largest, e.kinetic + e.strain + e.radiated + e.damping);
        EXPECT_NEAR(e.kinetic + e.strain + e.radiated + e.damping + e.numerical, work.sum, 1e-10 * largest) << k;
        if (k % 5 != 4) continue;
        const VectorXd before = motion.velocity(), jump = motion.jump_velocity(impulse);
        EXPECT_LT((motion.velocity() - before - step.compliance() * impulse).norm(), 1e-12 * jump.norm());
        if (k % 10 == 9) motion.jump_acceleration(impulse);
    }
}

} // namespace damslip::rock_tests
