#include "fe2d/time/tied_problem.hpp"

#include "core/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
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
    history_.status_text = fmt::format("stopped by the user at {:.4g} s of {:.4g} s; results up to there are kept",
                                       time, dt_ * static_cast<double>(steps_));
    return true;
}

void HistoryWriter::finish(double energy_scale)
{
    history_.energy_scale = energy_scale;
    if (energy_scale > 0.0) history_.largest_imbalance /= energy_scale;
    if (history_.status == TiedRunStatus::complete)
        history_.status_text = fmt::format("{} steps of {:g} s, {} unknowns", history_.steps, dt_, history_.unknowns);
}

} // namespace damslip::fe2d
