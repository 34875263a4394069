#include "fe2d/time/integrate.hpp"

#include "core/input_error.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/face_coupling.hpp"
#include "fe2d/time/coupled_energy.hpp"
#include "fe2d/time/ground_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

namespace {

using Eigen::VectorXd;

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

/// Rows of the dam's own and added mass times rigid translations, for forces on the base.
struct BaseBalance {
    VectorXd mass_x, mass_y;     ///< M_dam r_x, M_dam r_y on the system's unknowns [kg/m]
    VectorXd damped_x, damped_y; ///< a_M M_s r of the dam [kg/(m s)]
    Eigen::Vector2d total,
        damped_total = Eigen::Vector2d::Zero(); ///< rᵀM r, a_M rᵀM_s r with fixed nodes [kg/m], [kg/(m s)]
};

/// The dam's part of a nodal vector that may hold rock unknowns.
VectorXd part_of_dam(const VectorXd& values, Eigen::Index size)
{
    return values.head(size);
}

BaseBalance base_balance(const Model& model, Eigen::Index size, double mass_coefficient)
{
    Materials dam_only = model.materials;
    dam_only.rock.density = 0.0;
    dam_only.curtain.density = 0.0;
    const DofMap all = all_dofs(model.mesh, 2);
    BaseBalance balance;
    for (const int c : {0, 1}) {
        const Eigen::Vector2d direction = Eigen::Vector2d::Unit(c);
        const VectorXd structure = inertia_vector(model.mesh, model.dofs, dam_only, direction, model.mass_kind);
        const VectorXd whole = inertia_vector(model.mesh, model.dofs, model.materials, direction, model.mass_kind);
        const VectorXd& moving = c == 0 ? model.inertia_x : model.inertia_y;
        // What moves, less the rock's own share.
        (c == 0 ? balance.mass_x : balance.mass_y) = part_of_dam(moving - whole + structure, size);
        (c == 0 ? balance.damped_x : balance.damped_y) = mass_coefficient * part_of_dam(structure, size);
        const double dam_mass = inertia_vector(model.mesh, all, dam_only, direction).sum();
        const double rock_mass = inertia_vector(model.mesh, all, model.materials, direction).sum() - dam_mass;
        balance.total[c] = model.total_mass[c] - rock_mass;
        balance.damped_total[c] = mass_coefficient * dam_mass;
    }
    return balance;
}

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
    void add_water();
    State start(const VectorXd& load) const;
    VectorXd static_displacement();
    HistoryRow row(const State& state, const GroundState& ground, const EnergyLedger& ledger) const;
    void enter(const HistoryRow& row, std::int64_t step);
    bool stopped(std::int64_t step, double time);
    void finish(const State& state, const EnergyLedger& ledger);

    const Model& model_;
    const TiedRunOptions& options_;
    GroundHistory ground_;
    double dt_;
    std::int64_t steps_;
    bool total_velocity_;
    StructureSystem structure_;
    BaseBalance balance_;
    GroundLoad load_;
    VectorXd start_displacement_; ///< of the structure
    std::optional<WaterPart> water_;
    std::optional<LinearIntegrator> integrator_;
    History history_;
    double start_crest_x_ = 0.0;
};

Run::Run(const Model& model, const GroundMotion& motion, const TiedRunOptions& options)
    : model_(model), options_(options), ground_(motion), dt_(step_of(motion, options)),
      steps_(std::llround(std::ceil((ground_.duration() + options.free_vibration) / dt_ - 1e-6))),
      total_velocity_(options.damping.mass == MassDamping::total && options.damping.constants.mass != 0.0),
      structure_(structure_system(model, options.damping.constants, options.rock))
{
    assert(options.keep_every >= 1 && options.free_vibration >= 0.0);
    history_.time_step = dt_;
    history_.unknowns = structure_.system.size();
    history_.notes = options.damping.notes;
}

VectorXd Run::static_displacement()
{
    const Eigen::Index n = structure_.system.size();
    if (load_.still.isZero(0.0)) return VectorXd::Zero(n);
    LinearSolver solver(options_.solver);
    structure_.solver = solver.factorise(structure_.system.stiffness);
    return structure_.solver.ok() ? solver.solve(VectorXd(load_.still.head(n))) : VectorXd::Zero(n);
}

bool Run::prepare()
{
    const Eigen::Index n = structure_.system.size();
    if (!structure_.solver.ok()) return false;
    load_.still = options_.static_load.size() > 0 ? structure_.reduce_load(options_.static_load) : VectorXd::Zero(n);
    load_.mass_x = part_of_dam(model_.inertia_x, n);
    load_.mass_y = part_of_dam(model_.inertia_y, n);
    balance_ = base_balance(model_, n, options_.damping.constants.mass);
    if (total_velocity_) {
        const double a_m = options_.damping.constants.mass;
        load_.damped_x =
            a_m *
            part_of_dam(inertia_vector(model_.mesh, model_.dofs, model_.materials, {1.0, 0.0}, model_.mass_kind), n);
        load_.damped_y =
            a_m *
            part_of_dam(inertia_vector(model_.mesh, model_.dofs, model_.materials, {0.0, 1.0}, model_.mass_kind), n);
    }
    if (options_.water) add_water();
    if (!integrator_) integrator_.emplace(structure_.system, options_.scheme, options_.solver);
    if (!options_.scheme.unconditionally_stable())
        check_step(options_.scheme, dt_, highest_frequency(structure_.system));
    structure_.solver = integrator_->step_operator(dt_).report();
    return structure_.solver.ok();
}

/// The system grows by the water; loads get its rows.
void Run::add_water()
{
    water_.emplace(water_part(model_, structure_.system, *options_.water));
    const CoupledSystem& coupled = water_->coupled;
    for (VectorXd* load : {&load_.still, &load_.mass_x, &load_.mass_y, &load_.damped_x, &load_.damped_y})
        if (load->size() > 0) *load = with_water(*load, coupled.size());
    load_.velocity_x = coupled.velocity_x;
    load_.velocity_y = coupled.velocity_y;
    load_.displacement_y = coupled.displacement_y;
    history_.unknowns = coupled.size();
    SolverOptions solver = options_.solver;
    solver.definiteness = Definiteness::quasi_definite;
    integrator_.emplace(LinearSystem{coupled.mass, coupled.damping, coupled.stiffness, {}}, options_.scheme, solver);
}

/// At rest under the static loads. Water at rest has φ = φ̇ = 0; φ̈ = 0 too, because the ground's velocity is still zero.
State Run::start(const VectorXd& load) const
{
    const Eigen::Index n = structure_.system.size();
    if (!water_) return integrator_->start(start_displacement_, VectorXd::Zero(n), load);
    const LinearIntegrator structure(structure_.system, options_.scheme, options_.solver);
    const State alone = structure.start(start_displacement_, VectorXd::Zero(n), load.head(n));
    const Eigen::Index size = water_->coupled.size();
    return integrator_->state(with_water(alone.displacement, size), VectorXd::Zero(size),
                              with_water(alone.acceleration, size), load);
}

/// Forces on the base from the balance of the whole dam: with a rigid translation r the internal forces drop out, so
/// force of the dam on the rock = rᵀR_static + rᵀH p - rᵀM (ü + r a_g) - a_M rᵀM_s (u̇ [+ r v_g]).
HistoryRow Run::row(const State& state, const GroundState& ground, const EnergyLedger& ledger) const
{
    HistoryRow row;
    row.time = state.time;
    row.ground_accel_h = ground.accel_h;
    row.ground_accel_v = ground.accel_v;
    const int crest = model_.mesh.crest.back(), x = model_.dofs(crest, 0), y = model_.dofs(crest, 1);
    row.crest_x = state.displacement[x];
    row.crest_y = state.displacement[y];
    row.crest_accel_x = state.acceleration[x] - ground.accel_h;
    row.crest_accel_y = state.acceleration[y] + ground.accel_v;
    const double v_h = total_velocity_ ? ground.velocity_h : 0.0, v_v = total_velocity_ ? ground.velocity_v : 0.0;
    const Eigen::Index n = structure_.system.size();
    const VectorXd acceleration = state.acceleration.head(n), velocity = state.velocity.head(n);
    const double inertia_x = balance_.mass_x.dot(acceleration) - balance_.total.x() * ground.accel_h;
    const double inertia_y = balance_.mass_y.dot(acceleration) + balance_.total.y() * ground.accel_v;
    const double damping_x = balance_.damped_x.dot(velocity) - balance_.damped_total.x() * v_h;
    const double damping_y = balance_.damped_y.dot(velocity) + balance_.damped_total.y() * v_v;
    row.base_shear = options_.static_resultant.x() - inertia_x - damping_x;
    row.base_normal = -options_.static_resultant.y() + inertia_y + damping_y;
    if (water_) {
        const VectorXd pressures = water_->coupled.pressures(state.velocity);
        row.water_force_x = water_->force_x.dot(pressures);
        row.base_shear += row.water_force_x;
        row.base_normal -= water_->force_y.dot(pressures);
    }
    row.energy = ledger.energy();
    row.imbalance = ledger.imbalance();
    return row;
}

void Run::enter(const HistoryRow& row, std::int64_t step)
{
    history_.peak_crest_x = std::max(history_.peak_crest_x, std::abs(row.crest_x - start_crest_x_));
    history_.peak_crest_accel_x = std::max(history_.peak_crest_accel_x, std::abs(row.crest_accel_x));
    history_.peak_base_shear = std::max(history_.peak_base_shear, row.base_shear);
    history_.peak_water_force = std::max(history_.peak_water_force, std::abs(row.water_force_x));
    history_.largest_imbalance = std::max(history_.largest_imbalance, std::abs(row.imbalance));
    if (step % options_.keep_every == 0 || step == steps_) history_.rows.push_back(row);
}

bool Run::stopped(std::int64_t step, double time)
{
    if (!options_.progress ||
        options_.progress({time, dt_ * static_cast<double>(steps_), step, steps_}) == RunAnswer::go_on)
        return false;
    history_.status = TiedRunStatus::cancelled;
    history_.status_text = fmt::format("stopped by the user at {:.4g} s of {:.4g} s; results up to there are kept",
                                       time, dt_ * static_cast<double>(steps_));
    return true;
}

void Run::finish(const State& state, const EnergyLedger& ledger)
{
    history_.factorisations = integrator_->factorisations();
    history_.energy_scale = ledger.largest_scale();
    if (history_.energy_scale > 0.0) history_.largest_imbalance /= history_.energy_scale;
    const VectorXd load = options_.static_load.size() > 0 ? options_.static_load : VectorXd::Zero(structure_.full_size);
    history_.displacement = structure_.expand(state.displacement.head(structure_.system.size()), load);
    if (history_.status == TiedRunStatus::complete)
        history_.status_text = fmt::format("{} steps of {:g} s, {} unknowns", history_.steps, dt_, history_.unknowns);
}

History Run::go()
{
    if (prepare()) start_displacement_ = static_displacement();
    if (!structure_.solver.ok()) {
        history_.status = TiedRunStatus::solver_failed;
        history_.status_text = structure_.solver.text();
        return std::move(history_);
    }
    // The first state sees the ground acceleration of the first sample: a₀ in equilibrium with it.
    VectorXd load;
    load_.evaluate(ground_.at(0.0), load);
    State before = start(load), after;
    EnergyLedger ledger(water_ ? water_->energy.view(before) : before);
    const HistoryRow first = row(before, ground_.at(0.0), ledger);
    start_crest_x_ = first.crest_x;
    enter(first, 0);

    const StepOperator& step = integrator_->step_operator(dt_);
    for (std::int64_t n = 1; n <= steps_; ++n) {
        const double time = dt_ * static_cast<double>(n);
        const GroundState ground = ground_.at(time);
        load_.evaluate(ground, load);
        const FreeStep free = integrator_->free_step(step, before, load);
        integrator_->finish_step(step, before, load, free, after);
        after.time = time; // not summed up
        if (water_)
            ledger.add_step(water_->energy.view(before), water_->energy.view(after), step.constants(),
                            water_->energy.work(before, after));
        else
            ledger.add_step(before, after, step.constants());
        if (!std::isfinite(ledger.imbalance())) {
            history_.status = TiedRunStatus::diverged;
            history_.status_text = fmt::format("not finite after step {} at {:.4g} s", n, time);
            break;
        }
        std::swap(before, after);
        history_.steps = n;
        enter(row(before, ground, ledger), n);
        if (stopped(n, time)) break;
    }
    finish(before, ledger);
    return std::move(history_);
}

} // namespace

History integrate(const Model& model, const GroundMotion& motion, const TiedRunOptions& options)
{
    return Run(model, motion, options).go();
}

} // namespace damslip::fe2d
