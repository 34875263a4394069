#include "analysis/prepare/modal_forces.hpp"

#include "core/input_error.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/structure_system.hpp"

#include <numbers>

namespace damslip {

void refuse_modes(const Scene& scene, const std::string& what)
{
    throw NotConverged(
        Diagnostic{scene.file.string(), 0, 0, what, "modes of the dam on a bonded base", "see  damslip modes SCENE"});
}

namespace {

/// Force of still water that the ground pushes with -1 m/s^2: H L^-1 flux.
Eigen::VectorXd static_water(const Scene& scene, const fe2d::CoupledPencil& pencil, const Eigen::VectorXd& flux)
{
    fe2d::LinearSolver solver;
    if (!solver.factorise(pencil.water_stiffness).ok()) refuse_modes(scene, "the water: " + text_of(solver.report().note()));
    return pencil.coupling * solver.solve(flux);
}

} // namespace

ModalForces modal_forces(const Scene& scene, const fe2d::Model& model, const fe2d::NaturalModes& modes,
                         const fe2d::CoupledModes* coupled, const fe2d::FluidModel* water, ModalDirection direction)
{
    ModalForces f;
    Eigen::MatrixXd shape;
    const Eigen::Index axis = direction == ModalDirection::horizontal ? 0 : 1;
    Eigen::VectorXd participation, rigid = axis == 0 ? model.inertia_x : model.inertia_y;
    f.frequency = coupled ? coupled->frequency : modes.frequency;
    const Eigen::VectorXd omega_squared = (2.0 * std::numbers::pi * f.frequency).array().square();
    if (coupled) {
        const fe2d::CoupledPencil pencil = fe2d::coupled_pencil(model, *water);
        shape = coupled->displacement;
        const Eigen::VectorXd& flux = axis == 0 ? pencil.flux_x : pencil.flux_y;
        participation = shape.transpose() * rigid;
        participation += ((coupled->pressure.transpose() * flux).array() / omega_squared.array()).matrix();
        rigid += static_water(scene, pencil, flux);
        f.total_mass = coupled->total_mass[axis];
    } else {
        shape = modes.shape;
        participation = modes.participation.row(axis).transpose();
        f.total_mass = model.total_mass[axis];
    }
    if (f.frequency.size() == 0) refuse_modes(scene, "the dam has no mode.");
    f.effective_mass = participation.array().square();
    const Eigen::VectorXd factor = participation.array() / omega_squared.array();
    f.displacement = shape * factor.asDiagonal();
    f.force = model.stiffness * f.displacement;
    f.residual = rigid - f.force.rowwise().sum();
    f.residual_mass = f.total_mass - f.effective_mass.sum();
    return f;
}

std::vector<Unknown> unknowns_of(const fe2d::Model& model)
{
    std::vector<Unknown> list(static_cast<std::size_t>(model.dofs.count));
    for (int node = 0; node < model.mesh.node_count(); ++node)
        for (int c = 0; c < 2; ++c)
            if (const int dof = model.dofs(node, c); dof != fe2d::no_dof)
                list[static_cast<std::size_t>(dof)] = {model.mesh.nodes[static_cast<std::size_t>(node)], c};
    return list;
}

} // namespace damslip
