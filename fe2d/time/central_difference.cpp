#include "fe2d/time/central_difference.hpp"

#include "core/input_error.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/condensation.hpp"
#include "fe2d/time/integrate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int steps_between_products = 256; ///< of K u; the sums in between lose less than 1e-13 of it

/// Inverse of a symmetric matrix that couples each unknown with one other at most.
SparseMatrix inverse_of_blocks(const SparseMatrix& matrix)
{
    const VectorXd diagonal = matrix.diagonal();
    std::vector<Eigen::Triplet<double>> entries;
    for (Index k = 0; k < matrix.outerSize(); ++k) {
        Index other = k;
        double off = 0.0;
        for (SparseMatrix::InnerIterator it(matrix, k); it; ++it)
            if (it.row() != k && it.value() != 0.0) {
                assert(other == k && "blocks of two unknowns at most");
                other = it.row();
                off = it.value();
            }
        const double det = other == k ? diagonal[k] : diagonal[k] * diagonal[other] - off * off;
        entries.emplace_back(k, k, other == k ? 1.0 / det : diagonal[other] / det);
        if (other != k) entries.emplace_back(other, k, -off / det);
    }
    SparseMatrix inverse(matrix.rows(), matrix.cols());
    inverse.setFromTriplets(entries.begin(), entries.end());
    return inverse;
}

} // namespace

SparseMatrix lumped_mass(const DofMap& dofs, const VectorXd& inertia_x, const VectorXd& inertia_y, Index size)
{
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<char> seen(static_cast<std::size_t>(size),
                           0); // nodes of a joint that does not open share their unknowns
    for (std::size_t node = 0; node < dofs.dofs.size() / 2; ++node) {
        const int x = dofs(static_cast<int>(node), 0), y = dofs(static_cast<int>(node), 1);
        const auto take = [&](int dof) {
            if (dof == no_dof || dof >= size || seen[static_cast<std::size_t>(dof)]) return false;
            return seen[static_cast<std::size_t>(dof)] = 1, true;
        };
        const bool has_x = take(x), has_y = take(y);
        if (has_x) entries.emplace_back(x, x, inertia_x[x]);
        if (has_y) entries.emplace_back(y, y, inertia_y[y]);
        if (!has_x || !has_y) continue;
        const double coupling = 0.5 * (inertia_y[x] + inertia_x[y]);
        if (coupling == 0.0) continue;
        entries.emplace_back(x, y, coupling);
        entries.emplace_back(y, x, coupling);
    }
    SparseMatrix mass(size, size);
    mass.setFromTriplets(entries.begin(), entries.end());
    return mass;
}

double central_difference_limit(double highest_frequency, double stiffness_damping)
{
    const double ratio = 0.5 * stiffness_damping * highest_frequency;
    return 2.0 / (highest_frequency * (std::sqrt(1.0 + ratio * ratio) + ratio)); // without cancellation
}

CentralDifference::CentralDifference(ExplicitSystem system, double dt)
    : system_(std::move(system)), dt_(dt),
      inverse_(inverse_of_blocks(SparseMatrix(system_.mass + 0.5 * dt * system_.mass_damping)))
{
    assert(dt > 0.0);
}

StepConstants CentralDifference::constants() const
{
    StepConstants c;
    c.scheme = {0.0, 0.5, 0.0};
    c.dt = dt_;
    return c;
}

State CentralDifference::start(const VectorXd& displacement, const VectorXd& velocity, const VectorXd& load) const
{
    State s;
    s.displacement = displacement;
    s.velocity = velocity;
    s.load = load;
    s.interface_force = VectorXd::Zero(displacement.size());
    s.stiffness_force = system_.stiffness * displacement;
    s.damping_force = system_.mass_damping * velocity + system_.stiffness_damping * (system_.stiffness * velocity);
    s.unbalanced = s.damping_force + s.stiffness_force - load;
    s.unbalanced_before = s.unbalanced;
    s.acceleration = -(inverse_of_blocks(system_.mass) * s.unbalanced);
    s.momentum = system_.mass * velocity;
    s.inertia_force = system_.mass * s.acceleration;
    return s;
}

void CentralDifference::step(const State& before, const VectorXd& load_after, State& after)
{
    assert(&before != &after);
    after.time = before.time + dt_;
    after.load = load_after;
    if (after.interface_force.size() == 0) after.interface_force = before.interface_force;
    middle_ = before.velocity + 0.5 * dt_ * before.acceleration;
    after.displacement = before.displacement + dt_ * middle_;
    product_.noalias() = system_.stiffness.transpose() * middle_; // symmetric: rows are read one after the other
    if (++since_product_ == steps_between_products) {
        since_product_ = 0;
        after.stiffness_force.noalias() = system_.stiffness.transpose() * after.displacement;
    } else {
        after.stiffness_force = before.stiffness_force + dt_ * product_;
    }
    after.damping_force.noalias() = system_.mass_damping * middle_;
    if (system_.stiffness_damping != 0.0) after.damping_force += system_.stiffness_damping * product_;
    product_ = load_after - after.stiffness_force - after.damping_force;
    after.acceleration.noalias() = inverse_ * product_;
    after.velocity = middle_ + 0.5 * dt_ * after.acceleration;
    after.damping_force += system_.mass_damping * (0.5 * dt_ * after.acceleration);
    after.momentum.noalias() = system_.mass * after.velocity;
    after.inertia_force.noalias() = system_.mass * after.acceleration;
    after.unbalanced_before = before.unbalanced;
    after.unbalanced = after.damping_force + after.stiffness_force - load_after;
}

namespace {

[[noreturn]] void refuse_explicit(std::string problem, std::string expected, std::string fix)
{
    Diagnostic diagnostic;
    diagnostic.problem = std::move(problem);
    diagnostic.expected = std::move(expected);
    diagnostic.fix = std::move(fix);
    throw InputError(std::move(diagnostic));
}

void check(const TiedProblem& problem)
{
    if (problem.options.water)
        refuse_explicit("time.scheme = \"central-difference\" with acoustic water.",
                        "no acoustic water: its coupling with the dam is not diagonal, so no step would be explicit",
                        "use  scheme = \"hht\"  in [time], or  model = \"added-mass\"  in [reservoir]");
    if (problem.options.moving_base)
        refuse_explicit("time.scheme = \"central-difference\" with rock that lets waves out.",
                        "rock whose every unknown has mass: a part of what is reduced has none",
                        "use  scheme = \"hht\"  in [time], or  boundary = \"fixed\"  in [foundation]");
    if (problem.other_damping() > 1e-9)
        refuse_explicit(
            "time.scheme = \"central-difference\" with damping that is neither mass- nor stiffness-proportional.",
            "Rayleigh damping", "use  scheme = \"hht\"  in [time]");
}

/// Rock without mass is infinitely fast: no step would be small enough. By the mass of its unknowns, not by a key.
void check_mass(const SparseMatrix& lumped)
{
    const VectorXd diagonal = lumped.diagonal();
    const auto massless = (diagonal.array() <= 0.0).count();
    if (massless == 0) return;
    refuse_explicit(fmt::format("time.scheme = \"central-difference\" with {} unknowns without mass.", massless),
                    "mass on every unknown: without it the highest frequency is infinite and no step is stable",
                    "write  mass = \"with-mass\"  in [foundation], or use  scheme = \"hht\"  in [time]");
}

class ExplicitRun {
public:
    ExplicitRun(const Model& model, const GroundMotion& motion, const TiedRunOptions& options)
        : problem_(model, motion, options), options_(options), motion_(motion)
    {
    }
    History go();

private:
    ExplicitSystem system() const;
    HistoryRow row(const State& state, const GroundState& ground, const EnergyLedger& ledger) const;
    void shake(CentralDifference& scheme, HistoryWriter& writer, std::int64_t steps);

    TiedProblem problem_;
    const TiedRunOptions& options_;
    const GroundMotion& motion_;
    History history_;
};

ExplicitSystem ExplicitRun::system() const
{
    const Model& model = problem_.model;
    const RayleighConstants& damping = options_.damping.constants;
    const Index n = problem_.structure.system.size();
    ExplicitSystem system;
    system.mass = lumped_mass(model.dofs, model.inertia_x, model.inertia_y, n);
    const auto inertia = [&model](const Eigen::Vector2d& direction) {
        return inertia_vector(model.mesh, model.dofs, without_rock_density(model.materials), direction,
                              model.mass_kind);
    };
    system.mass_damping = damping.mass * lumped_mass(model.dofs, inertia({1.0, 0.0}), inertia({0.0, 1.0}), n);
    system.stiffness = problem_.structure.system.stiffness;
    system.stiffness_damping = damping.stiffness;
    return system;
}

HistoryRow ExplicitRun::row(const State& state, const GroundState& ground, const EnergyLedger& ledger) const
{
    const Index x = problem_.crest_x, y = problem_.crest_y;
    TiedSums sums;
    sums.crest = {state.displacement[x], state.displacement[y]};
    sums.crest_accel = {state.acceleration[x], state.acceleration[y]};
    sums.inertia = {problem_.mass_x.dot(state.acceleration), problem_.mass_y.dot(state.acceleration)};
    sums.damping = {problem_.damped_x.dot(state.velocity), problem_.damped_y.dot(state.velocity)};
    HistoryRow row = problem_.row(state.time, ground, sums);
    row.energy = ledger.energy();
    row.imbalance = ledger.imbalance();
    return row;
}

void ExplicitRun::shake(CentralDifference& scheme, HistoryWriter& writer, std::int64_t steps)
{
    VectorXd load;
    problem_.load.evaluate(problem_.ground.at(0.0), load);
    State before = scheme.start(problem_.start, VectorXd::Zero(problem_.start.size()), load), after;
    EnergyLedger ledger(before);
    writer.enter(row(before, problem_.ground.at(0.0), ledger), 0);
    const StepConstants constants = scheme.constants();
    for (std::int64_t n = 1; n <= steps; ++n) {
        const double time = scheme.dt() * static_cast<double>(n);
        const GroundState ground = problem_.ground.at(time);
        problem_.load.evaluate(ground, load);
        scheme.step(before, load, after);
        after.time = time; // not summed up
        ledger.add_step(before, after, constants);
        if (!std::isfinite(ledger.imbalance())) {
            history_.status = TiedRunStatus::diverged;
            history_.ending = {NoteKind::not_finite, {n, time}};
            break;
        }
        std::swap(before, after);
        writer.enter(row(before, ground, ledger), n);
        if (writer.stopped(n, time)) break;
    }
    writer.finish(ledger.largest_scale());
    history_.displacement = problem_.all_displacements(before.displacement);
}

History ExplicitRun::go()
{
    history_.method = "central difference";
    check(problem_);
    if (!problem_.prepare()) {
        history_.status = TiedRunStatus::solver_failed;
        history_.ending = problem_.structure.solver.note();
        return std::move(history_);
    }
    ExplicitSystem parts = system();
    check_mass(parts.mass);
    const ExplicitLimit limit = explicit_limit(parts.mass, parts.stiffness, parts.stiffness_damping);
    const double dt = explicit_step(motion_.dt, options_.dt, limit);
    const std::int64_t steps = step_count(problem_.ground, options_, dt);
    const int keep = options_.keep_every * static_cast<int>(std::lround(motion_.dt / dt));
    HistoryWriter writer(history_, options_, dt, steps, keep);
    history_.unknowns = parts.stiffness.rows();
    history_.step_limit = limit.dt;
    history_.notes.push_back(limit.note());
    history_.notes.push_back({NoteKind::explicit_steps, {dt, keep * dt}});
    CentralDifference scheme(std::move(parts), dt);
    shake(scheme, writer, steps);
    return std::move(history_);
}

} // namespace

Note ExplicitLimit::note() const
{
    const double highest = highest_frequency / (2.0 * std::numbers::pi);
    if (dt < dt_undamped) return {NoteKind::explicit_limit_damped, {dt, highest, dt_undamped}};
    return {NoteKind::explicit_limit, {dt, highest}};
}

ExplicitLimit explicit_limit(const SparseMatrix& lumped, const SparseMatrix& stiffness, double stiffness_damping)
{
    ExplicitLimit limit;
    LinearSystem system;
    system.mass = lumped;
    system.stiffness = stiffness;
    limit.highest_frequency = highest_frequency(system);
    limit.dt = central_difference_limit(limit.highest_frequency, stiffness_damping);
    limit.dt_undamped = central_difference_limit(limit.highest_frequency, 0.0);
    return limit;
}

double explicit_step(double motion_dt, std::optional<double> asked, const ExplicitLimit& limit)
{
    const double most = explicit_step_share * limit.dt;
    const double parts_below = std::ceil(motion_dt / most);
    if (!asked) return motion_dt / parts_below;
    if (*asked > limit.dt)
        refuse_explicit(
            fmt::format("time.dt_s = {:g} is above the limit of the central difference, {:.6g} s.", *asked, limit.dt),
            fmt::format("at most {:.6g} s: {}", limit.dt, text_of(limit.note())),
            fmt::format("leave dt_s out for {:g} s / {:.0f}, or use  scheme = \"hht\"  in [time], stable at "
                        "any step",
                        motion_dt, parts_below));
    const double parts = std::round(motion_dt / *asked);
    if (!(*asked > 0.0) || parts < 1.0 || std::abs(parts * *asked - motion_dt) > 1e-9 * motion_dt)
        refuse_explicit(
            fmt::format("time.dt_s = {:g} is no whole part of the record's step of {:g} s.", *asked, motion_dt),
            fmt::format("{:g} s divided by 1, 2, 3, ...", motion_dt),
            fmt::format("leave dt_s out for {:g} s / {:.0f}", motion_dt, parts_below));
    return motion_dt / parts;
}

History integrate_explicit(const Model& model, const GroundMotion& motion, const TiedRunOptions& options)
{
    return ExplicitRun(model, motion, options).go();
}

namespace {

/// A start vector no mode is orthogonal to in practice: alternating signs, unequal sizes, always the same.
Eigen::VectorXd start_vector(Eigen::Index size)
{
    Eigen::VectorXd x(size);
    for (Eigen::Index k = 0; k < size; ++k)
        x[k] = (k % 2 == 0 ? 1.0 : -1.0) * (1.0 + 0.3 * std::sin(1.7 * static_cast<double>(k)));
    return x;
}

} // namespace

/// Lanczos' method for M⁻¹K in the inner product of M, every vector made orthogonal to all before it.
double highest_frequency(const LinearSystem& system)
{
    const std::vector<char> massless = massless_unknowns(system.mass);
    if (std::find(massless.begin(), massless.end(), 1) != massless.end())
        return std::numeric_limits<double>::infinity();
    LinearSolver mass;
    if (!mass.factorise(system.mass).ok()) return std::numeric_limits<double>::infinity();
    const Eigen::Index size = system.size(), most = std::min<Eigen::Index>(80, size);
    Eigen::MatrixXd basis(size, most), momenta(size, most);
    Eigen::VectorXd diagonal(most), off_diagonal(most);
    Eigen::VectorXd next = start_vector(size);
    Eigen::Index steps = 0;
    double norm = std::sqrt(next.dot(system.mass * next));
    while (steps < most && norm > 1e-10 * (steps > 0 ? diagonal[0] : 0.0)) {
        basis.col(steps) = next / norm;
        momenta.col(steps) = system.mass * basis.col(steps);
        next = mass.solve(Eigen::VectorXd(system.stiffness * basis.col(steps)));
        diagonal[steps] = next.dot(momenta.col(steps));
        for (int twice = 0; twice < 2; ++twice)
            next -= basis.leftCols(steps + 1) * (momenta.leftCols(steps + 1).transpose() * next);
        norm = std::sqrt(std::max(0.0, next.dot(system.mass * next)));
        off_diagonal[steps++] = norm;
    }
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(diagonal.head(steps), off_diagonal.head(std::max<Eigen::Index>(steps - 1, 0)),
                                Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(0.0, ritz.eigenvalues().maxCoeff()));
}

} // namespace damslip::fe2d
