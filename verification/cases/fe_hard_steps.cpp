#include "verification/cases/fe_hard_steps.hpp"

#include "fe2d/contact/contact_problem.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <numeric>

namespace damslip::verification {

using Eigen::Index;
using Eigen::VectorXd;
using namespace fe2d;

namespace {

/// λ⁰ of a step from the state before it: the right-hand side of DynamicOperator's equations with M and K multiplied
/// one by one.
class StepProblem {
public:
    StepProblem(const ContactStructure& structure, const RunDamping& damping, const StepConstants& constants,
                SplitLoad load)
        : structure_(structure), damping_(damping), constants_(constants), load_(std::move(load)),
          slip_damping_(structure, damping), operator_(structure, damping, slip_damping_, constants)
    {
    }

    const Eigen::MatrixXd& stiffness() { return *operator_.contact().stiffness; }

    VectorXd stuck_force(const DynamicState& before, const GroundAcceleration& ground)
    {
        const StepConstants& c = constants_;
        const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
        const double a_m = damping_.constants.mass, b_k = damping_.constants.stiffness;
        const Index m = structure_.plane().pairs();
        // (1+α) C v₁ - α C v₀ = (1+α) a1 C Δu - C y,  y = cv v₀ + ca a₀
        const VectorXd y = cv * before.v + ca * before.a;
        DynamicOperator::Free free;
        free.dam = load_.dam + (w * ground.h - alpha * before.ground.h) * structure_.inertia_x() -
                   (w * ground.v - alpha * before.ground.v) * structure_.inertia_y() -
                   structure_.stiffness() * VectorXd(before.u - b_k * y) +
                   structure_.mass() * VectorXd(c.a2 * before.v + c.a3 * before.a) + a_m * (structure_.dam_mass() * y);
        VectorXd known = alpha * before.contact.force;
        if (slip_damping_.active()) {
            const VectorXd on_base = structure_.plane().to_plane(VectorXd(y.tail(2 * m)));
            const VectorXd rate = on_base.tail(m) - (cv * before.rock_v + ca * before.rock_a).tail(m);
            const VectorXd slip = slip_damping_.weights.transpose() * rate,
                           mean = slip_damping_.momentum.transpose() * y;
            free.dam -= slip_damping_.momentum * slip;
            known.tail(m) -= slip_damping_.weights * (slip_damping_.drag * slip - mean);
        }
        VectorXd rock_gap = VectorXd::Zero(2 * m);
        if (structure_.has_rock())
            rock_gap = (structure_.rock_flexibility() * load_.rock - before.rock +
                        b_k * (cv * before.rock_v + ca * before.rock_a)) /
                       (w * (1.0 + c.a1 * b_k));
        operator_.factor().forward(free.dam);
        operator_.solve_free(free, rock_gap);
        VectorXd stuck;
        operator_.stuck_force(operator_.contact(), free, known, stuck);
        return stuck - stiffness().leftCols(m) * before.contact.opening; // gaps from shut, not from where they are
    }

private:
    const ContactStructure& structure_;
    RunDamping damping_;
    StepConstants constants_;
    SplitLoad load_;
    SlipDamping slip_damping_;
    DynamicOperator operator_;
};

/// The contact conditions as a linear complementarity problem in (λ_n, λ⁺, λ⁻, σ), see solve_by_lemke(), in units of
/// `force`. There ties of Lemke's ratio test are broken by a cohesion of 1e-10 of the largest λ⁰, which in a stiff
/// structure is 1e5 N'; here by 1e-11 of N', different for each pair.
bool solve_by_complementarity(const ContactProblem& problem, double force, VectorXd& lambda, VectorXd& displacement)
{
    const Index m = problem.law.pairs();
    Eigen::MatrixXd w = problem.stiffness.llt().solve(Eigen::MatrixXd::Identity(2 * m, 2 * m));
    const double scale = w.diagonal().mean();
    w = (0.5 / scale * (w + w.transpose())).eval();
    const VectorXd free = -w * problem.stuck_force / force;
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(m, m), zero = Eigen::MatrixXd::Zero(m, m);
    const Eigen::MatrixXd nn = w.topLeftCorner(m, m), nt = w.topRightCorner(m, m), tn = w.bottomLeftCorner(m, m),
                          tt = w.bottomRightCorner(m, m), mu = problem.law.friction.asDiagonal();
    Eigen::MatrixXd matrix(4 * m, 4 * m);
    matrix << nn, nt, -nt, zero, tn, tt, -tt, one, -tn, -tt, tt, one, mu, -one, -one, zero;
    VectorXd q(4 * m);
    q << free.head(m), free.tail(m), -free.tail(m), problem.law.cohesion / force + VectorXd::LinSpaced(m, 1e-11, 2e-11);
    const LcpResult result = lemke(matrix, q, static_cast<int>(80 * m + 100));
    if (!result.solved) return false;
    lambda.resize(2 * m);
    lambda << result.z.head(m), result.z.segment(m, m) - result.z.segment(2 * m, m);
    displacement = scale * force * (w * lambda + free);
    lambda *= force;
    return true;
}

bool all_open(const ContactStates& states)
{
    return std::all_of(states.begin(), states.end(), [](ContactState state) { return state == ContactState::open; });
}

} // namespace

StepRecords recorded_run(const Scene& scene, const RunOptions& options, const GroundMotion& motion)
{
    const EarthquakeRun run(scene, options);
    const ContactStructure& structure = run.structure();
    const Index m = structure.plane().pairs();
    StaticContact statics(structure);
    Strength strength(scene.contact, structure.plane());
    ContactMemory memory(m);
    run.statics(statics, strength, memory);
    const SplitLoad load = structure.split(load_stages(scene, run.model(), options.uplift).last());
    const RunDamping damping{run.damping(), scene.damping.mass};
    const Scheme scheme = scheme_of(scene.time);
    DynamicContact dynamics(structure, damping, scheme, load, statics.displacements(load, memory), memory);
    StepProblem problem(structure, damping, step_constants(scheme, motion.dt), load);

    StepRecords records{problem.stiffness(), strength.law(), memory.force.head(m).sum(), {}};
    for (std::size_t k = 1; k < motion.accel_h.size(); ++k) {
        const GroundAcceleration ground{motion.accel_h[k], motion.accel_v[k]};
        StepRecord record;
        record.stuck_force = problem.stuck_force(dynamics.state(), ground);
        const VectorXd slip_before = dynamics.state().contact.slip;
        const bool flying = all_open(dynamics.state().contact.states);
        record.report = dynamics.advance(motion.dt, ground, strength.law());
        if (flying && !all_open(dynamics.state().contact.states)) continue; // forces are not the step's after a landing
        const ContactMemory& after = dynamics.state().contact;
        record.force = after.force;
        record.displacement.resize(2 * m);
        record.displacement << after.opening, after.slip - slip_before;
        records.steps.push_back(std::move(record));
    }
    return records;
}

std::vector<std::size_t> hardest_steps(const StepRecords& records, std::size_t count)
{
    std::vector<std::size_t> order(records.steps.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto effort = [&](std::size_t k) {
        const ContactReport& report = records.steps[k].report;
        return std::pair(static_cast<int>(report.path), report.iterations);
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return effort(a) > effort(b); });
    order.resize(std::min(count, order.size()));
    return order;
}

LemkeDifference compare_with_lemke(const StepRecords& records, std::size_t step)
{
    const StepRecord& record = records.steps[step];
    LemkeDifference difference;
    VectorXd lambda, displacement;
    difference.solved = solve_by_complementarity({records.stiffness, record.stuck_force, records.law},
                                                 records.normal_force, lambda, displacement);
    if (!difference.solved) return difference;
    const VectorXd weighted = records.stiffness.diagonal().cwiseProduct(displacement - record.displacement);
    difference.force = (lambda - record.force).cwiseAbs().maxCoeff() / records.normal_force;
    difference.displacement = weighted.cwiseAbs().maxCoeff() / records.normal_force;
    return difference;
}

} // namespace damslip::verification
