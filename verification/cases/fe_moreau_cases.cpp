#include "verification/cases/modules.hpp"

#include "fe2d/contact/contact_problem.hpp"
#include "fe2d/run/ground_input.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/cases/small_dam.hpp"

#include <fmt/format.h>

#include <cmath>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double record_dt = 0.01;  ///< [s]
constexpr double tie_break = 2e-10; ///< cohesion by which solve_by_lemke() decides ties, of the largest force [-]

/// Mean slip since the static state at the record's steps, with 2^k sub-steps.
VectorXd slip_by_displacements(const SmallDam& dam, const fe2d::GroundInput& ground, int steps, int halvings,
                               const fe2d::Scheme& scheme)
{
    fe2d::DynamicContact dynamics = dam.dynamics(scheme);
    const int parts = 1 << halvings;
    VectorXd slip = VectorXd::Zero(steps + 1);
    const double start = dam.weights().dot(dynamics.state().contact.slip);
    for (int n = 1; n <= steps * parts; ++n) {
        dynamics.advance(record_dt / parts, ground.at(record_dt * n / parts), dam.law());
        if (n % parts == 0) slip[n / parts] = dam.weights().dot(dynamics.state().contact.slip) - start;
    }
    return slip;
}

struct ImpulseRun {
    VectorXd slip;
    double lemke_difference = 0.0; ///< largest of impulses by the two solvers, of the largest impulse [-]
    double condition = 0.0;        ///< of the Delassus operator [-]
};

/// The step's problem once more as a linear complementarity problem.
double difference_to_lemke(const MoreauScheme& scheme, const SmallDam& dam)
{
    const Index m = dam.pairs();
    MatrixXd stiffness = scheme.delassus().llt().solve(MatrixXd::Identity(2 * m, 2 * m));
    stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    const VectorXd stuck = -stiffness * scheme.free_rates();
    const fe2d::ContactLaw law = dam.law();
    fe2d::ContactSolution solution{fe2d::ContactStates(static_cast<std::size_t>(m), fe2d::ContactState::stick),
                                   VectorXd::Zero(2 * m), VectorXd::Zero(2 * m)};
    int pivots = 0;
    if (!fe2d::solve_by_lemke({stiffness, stuck, law}, solution, pivots)) return 1.0;
    return (solution.force - scheme.impulse()).cwiseAbs().maxCoeff() / scheme.impulse().cwiseAbs().maxCoeff();
}

ImpulseRun slip_by_impulses(const SmallDam& dam, const fe2d::GroundInput& ground, int steps, int halvings, double theta)
{
    const int parts = 1 << halvings;
    const Index m = dam.pairs();
    MoreauScheme scheme(dam.dense(), VectorXd::Constant(m, dam.friction()), record_dt / parts, theta);
    scheme.start(dam.start(), dam.load({}));
    ImpulseRun run;
    run.slip = VectorXd::Zero(steps + 1);
    const double start = dam.weights().dot(scheme.gaps().tail(m));
    for (int n = 1; n <= steps * parts; ++n) {
        scheme.advance(dam.load(ground.at(record_dt * n / parts)));
        if (n % parts == 0) run.slip[n / parts] = dam.weights().dot(scheme.gaps().tail(m)) - start;
        if (n % (10 * parts) == 0 && scheme.all_shut())
            run.lemke_difference = std::max(run.lemke_difference, difference_to_lemke(scheme, dam));
    }
    const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(scheme.delassus()).eigenvalues();
    run.condition = eigenvalues.maxCoeff() / eigenvalues.minCoeff();
    return run;
}

/// Largest difference of two histories [m].
double apart(const VectorXd& a, const VectorXd& b)
{
    return (a - b).cwiseAbs().maxCoeff();
}

struct Comparison {
    SmallDamBase base;
    fe2d::Scheme scheme;
    double theta;
    int coarsest, finest; ///< sub-steps 2^k of the record's step
    double least_order;   ///< in dt, of the difference [-]
};

std::vector<Check> moreau(const Comparison& c)
{
    const SmallDam dam(small_dam_scene(c.base));
    const GroundMotion motion = fe2d::test::sines(4.0, 4.0, 5, record_dt);
    const fe2d::GroundInput ground(motion, MassDamping::relative, 0.0);
    const int steps = static_cast<int>(motion.accel_h.size()) - 1;
    std::vector<Check> checks;
    VectorXd displacements, impulses;
    std::vector<double> difference;
    for (int k = c.coarsest - 1; k <= c.finest; ++k) {
        const VectorXd d = slip_by_displacements(dam, ground, steps, k, c.scheme);
        const ImpulseRun run = slip_by_impulses(dam, ground, steps, k, c.theta);
        if (k >= c.coarsest) {
            const std::string name = fmt::format(", dt = {:.4g} ms", 1e3 * record_dt / (1 << k));
            difference.push_back(apart(d, run.slip));
            checks.push_back({"largest difference of the slip" + name, "m",
                              2.0 * (apart(d, displacements) + apart(run.slip, impulses)), difference.back(), 0.0,
                              Measure::upper_bound});
            checks.push_back({"impulses by Gauss-Seidel and by Lemke's method apart" + name, "of the largest",
                              (tie_break + 1e-12) * run.condition, run.lemke_difference, 0.0, Measure::upper_bound});
        }
        displacements = d;
        impulses = run.slip;
    }
    checks.push_back({"order of the difference in dt", "-", c.least_order,
                      std::log2(difference.front() / difference.back()) / (c.finest - c.coarsest), 0.0,
                      Measure::lower_bound});
    return checks;
}

} // namespace

void add_fe_moreau_cases(Registry& registry)
{
    const std::string tolerance =
        "the errors left at dt are at most twice what the last halving changed, for any order above 0.58 (ratio 2/3 "
        "from "
        "halving to halving); Lemke's method breaks ties by a cohesion of 2e-10, Gauss-Seidel stops at changes of "
        "1e-12, times the condition of the matrix";
    registry.push_back(
        {"fe.contact.moreau-rock",
         "Slip of a small dam on rock by DynamicContact and by impulses and velocities goes to one limit.",
         "Moreau (1988), Jean (1999): theta-method, here theta = 1, with plastic impacts", tolerance, [] {
             return moreau({SmallDamBase::rock, fe2d::hht(-0.05), 1.0, 2, 5, 0.8});
         }});
    registry.push_back(
        {"fe.contact.moreau-rigid-base", "The same on a rigid base, which the dam's nodes hit with their mass.",
         "Moreau (1988), Jean (1999), theta = 1/2",
         tolerance +
             ". At alpha = -1/3 and down to 1/8 of the record's step: with smaller ones such impacts put energy "
             "into the displacement scheme (contact normal work), and its slip leaves the limit by some per cent",
         [] {
             return moreau({SmallDamBase::rigid, fe2d::hht(-1.0 / 3.0), 0.5, 1, 3, 0.5});
         }});
}

} // namespace damslip::verification
