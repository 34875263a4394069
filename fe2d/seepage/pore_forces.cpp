#include "fe2d/seepage/pore_forces.hpp"

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/element/quadratic.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

namespace {

enum class Form { divergence, gradient };

ElementVector element_force(const Corners& corners, int size, const ElementVector& pressure, Form form,
                            const ExtraNodes& extra)
{
    const int nodes = size + extra.count();
    ElementVector force = ElementVector::Zero(2 * nodes);
    const auto add = [&](const auto& point) {
        const double p = point.shape.head(nodes).dot(pressure.head(nodes));
        const Eigen::Vector2d gradient = point.gradient.leftCols(nodes) * pressure.head(nodes);
        for (int i = 0; i < nodes; ++i) {
            const Eigen::Vector2d f = form == Form::divergence ? Eigen::Vector2d(p * point.gradient.col(i))
                                                               : Eigen::Vector2d(-point.shape[i] * gradient);
            force.segment<2>(2 * i) += point.weight * f;
        }
    };
    if (extra.any())
        for (const auto& point : quadratic_points(corners, size, extra)) add(point);
    else if (size == 3)
        for (const auto& point : t3_points(corners)) add(point);
    else
        for (const auto& point : q4_points(corners)) add(point);
    return force;
}

Eigen::VectorXd rock_force(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure, Form form)
{
    assert(pressure.size() == mesh.node_count() && dofs.components == 2);
    return assemble_vector(mesh, dofs, [&](const Element& element, const Corners& corners) -> ElementVector {
        if (element.region != Region::rock && element.region != Region::curtain) return {};
        const ElementNodes nodes = element.all();
        ElementVector p(nodes.count);
        for (int i = 0; i < nodes.count; ++i) p[i] = pressure[nodes[i]];
        return element_force(corners, element.size(), p, form, extra_nodes(element));
    });
}

} // namespace

Eigen::VectorXd excess_pore_pressure(const Eigen::VectorXd& head, double unit_weight)
{
    return head.unaryExpr([&](double h) { return std::isfinite(h) ? unit_weight * h : 0.0; });
}

Eigen::VectorXd pore_pressure_force(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure)
{
    return rock_force(mesh, dofs, pressure, Form::divergence);
}

Eigen::VectorXd seepage_body_force(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure)
{
    return rock_force(mesh, dofs, pressure, Form::gradient);
}

Eigen::VectorXd surface_pressure_force(const Mesh& mesh, const DofMap& dofs, std::span<const int> chain,
                                       const Eigen::VectorXd& pressure)
{
    Eigen::VectorXd force = Eigen::VectorXd::Zero(dofs.count);
    const auto add = [&](int node, double x, double y) {
        if (dofs(node, 0) != no_dof) force[dofs(node, 0)] += x;
        if (dofs(node, 1) != no_dof) force[dofs(node, 1)] += y;
    };
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const int a = chain[i], b = chain[i + 1];
        const Point from = mesh.nodes[a], to = mesh.nodes[b];
        const double inward_x = from.y - to.y, inward_y = to.x - from.x; // -n times length
        if (const int mid = mid_node(mesh, a, b); mid >= 0) {            // integral of N_i N_j, quadratic
            const double p = pressure[a], q = pressure[b], r = pressure[mid];
            const double at_a = (4.0 * p - q + 2.0 * r) / 30.0, at_b = (4.0 * q - p + 2.0 * r) / 30.0,
                         at_mid = (2.0 * p + 2.0 * q + 16.0 * r) / 30.0;
            add(a, at_a * inward_x, at_a * inward_y);
            add(b, at_b * inward_x, at_b * inward_y);
            add(mid, at_mid * inward_x, at_mid * inward_y);
            continue;
        }
        const double at_a = pressure[a] / 3.0 + pressure[b] / 6.0, at_b = pressure[a] / 6.0 + pressure[b] / 3.0;
        add(a, at_a * inward_x, at_a * inward_y);
        add(b, at_b * inward_x, at_b * inward_y);
    }
    return force;
}

namespace {

/// The rock's face of the base joint, rock on the left.
NodeChain rock_face(const Mesh& mesh)
{
    return {mesh.contact.rock_nodes.rbegin(), mesh.contact.rock_nodes.rend()};
}

} // namespace

Eigen::VectorXd water_in_rock(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure, PorePressure form)
{
    if (form == PorePressure::none) return Eigen::VectorXd::Zero(dofs.count);
    if (form == PorePressure::effective)
        return seepage_body_force(mesh, dofs, pressure) - surface_pressure_force(mesh, dofs, rock_face(mesh), pressure);
    return pore_pressure_force(mesh, dofs, pressure) + surface_pressure_force(mesh, dofs, mesh.floor, pressure) +
           surface_pressure_force(mesh, dofs, mesh.ground, pressure);
}

Eigen::VectorXd pore_pressure_loads(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure,
                                    PorePressure form)
{
    assert(mesh.contact.matching);
    // Uplift on the dam: its base runs from heel to toe with the dam on the left.
    Eigen::VectorXd on_dam = pressure;
    for (std::size_t i = 0; i < mesh.contact.dam_nodes.size(); ++i)
        on_dam[mesh.contact.dam_nodes[i]] = pressure[mesh.contact.rock_nodes[i]];
    return surface_pressure_force(mesh, dofs, mesh.contact.dam_nodes, on_dam) +
           surface_pressure_force(mesh, dofs, rock_face(mesh), pressure) + water_in_rock(mesh, dofs, pressure, form);
}

} // namespace damslip::fe2d
