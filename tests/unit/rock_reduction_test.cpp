#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "rock_scenes.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

namespace damslip::rock_tests {

using namespace fe2d;

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

namespace {

MatrixXd on_box(const WaveBox& box, const MatrixXd& interface)
{
    MatrixXd all = MatrixXd::Zero(2 * box.nodes, interface.cols());
    for (Index i = 0; i < interface.rows(); ++i) all.row(box.interface[static_cast<std::size_t>(i)]) = interface.row(i);
    return all;
}

template <class Matrix>
Matrix on_interface(const WaveBox& box, const Matrix& all)
{
    Matrix rows(static_cast<Index>(box.interface.size()), all.cols());
    for (Index i = 0; i < rows.rows(); ++i) rows.row(i) = all.row(box.interface[static_cast<std::size_t>(i)]);
    return rows;
}

MatrixXcd exact_response(const WaveBox& box, double frequency, const MatrixXd& loads)
{
    const FrequencySolver solver(box.mass, box.damping, box.stiffness, "the box");
    return on_interface(box, solver.solve({frequency}, on_box(box, loads)));
}

MatrixXd identity(const WaveBox& box)
{
    const auto n = static_cast<Index>(box.interface.size());
    return MatrixXd::Identity(n, n);
}

} // namespace

TEST(FrequencySolver, RefusesWhatHasNoResidual)
{
    const WaveBox box = make_wave_box(small_box());
    const FrequencySolver solver(box.mass, box.damping, box.stiffness, "the box");
    MatrixXd loads = on_box(box, identity(box));
    EXPECT_NO_THROW(solver.solve({1.0}, loads));
    loads(0, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(solver.solve({1.0}, loads), std::runtime_error);
}

TEST(ReducedRock, IsPassive)
{
    const WaveBoxInput input = small_box();
    const ReducedRock rock = reduce_rock(input, make_wave_box(input));
    EXPECT_GT(rock.stiffness[0], 0.0); // M̂ is 1
    EXPECT_GT(smallest_share(rock.damping), -1e-12);
    EXPECT_GT(smallest_share(rock.residual), -1e-12);
    EXPECT_EQ((rock.damping - rock.damping.transpose()).norm(), 0.0);
    EXPECT_EQ((rock.residual - rock.residual.transpose()).norm(), 0.0);
    for (double frequency = 0.05; frequency < 20.0; frequency *= 2.0) {
        const MatrixXcd f = rock.response(frequency, 0.002, MatrixXd::Identity(rock.interface(), rock.interface()));
        EXPECT_GT(smallest_share(-f.imag()), -1e-12); // at rest or spending energy, far above what it is made for too
    }
}

TEST(ReducedRock, IsExactAtRest)
{
    const WaveBoxInput input = small_box();
    const WaveBox box = make_wave_box(input);
    const ReducedRock rock = reduce_rock(input, box);
    LinearSolver solver;
    ASSERT_TRUE(solver.factorise(box.stiffness).ok());
    const MatrixXd exact = on_interface(box, solver.solve(on_box(box, identity(box))));
    EXPECT_LT((rock.static_flexibility() - exact).norm(), 1e-12 * exact.norm());
}

// The whole matrix of the interface, in between the sampled frequencies.
TEST(ReducedRock, AnswersAsTheBoxDoes)
{
    const WaveBoxInput input = small_box();
    const WaveBox box = make_wave_box(input);
    const ReducedRock rock = reduce_rock(input, box);
    EXPECT_TRUE(rock.report.passed());
    EXPECT_LT(rock.count(), 60);
    for (const double share : {0.1, 0.3, 0.55, 0.85, 0.97}) {
        const double w = share * input.highest_frequency;
        const MatrixXcd exact = exact_response(box, w, identity(box));
        EXPECT_LT((rock.response(w, 0.0, identity(box)) - exact).norm(), 0.02 * exact.norm()) << share;
    }
}

// Too few frequencies, too coarse a cut: the gate sees it, adds what is missing and passes.
TEST(ReducedRock, AddsWhatItsGateMisses)
{
    const WaveBoxInput input = small_box();
    const WaveBox box = make_wave_box(input);
    ReductionOptions poor;
    poor.sampling = 0.3;
    poor.kept = 0.5;
    poor.largest_rounds = 1;
    EXPECT_FALSE(reduce_rock(input, box, poor).report.passed());
    poor.largest_rounds = 8;
    const ReducedRock rock = reduce_rock(input, box, poor);
    EXPECT_TRUE(rock.report.passed());
    EXPECT_GT(rock.report.rounds, 1);
}

// Test 10 of the contract: 2 times the modulus, the density, the length are the same numbers scaled.
TEST(ReducedRock, ScalesWithModulusDensityAndLength)
{
    const WaveBoxInput one = small_box();
    const ReducedRock unit = reduce_rock(one, make_wave_box(one));
    for (const auto& [modulus, density, length] :
         {std::tuple{2.0, 1.0, 1.0}, {1.0, 2.0, 1.0}, {1.0, 1.0, 2.0}, {30e9, 2650.0, 45.0}}) {
        WaveBoxInput input = one;
        input.rock = {density, modulus, one.rock.poisson_ratio};
        input.base *= length;
        input.middle *= length;
        for (Point& p : input.surface) p = {p.x * length, p.y * length};
        const double rate = std::sqrt(modulus / density) / length;
        input.highest_frequency *= rate;
        const ReducedRock fresh = reduce_rock(input, make_wave_box(input)),
                          scaled = unit.scaled(modulus, density, length);
        ASSERT_EQ(fresh.count(), scaled.count());
        const MatrixXd loads = MatrixXd::Identity(unit.interface(), unit.interface());
        for (const double share : {0.0, 0.2, 0.7, 1.0, 3.0}) {
            const double w = share * input.highest_frequency;
            const MatrixXcd a = fresh.response(w, 0.001 / rate, loads), b = scaled.response(w, 0.001 / rate, loads);
            EXPECT_LT((a - b).norm(), 1e-10 * b.norm()) << share;
        }
    }
}

TEST(ReducedRock, TurnsWithThePlane)
{
    const WaveBoxInput input = small_box(4);
    const ReducedRock rock = reduce_rock(input, make_wave_box(input));
    const double angle = 0.2;
    const ReducedRock turned = rock.on_plane({std::sin(angle), std::cos(angle)}, {std::cos(angle), -std::sin(angle)});
    const MatrixXd a = rock.static_flexibility(), b = turned.static_flexibility();
    EXPECT_NEAR(a.trace(), b.trace(), 1e-13 * a.trace());
    const Index n = rock.interface() / 2; // normal of node 1 by a tangential force at node 3
    const Eigen::Vector2d normal{std::sin(angle), std::cos(angle)}, tangent{std::cos(angle), -std::sin(angle)};
    EXPECT_NEAR(b(1, n + 3), normal.dot(a.block<2, 2>(2, 6) * tangent), 1e-14 * a.norm());
}

// Test 5 of the contract, the kernel's part: with the mass going to zero the compliance of a step becomes that of
// condensed massless rock with the same edges, B_r K⁻¹ B_rᵀ/(w (1 + a1 b_K)).
TEST(ReducedRock, BecomesMasslessRock)
{
    const WaveBoxInput input = small_box();
    const WaveBox box = make_wave_box(input);
    const ReducedRock unit = reduce_rock(input, box);
    const StepConstants step = step_constants(hht(-0.05), 0.01);
    const double b_k = 0.002, share = 1.0 / (0.95 * (1.0 + step.a1 * b_k));
    double before = 1.0;
    for (const double density : {1e-4, 1e-6, 1e-8, 1e-10}) {
        const ReducedRock rock = unit.scaled(1e4, density, 1.0);
        const MatrixXd massless = share * rock.static_flexibility();
        const double difference = (RockStep(rock, b_k, step).compliance() - massless).norm() / massless.norm();
        if (before < 0.1) {
            EXPECT_NEAR(difference / before, 0.1, 0.02);
        } // dashpots go with √ρ
        before = difference;
    }
    EXPECT_LT(before, 1e-4);
}

} // namespace damslip::rock_tests
