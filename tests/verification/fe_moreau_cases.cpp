#include "verification/modules.hpp"

#include "fe2d/contact/lemke.hpp"
#include "fe2d/run/ground_input.hpp"
#include "fe2d/run/stages.hpp"
#include "verification/fe_run_scenes.hpp"
#include "verification/moreau_scheme.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

enum class Base { rigid, rock };

/// A triangular dam, water in front of it, stiffness damping; in static equilibrium. Unknowns: the dam's, then those of
/// the rock's contact nodes in the plane.
class SmallDam {
public:
    static constexpr double friction = 0.7, damping = 4e-3; ///< mu [-]; b_K [s], about 5 % in the first mode

    explicit SmallDam(Base base)
    {
        scene_ = exact::bare_scene(exact::triangle(30.0, 40.0), 2400.0);
        scene_.dam.young_modulus = 2e9;
        scene_.dam.poisson_ratio = 0.2;
        scene_.reservoir.emplace();
        scene_.reservoir->level = 30.0;
        scene_.reservoir->model = ReservoirModel::hydrostatic;
        if (base == Base::rock)
            scene_.foundation = Foundation{.material = {0.0, 4e9, 0.2}, .width = 120.0, .depth = 40.0};
        scene_.mesh.size = 8.0;
        scene_.mesh.contact_size = 5.0;
        fe2d::ModelOptions options;
        options.base = fe2d::Base::separate;
        model_ = fe2d::build_model(scene_, options);
        structure_.emplace(model_);
        load_ = structure_->split(fe2d::load_stages(scene_, model_, {}).last());
        fe2d::StaticContact statics(*structure_);
        memory_ = fe2d::ContactMemory(structure_->plane().pairs());
        statics.solve(load_, law(), memory_);
        start_ = statics.displacements(load_, memory_);
    }
    SmallDam(const SmallDam&) = delete;
    SmallDam& operator=(const SmallDam&) = delete;

    Index pairs() const { return structure_->plane().pairs(); }
    VectorXd weights() const { return structure_->plane().weights(); }
    fe2d::ContactLaw law() const { return fe2d::uniform_law(structure_->plane().pairs(), friction); }
    VectorXd start() const { return joined(start_.dam, start_.rock); }
    VectorXd load(const fe2d::GroundAcceleration& ground) const
    {
        return joined(load_.dam + ground.h * structure_->inertia_x() - ground.v * structure_->inertia_y(), load_.rock);
    }
    fe2d::DynamicContact dynamics(const fe2d::Scheme& scheme) const
    {
        return {*structure_, {{0.0, damping}}, scheme, load_, start_, memory_};
    }
    DenseSystem dense() const
    {
        const Index d = structure_->dam_unknowns(), m = pairs(), n = start().size();
        MatrixXd mass = MatrixXd::Zero(n, n), stiffness = mass, map = MatrixXd::Zero(2 * m, n);
        mass.topLeftCorner(d, d) = MatrixXd(structure_->mass());
        stiffness.topLeftCorner(d, d) = MatrixXd(structure_->stiffness());
        for (Index k = 0; k < 2 * m; ++k)
            map.col(d - 2 * m + k) = structure_->plane().to_plane(VectorXd(VectorXd::Unit(2 * m, k)));
        if (structure_->has_rock()) {
            stiffness.bottomRightCorner(2 * m, 2 * m) = structure_->rock_stiffness();
            map.rightCols(2 * m) = -MatrixXd::Identity(2 * m, 2 * m);
        }
        return {mass, damping * stiffness, stiffness, map};
    }

private:
    VectorXd joined(const VectorXd& dam, const VectorXd& rock) const
    {
        VectorXd all(dam.size() + (structure_->has_rock() ? rock.size() : 0));
        all.head(dam.size()) = dam;
        if (structure_->has_rock()) all.tail(rock.size()) = rock;
        return all;
    }

    Scene scene_;
    fe2d::Model model_;
    std::optional<fe2d::ContactStructure> structure_;
    fe2d::SplitLoad load_;
    fe2d::ContactMemory memory_;
    fe2d::StaticState start_;
};

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
    MoreauScheme scheme(dam.dense(), VectorXd::Constant(m, SmallDam::friction), record_dt / parts, theta);
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
    Base base;
    fe2d::Scheme scheme;
    double theta;
    int coarsest, finest; ///< sub-steps 2^k of the record's step
    double least_order;   ///< in dt, of the difference [-]
};

std::vector<Check> moreau(const Comparison& c)
{
    const SmallDam dam(c.base);
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
             return moreau({Base::rock, fe2d::hht(-0.05), 1.0, 2, 5, 0.8});
         }});
    registry.push_back(
        {"fe.contact.moreau-rigid-base", "The same on a rigid base, which the dam's nodes hit with their mass.",
         "Moreau (1988), Jean (1999), theta = 1/2",
         tolerance +
             ". At alpha = -1/3 and down to 1/8 of the record's step: with smaller ones such impacts put energy "
             "into the displacement scheme (contact normal work), and its slip leaves the limit by some per cent",
         [] {
             return moreau({Base::rigid, fe2d::hht(-1.0 / 3.0), 0.5, 1, 3, 0.5});
         }});
}

} // namespace damslip::verification
