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
Eigen::VectorXd static_water(const Scene& scene, const fe2d::CoupledPencil& pencil)
{
    fe2d::LinearSolver solver;
    if (!solver.factorise(pencil.water_stiffness).ok()) no_modes(scene, "the water: " + solver.report().text());
    return pencil.coupling * solver.solve(pencil.flux_x);
}

} // namespace

ModalForces modal_forces(const ModesResult& m)
{
    if (!m.complete()) no_modes(m.scene, "the modes were not all found.");
    ModalForces f;
    Eigen::MatrixXd shape;
    Eigen::VectorXd participation, rigid = m.model.inertia_x;
    f.frequency = m.coupled ? m.coupled->frequency : m.modes.frequency;
    const Eigen::VectorXd omega_squared = (2.0 * std::numbers::pi * f.frequency).array().square();
    if (m.coupled) {
        const fe2d::CoupledPencil pencil = fe2d::coupled_pencil(m.model, *m.water);
        shape = m.coupled->displacement;
        participation = shape.transpose() * pencil.inertia_x;
        participation += ((m.coupled->pressure.transpose() * pencil.flux_x).array() / omega_squared.array()).matrix();
        rigid += static_water(m.scene, pencil);
        f.total_mass = m.coupled->total_mass.x();
    } else {
        shape = m.modes.shape;
        participation = m.modes.participation.row(0).transpose();
        f.total_mass = m.model.total_mass.x();
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
