#include "analysis/spectrum/modal_forces.hpp"

#include "core/input_error.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/coupled_structure.hpp"

#include <numbers>

namespace damslip {

namespace {

[[noreturn]] void no_modes(const Scene& scene, const std::string& what)
{
    throw NotConverged(
        Diagnostic{scene.file.string(), 0, 0, what, "modes of the dam on a bonded base", "see  damslip modes SCENE"});
}

/// Force of still water that the ground pushes with -1 m/s^2: H L^-1 flux.
Eigen::VectorXd static_water(const Scene& scene, const fe2d::CoupledPencil& pencil, const Eigen::VectorXd& flux)
{
    fe2d::LinearSolver solver;
    if (!solver.factorise(pencil.water_stiffness).ok()) no_modes(scene, "the water: " + solver.report().text());
    return pencil.coupling * solver.solve(flux);
}

} // namespace

ModalForces modal_forces(const ModesResult& m, ModalDirection direction)
{
    if (!m.complete()) no_modes(m.scene, "the modes were not all found.");
    ModalForces f;
    Eigen::MatrixXd shape;
    const Eigen::Index axis = direction == ModalDirection::horizontal ? 0 : 1;
    Eigen::VectorXd participation, rigid = axis == 0 ? m.model.inertia_x : m.model.inertia_y;
    f.frequency = m.coupled ? m.coupled->frequency : m.modes.frequency;
    const Eigen::VectorXd omega_squared = (2.0 * std::numbers::pi * f.frequency).array().square();
    if (m.coupled) {
        const fe2d::CoupledPencil pencil = fe2d::coupled_pencil(m.model, *m.water);
        shape = m.coupled->displacement;
        const Eigen::VectorXd& flux = axis == 0 ? pencil.flux_x : pencil.flux_y;
        participation = shape.transpose() * rigid;
        participation += ((m.coupled->pressure.transpose() * flux).array() / omega_squared.array()).matrix();
        rigid += static_water(m.scene, pencil, flux);
        f.total_mass = m.coupled->total_mass[axis];
    } else {
        shape = m.modes.shape;
        participation = m.modes.participation.row(axis).transpose();
        f.total_mass = m.model.total_mass[axis];
    }
    if (f.frequency.size() == 0) no_modes(m.scene, "the dam has no mode.");
    f.effective_mass = participation.array().square();
    const Eigen::VectorXd factor = participation.array() / omega_squared.array();
    f.displacement = shape * factor.asDiagonal();
    f.force = m.model.stiffness * f.displacement;
    f.residual = rigid - f.force.rowwise().sum();
    f.residual_mass = f.total_mass - f.effective_mass.sum();
    return f;
}

} // namespace damslip
