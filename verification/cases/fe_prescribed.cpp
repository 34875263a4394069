#include "verification/cases/fe_prescribed.hpp"

#include "fe2d/solver/linear_solver.hpp"

#include <cmath>

namespace damslip::verification {

using namespace damslip::fe2d;

Eigen::VectorXd solve_prescribed(const Mesh& mesh, const Materials& materials, const std::vector<int>& fixed,
                                 const Eigen::VectorXd& values, const Eigen::VectorXd& load)
{
    DofMap free = all_dofs(mesh, 2), held = free;
    std::vector<bool> is_fixed(mesh.nodes.size(), false);
    for (const int node : fixed) is_fixed[static_cast<std::size_t>(node)] = true;
    free.count = held.count = 0;
    for (std::size_t i = 0; i < free.dofs.size(); ++i) {
        free.dofs[i] = is_fixed[i / 2] ? no_dof : free.count++;
        held.dofs[i] = is_fixed[i / 2] ? held.count++ : no_dof;
    }
    const Eigen::Matrix3d d = plane_strain_matrix(materials.dam);
    const auto element = [&](const Element& e, const Corners& c) {
        return elastic_stiffness(c, e.size(), d, materials.kind, extra_nodes(e));
    };
    Eigen::VectorXd prescribed(held.count), right(free.count);
    for (std::size_t i = 0; i < free.dofs.size(); ++i) {
        if (held.dofs[i] != no_dof) prescribed[held.dofs[i]] = values[static_cast<Eigen::Index>(i)];
        if (free.dofs[i] != no_dof) right[free.dofs[i]] = load[static_cast<Eigen::Index>(i)];
    }
    LinearSolver solver;
    if (!solver.factorise(assemble(mesh, free, element)).ok())
        return Eigen::VectorXd::Constant(values.size(), std::nan(""));
    right -= assemble(mesh, free, held, element) * prescribed;
    Eigen::VectorXd u = nodal_values(free, solver.solve(right));
    for (std::size_t i = 0; i < free.dofs.size(); ++i)
        if (held.dofs[i] != no_dof) u[static_cast<Eigen::Index>(i)] = prescribed[held.dofs[i]];
    return u;
}

} // namespace damslip::verification
