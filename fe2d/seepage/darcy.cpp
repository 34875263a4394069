#include "fe2d/seepage/darcy.hpp"

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/element/scalar.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

namespace {

constexpr Region rock_regions[] = {Region::rock, Region::curtain};

bool in_rock(const Element& element)
{
    return element.region == Region::rock || element.region == Region::curtain;
}

double conductivity(const Permeability& permeability, const Element& element)
{
    return element.region == Region::curtain ? permeability.curtain : permeability.rock;
}

ElementMatrixFunction element_conduction(const Permeability& permeability)
{
    return [permeability](const Element& element, const Corners& corners) -> ElementMatrix {
        if (!in_rock(element)) return {};
        return scalar_gradient_matrix(corners, element.size(), conductivity(permeability, element),
                                      extra_nodes(element));
    };
}

Eigen::VectorXd unknowns(const DofMap& dofs, const Eigen::VectorXd& nodal)
{
    Eigen::VectorXd values(dofs.count);
    for (int node = 0; node < dofs.node_count(); ++node)
        if (dofs(node) != no_dof) values[dofs(node)] = nodal[node];
    return values;
}

void place(const DofMap& dofs, const Eigen::VectorXd& values, Eigen::VectorXd& nodal)
{
    for (int node = 0; node < dofs.node_count(); ++node)
        if (dofs(node) != no_dof) nodal[node] = values[dofs(node)];
}

} // namespace

DarcySolution solve_darcy(const Mesh& mesh, const Permeability& permeability, std::span<const NodeHead> heads)
{
    assert(!heads.empty());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    DarcySolution solution{
        Eigen::VectorXd::Constant(mesh.node_count(), nan), Eigen::VectorXd::Constant(mesh.node_count(), nan), {}};
    std::vector<int> prescribed;
    Eigen::VectorXd nodal = Eigen::VectorXd::Zero(mesh.node_count());
    for (const NodeHead& h : heads) {
        prescribed.push_back(h.node);
        nodal[h.node] = h.head;
    }
    const DofMap all = scalar_dofs(mesh, rock_regions, {}), free = scalar_dofs(mesh, rock_regions, prescribed);
    const SparseMatrix conduction = assemble(mesh, all, element_conduction(permeability));

    LinearSolver solver;
    solver.factorise(assemble(mesh, free, element_conduction(permeability)));
    solution.solver = solver.report();
    if (!solution.solver.ok()) return solution;
    Eigen::VectorXd driving(mesh.node_count()); // inflow that the prescribed heads alone would need, node by node
    place(all, conduction * unknowns(all, nodal), driving);
    place(free, solver.solve(Eigen::VectorXd(-unknowns(free, driving))), nodal);
    place(all, unknowns(all, nodal), solution.head);
    place(all, conduction * unknowns(all, nodal), solution.inflow);
    return solution;
}

double flow_into(const Mesh& mesh, const Permeability& permeability, const DarcySolution& solution,
                 std::span<const int> nodes, const std::function<bool(const Element&, const Corners&)>& chosen)
{
    std::vector<char> given(mesh.nodes.size(), 0);
    for (const int node : nodes) given[node] = 1;
    double flow = 0.0;
    for (const Element& element : mesh.elements) {
        const Corners points = corners(mesh, element);
        if (!in_rock(element) || !chosen(element, points)) continue;
        const ElementNodes at = element.all();
        ElementVector head(at.count);
        for (int i = 0; i < at.count; ++i) head[i] = solution.head[at[i]];
        const ElementVector inflow =
            scalar_gradient_matrix(points, element.size(), conductivity(permeability, element), extra_nodes(element)) *
            head;
        for (int i = 0; i < at.count; ++i)
            if (given[at[i]]) flow += inflow[i];
    }
    return flow;
}

} // namespace damslip::fe2d
