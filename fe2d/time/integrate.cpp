#include "fe2d/time/integrate.hpp"

#include "core/input_error.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/time/structure_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::fe2d {

namespace {

using Eigen::VectorXd;

/// The water of a run beside the dam.
struct WaterPart {
    CoupledSystem coupled;
    CoupledEnergy energy;
    Eigen::RowVectorXd force_x, force_y; ///< of the pressures on the dam, fixed nodes included [m]
};

WaterPart water_part(const Model& model, const LinearSystem& structure, const FluidModel& water)
{
    assert(model.added_mass.nonZeros() == 0 && structure.damping_low_rank.empty());
    const SparseMatrix coupling = face_coupling(model.mesh, model.dofs, water.reservoir, water.dofs, water.unknowns());
    const SparseMatrix whole =
        face_coupling(model.mesh, all_dofs(model.mesh, 2), water.reservoir, water.dofs, water.unknowns());
    Eigen::VectorXd x = Eigen::VectorXd::Zero(whole.rows()), y = x;
    for (Eigen::Index i = 0; i + 1 < whole.rows(); i += 2) {
        x[i] = 1.0;
        y[i + 1] = 1.0;
    }
    CoupledSystem coupled = couple(structure.mass, structure.damping, structure.stiffness,
                                   SparseMatrix(coupling.topRows(structure.size())), water);
    CoupledEnergy energy(coupled, water, structure.damping);
    return {std::move(coupled), std::move(energy), x.transpose() * whole, y.transpose() * whole};
}

VectorXd with_water(const VectorXd& structure, Eigen::Index size)
{
    VectorXd all = VectorXd::Zero(size);
    all.head(structure.size()) = structure;
    return all;
}

/// Everything one run needs, made once.
class Run {
public:
    Run(const Model& model, const GroundMotion& motion, const TiedRunOptions& options);
    History go();

private:
    bool prepare();
    void let_base_move();
    void add_water();
    WaterFloor floor() const;
    void step(const StepOperator& step, const State& before, const VectorXd& load, State& after);
    void enter(const State& before, const State& after, const StepConstants& constants, EnergyLedger& ledger) const;
    State start(const VectorXd& load) const;
    HistoryRow row(const State& state, const GroundState& ground, const EnergyLedger& ledger) const;
    double dashpot_work(const State& before, const State& after) const;

    TiedProblem problem_;
    const TiedRunOptions& options_;
    double dt_;
    std::int64_t steps_;
    std::optional<WaterPart> water_;
    std::optional<LinearIntegrator> integrator_;
    std::optional<BaseCoupling> base_; ///< where it moves
    History history_;
    HistoryWriter writer_;
};

Run::Run(const Model& model, const GroundMotion& motion, const TiedRunOptions& options)
    : problem_(model, motion, options), options_(options), dt_(step_of(motion, options)),
      steps_(step_count(problem_.ground, options, dt_)), writer_(history_, options, dt_, steps_, options.keep_every)
{
    history_.unknowns = problem_.structure.system.size();
    history_.method = options.scheme.alpha != 0.0 ? fmt::format("HHT, alpha = {:.4g}", options.scheme.alpha)
                                                  : fmt::format("Newmark, gamma = {:.4g}, beta = {:.4g}",
                                                                options.scheme.gamma, options.scheme.beta);
}

bool Run::prepare()
{
    if (!problem_.prepare()) return false;
    const LinearSystem& system = problem_.structure.system;
    if (options_.moving_base) let_base_move();
    if (options_.water) add_water();
    if (!integrator_) integrator_.emplace(system, options_.scheme, options_.solver);
    if (!options_.scheme.unconditionally_stable())
        check_step(options_.scheme, dt_,
                   options_.moving_base ? std::numeric_limits<double>::infinity() : highest_frequency(system));
    const StepOperator& step = integrator_->step_operator(dt_);
    problem_.structure.solver = step.report();
    if (problem_.structure.solver.ok() && options_.moving_base) {
        base_.emplace(options_.moving_base(step.constants(), options_.damping.constants.stiffness), step,
                      unknowns_of_base(problem_.model), integrator_->system().size(), floor());
        history_.unknowns += base_->base().unknowns();
        if (!base_->ok()) problem_.structure.solver.status = SolverStatus::not_positive_definite;
    }
    return problem_.structure.solver.ok();
}

/// From the statics on condensed rock to the dam alone: what held its base stays as a load.
void Run::let_base_move()
{
    assert(options_.rock == RockTreatment::condensed && problem_.structure.rock);
    problem_.structure.system = dam_on_free_base(problem_.model, options_.damping.constants);
    const VectorXd internal = problem_.structure.system.stiffness * problem_.start;
    for (const Eigen::Index k : unknowns_of_base(problem_.model)) problem_.load.still[k] = internal[k];
}

WaterFloor Run::floor() const
{
    if (!water_) return {};
    return {unknowns_of_floor(water_->coupled, *options_.water), water_->coupled.scale};
}

/// The system grows by the water; loads get its rows.
void Run::add_water()
{
    water_.emplace(water_part(problem_.model, problem_.structure.system, *options_.water));
    const CoupledSystem& coupled = water_->coupled;
    GroundLoad& load = problem_.load;
    for (VectorXd* part : {&load.still, &load.mass_x, &load.mass_y, &load.damped_x, &load.damped_y})
        if (part->size() > 0) *part = with_water(*part, coupled.size());
    load.velocity_x = coupled.velocity_x;
    load.velocity_y = coupled.velocity_y;
    load.displacement_y = coupled.displacement_y;
    history_.unknowns = coupled.size();
    SolverOptions solver = options_.solver;
    solver.definiteness = Definiteness::quasi_definite;
    integrator_.emplace(LinearSystem{coupled.mass, coupled.damping, coupled.stiffness, {}}, options_.scheme, solver);
}

/// At rest under the static loads. Water at rest has φ = φ̇ = 0; φ̈ = 0 too, because the ground's velocity is still zero.
State Run::start(const VectorXd& load) const
{
    const Eigen::Index n = problem_.structure.system.size();
    if (!water_) return integrator_->start(problem_.start, VectorXd::Zero(n), load);
    const LinearIntegrator structure(problem_.structure.system, options_.scheme, options_.solver);
    const State alone = structure.start(problem_.start, VectorXd::Zero(n), load.head(n));
    const Eigen::Index size = water_->coupled.size();
    return integrator_->state(with_water(alone.displacement, size), VectorXd::Zero(size),
                              with_water(alone.acceleration, size), load);
}

/// On the edges of the rock box, of one step [J/m].
double Run::dashpot_work(const State& before, const State& after) const
{
    const SparseMatrix& dashpots = problem_.model.edge_damping;
    if (dashpots.nonZeros() == 0) return 0.0;
    const Eigen::Index n = dashpots.rows();
    const VectorXd velocity = (before.velocity + after.velocity).head(n);
    return 0.5 * (after.displacement - before.displacement).head(n).dot(dashpots * velocity);
}

void Run::step(const StepOperator& step, const State& before, const VectorXd& load, State& after)
{
    const FreeStep free = integrator_->free_step(step, before, load);
    if (base_)
        integrator_->finish_step(step, before, load, free, base_->step(free, before), after);
    else
        integrator_->finish_step(step, before, load, free, after);
}

/// The step in the ledger.
void Run::enter(const State& before, const State& after, const StepConstants& constants, EnergyLedger& ledger) const
{
    InterfaceWork work = water_ ? water_->energy.work(before, after) : InterfaceWork{};
    work.dashpots = dashpot_work(before, after);
    if (base_) {
        work.numerical += base_->numerical_work();
        work.floor = base_->floor_work();
    }
    const Energy base = base_ ? base_->base().energy() : Energy{};
    if (water_)
        ledger.add_step(water_->energy.view(before), water_->energy.view(after), constants, work, base);
    else
        ledger.add_step(before, after, constants, work, base);
}

HistoryRow Run::row(const State& state, const GroundState& ground, const EnergyLedger& ledger) const
{
    const Eigen::Index n = problem_.structure.system.size(), x = problem_.crest_x, y = problem_.crest_y;
    TiedSums sums;
    sums.crest = {state.displacement[x], state.displacement[y]};
    sums.crest_accel = {state.acceleration[x], state.acceleration[y]};
    sums.inertia = {problem_.mass_x.dot(state.acceleration.head(n)), problem_.mass_y.dot(state.acceleration.head(n))};
    sums.damping = {problem_.damped_x.dot(state.velocity.head(n)), problem_.damped_y.dot(state.velocity.head(n))};
    if (water_) {
        const VectorXd pressures = water_->coupled.pressures(state.velocity);
        sums.water_force = {water_->force_x.dot(pressures), water_->force_y.dot(pressures)};
    }
    HistoryRow row = problem_.row(state.time, ground, sums);
    row.energy = ledger.energy();
    row.imbalance = ledger.imbalance();
    return row;
}

History Run::go()
{
    if (!prepare()) {
        history_.status = TiedRunStatus::solver_failed;
        history_.ending = problem_.structure.solver.note();
        return std::move(history_);
    }
    // The first state sees the ground acceleration of the first sample: a₀ in equilibrium with it.
    VectorXd load;
    problem_.load.evaluate(problem_.ground.at(0.0), load);
    State before = start(load), after;
    EnergyLedger ledger(water_ ? water_->energy.view(before) : before);
    writer_.enter(row(before, problem_.ground.at(0.0), ledger), 0);

    const StepOperator& step = integrator_->step_operator(dt_);
    for (std::int64_t n = 1; n <= steps_; ++n) {
        const double time = dt_ * static_cast<double>(n);
        const GroundState ground = problem_.ground.at(time);
        problem_.load.evaluate(ground, load);
        this->step(step, before, load, after);
        after.time = time; // not summed up
        enter(before, after, step.constants(), ledger);
        if (!std::isfinite(ledger.imbalance())) {
            history_.status = TiedRunStatus::diverged;
            history_.ending = {NoteKind::not_finite, {n, time}};
            break;
        }
        std::swap(before, after);
        writer_.enter(row(before, ground, ledger), n);
        if (writer_.stopped(n, time)) break;
    }
    writer_.finish(ledger.largest_scale());
    history_.factorisations = integrator_->factorisations();
    history_.displacement = problem_.all_displacements(before.displacement.head(problem_.structure.system.size()));
    return std::move(history_);
}

} // namespace

History integrate(const Model& model, const GroundMotion& motion, const TiedRunOptions& options)
{
    return Run(model, motion, options).go();
}

using Eigen::Index;

double step_of(const GroundMotion& motion, const TiedRunOptions& options)
{
    const double dt = options.dt.value_or(motion.dt);
    const double parts = std::round(motion.dt / dt);
    if (dt > 0.0 && parts >= 1.0 && std::abs(parts * dt - motion.dt) <= 1e-9 * motion.dt) return motion.dt / parts;
    Diagnostic diagnostic;
    diagnostic.problem =
        fmt::format("time.dt_s = {:g} is no whole part of the record's step of {:g} s.", dt, motion.dt);
    diagnostic.expected = fmt::format("{0:g} s divided by 1, 2, 3, ...", motion.dt);
    diagnostic.fix =
        fmt::format("write  dt_s = {:g}", motion.dt / std::max(1.0, std::ceil(motion.dt / std::max(dt, 1e-6))));
    throw InputError(std::move(diagnostic));
}

std::int64_t step_count(const GroundHistory& ground, const TiedRunOptions& options, double dt)
{
    return std::llround(std::ceil((ground.duration() + options.free_vibration) / dt - 1e-6));
}

TiedProblem::TiedProblem(const Model& model_, const GroundMotion& motion, const TiedRunOptions& options_)
    : model(model_), options(options_), ground(motion),
      total_velocity(options_.damping.mass == MassDamping::total && options_.damping.constants.mass != 0.0),
      structure(structure_system(model_, options_.damping.constants, options_.rock)),
      crest_x(model_.dofs(model_.mesh.crest.back(), 0)), crest_y(model_.dofs(model_.mesh.crest.back(), 1))
{
    assert(options.keep_every >= 1 && options.free_vibration >= 0.0);
}

/// Rows of the dam's own and added mass times rigid translations; nodal vectors of the model may hold rock unknowns.
void TiedProblem::balance()
{
    const Index n = structure.system.size();
    const double a_m = options.damping.constants.mass;
    const Materials dam_only = without_rock_density(model.materials);
    const DofMap all = all_dofs(model.mesh, 2);
    for (const int c : {0, 1}) {
        const Eigen::Vector2d direction = Eigen::Vector2d::Unit(c);
        const VectorXd dam = inertia_vector(model.mesh, model.dofs, dam_only, direction, model.mass_kind);
        const VectorXd whole = inertia_vector(model.mesh, model.dofs, model.loaded, direction, model.mass_kind);
        const VectorXd& moving = c == 0 ? model.inertia_x : model.inertia_y;
        // What moves, less the rock's own share.
        (c == 0 ? mass_x : mass_y) = (moving - whole + dam).head(n);
        (c == 0 ? damped_x : damped_y) = a_m * dam.head(n);
        const double dam_mass = inertia_vector(model.mesh, all, dam_only, direction).sum();
        const double rock_mass = inertia_vector(model.mesh, all, model.loaded, direction).sum() - dam_mass;
        total[c] = model.total_mass[c] - rock_mass;
        damped_total[c] = a_m * dam_mass;
    }
}

bool TiedProblem::prepare()
{
    if (!structure.solver.ok()) return false;
    const Index n = structure.system.size();
    load.still = options.static_load.size() > 0 ? structure.reduce_load(options.static_load) : VectorXd::Zero(n);
    load.mass_x = model.inertia_x.head(n);
    load.mass_y = model.inertia_y.head(n);
    balance();
    if (total_velocity) {
        const double a_m = options.damping.constants.mass;
        const auto inertia = [&](const Eigen::Vector2d& direction) {
            return inertia_vector(model.mesh, model.dofs, without_rock_density(model.materials), direction,
                                  model.mass_kind);
        };
        load.damped_x = a_m * inertia({1.0, 0.0}).head(n);
        load.damped_y = a_m * inertia({0.0, 1.0}).head(n);
    }
    if (options.start_displacement.size() > 0)
        start = options.start_displacement.head(n);
    else
        start = load.still.isZero(0.0) ? VectorXd::Zero(n) : VectorXd(static_response(load.still));
    return structure.solver.ok();
}

Eigen::MatrixXd TiedProblem::static_response(const Eigen::MatrixXd& loads)
{
    if (!static_factor_) {
        static_factor_.emplace(options.solver);
        structure.solver = static_factor_->factorise(structure.system.stiffness);
    }
    if (!structure.solver.ok()) return Eigen::MatrixXd::Zero(loads.rows(), loads.cols());
    return static_factor_->solve(loads);
}

namespace {

VectorXd translation(const DofMap& dofs, int component, Index size)
{
    VectorXd motion = VectorXd::Zero(size);
    for (int node = 0; node < dofs.node_count(); ++node)
        if (const int dof = dofs(node, component); dof != no_dof && dof < size) motion[dof] = 1.0;
    return motion;
}

} // namespace

VectorXd TiedProblem::rigid_x() const
{
    return translation(model.dofs, 0, structure.system.size());
}

VectorXd TiedProblem::rigid_y() const
{
    return translation(model.dofs, 1, structure.system.size());
}

double TiedProblem::other_damping() const
{
    const RayleighConstants& c = options.damping.constants;
    const LinearSystem& s = structure.system;
    const double all = s.damping.norm();
    return all > 0.0 ? SparseMatrix(s.damping - c.mass * structure.damped_mass - c.stiffness * s.stiffness).norm() / all
                     : 0.0;
}

HistoryRow TiedProblem::row(double time, const GroundState& g, const TiedSums& sums) const
{
    HistoryRow row;
    row.time = time;
    row.ground_accel_h = g.accel_h;
    row.ground_accel_v = g.accel_v;
    row.crest_x = sums.crest.x();
    row.crest_y = sums.crest.y();
    row.crest_accel_x = sums.crest_accel.x() - g.accel_h;
    row.crest_accel_y = sums.crest_accel.y() + g.accel_v;
    const double v_h = total_velocity ? g.velocity_h : 0.0, v_v = total_velocity ? g.velocity_v : 0.0;
    const double inertia_x = sums.inertia.x() - total.x() * g.accel_h;
    const double inertia_y = sums.inertia.y() + total.y() * g.accel_v;
    const double damping_x = sums.damping.x() - damped_total.x() * v_h;
    const double damping_y = sums.damping.y() + damped_total.y() * v_v;
    row.water_force_x = sums.water_force.x();
    row.base_shear = options.static_resultant.x() - inertia_x - damping_x + sums.water_force.x();
    row.base_normal = -options.static_resultant.y() + inertia_y + damping_y - sums.water_force.y();
    return row;
}

VectorXd TiedProblem::all_displacements(const VectorXd& of_system) const
{
    return structure.expand(of_system,
                            options.static_load.size() > 0 ? options.static_load : VectorXd::Zero(structure.full_size));
}

HistoryWriter::HistoryWriter(History& history, const TiedRunOptions& options, double dt, std::int64_t steps,
                             int keep_every)
    : history_(history), options_(options), dt_(dt), steps_(steps), keep_every_(keep_every)
{
    history_.time_step = dt;
    history_.notes = options.damping.notes;
}

void HistoryWriter::enter(const HistoryRow& row, std::int64_t step)
{
    if (step == 0) start_crest_x_ = row.crest_x;
    history_.steps = step;
    history_.peak_crest_x = std::max(history_.peak_crest_x, std::abs(row.crest_x - start_crest_x_));
    history_.peak_crest_accel_x = std::max(history_.peak_crest_accel_x, std::abs(row.crest_accel_x));
    history_.peak_base_shear = std::max(history_.peak_base_shear, row.base_shear);
    history_.peak_water_force = std::max(history_.peak_water_force, std::abs(row.water_force_x));
    history_.largest_imbalance = std::max(history_.largest_imbalance, std::abs(row.imbalance));
    if (step % keep_every_ == 0 || step == steps_) history_.rows.push_back(row);
}

bool HistoryWriter::stopped(std::int64_t step, double time)
{
    if (!options_.progress ||
        options_.progress({time, dt_ * static_cast<double>(steps_), step, steps_}) == RunAnswer::go_on)
        return false;
    history_.status = TiedRunStatus::cancelled;
    history_.ending = {NoteKind::stopped_by_user, {time, dt_ * static_cast<double>(steps_)}};
    return true;
}

void HistoryWriter::finish(double energy_scale)
{
    history_.energy_scale = energy_scale;
    if (energy_scale > 0.0) history_.largest_imbalance /= energy_scale;
    if (history_.status == TiedRunStatus::complete)
        history_.ending = {NoteKind::steps_done, {history_.steps, dt_, history_.unknowns}};
}

} // namespace damslip::fe2d
