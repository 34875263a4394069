#include "fe2d/assembly/dof_map.hpp"

#include <algorithm>
#include <cassert>

namespace damslip::fe2d {

namespace {

constexpr int undecided = -2;

void number(DofMap& map)
{
    for (int& dof : map.dofs)
        if (dof == undecided) dof = map.count++;
}

} // namespace

DofMap displacement_dofs(const Mesh& mesh, Base base, RockEdges edges)
{
    DofMap map{.components = 2, .count = 0, .dofs = std::vector<int>(2 * mesh.nodes.size(), undecided)};
    const auto fix = [&](const std::vector<int>& nodes, int component) {
        for (const int node : nodes) map.dofs[2 * node + component] = no_dof;
    };
    if (edges == RockEdges::fixed) {
        fix(with_mid_nodes(mesh, mesh.box_left), 0);
        fix(with_mid_nodes(mesh, mesh.box_right), 0);
        fix(with_mid_nodes(mesh, mesh.box_bottom), 1);
    }
    const ContactPlane& plane = mesh.contact;
    assert((base == Base::separate || plane.matching) && "only facing nodes can be tied");
    if (base == Base::tied && !mesh.has_rock())
        for (const int component : {0, 1}) fix(plane.dam_nodes, component);
    if (base == Base::tied && mesh.has_rock())
        for (const int component : {0, 1}) fix(plane.rock_nodes, component); // replaced below by the dam's unknowns
    if (base == Base::tied)
        for (const LiftPlane& lift : mesh.lifts)
            for (const int component : {0, 1}) fix(lift.upper_nodes, component); // replaced below as well
    number(map);
    if (base == Base::tied && mesh.has_rock())
        for (std::size_t i = 0; i < plane.dam_nodes.size(); ++i)
            for (const int component : {0, 1})
                map.dofs[2 * plane.rock_nodes[i] + component] = map.dofs[2 * plane.dam_nodes[i] + component];
    if (base == Base::tied)
        for (const LiftPlane& lift : mesh.lifts)
            for (std::size_t i = 0; i < lift.upper_nodes.size(); ++i)
                for (const int component : {0, 1})
                    map.dofs[2 * lift.upper_nodes[i] + component] = map.dofs[2 * lift.lower_nodes[i] + component];
    return map;
}

int dam_dof_count(const Mesh& mesh, const DofMap& dofs)
{
    int count = 0;
    for (int i = 0; i < dofs.components * mesh.dam_node_count; ++i) count = std::max(count, dofs.dofs[i] + 1);
    return count;
}

DofMap all_dofs(const Mesh& mesh, int components)
{
    DofMap map{
        .components = components, .count = 0, .dofs = std::vector<int>(components * mesh.nodes.size(), undecided)};
    number(map);
    return map;
}

DofMap scalar_dofs(const Mesh& mesh, std::span<const Region> regions, std::span<const int> prescribed)
{
    DofMap map{.components = 1, .count = 0, .dofs = std::vector<int>(mesh.nodes.size(), no_dof)};
    for (const Element& element : mesh.elements)
        if (std::find(regions.begin(), regions.end(), element.region) != regions.end())
            for (const int node : element.all()) map.dofs[node] = undecided;
    for (const int node : prescribed) map.dofs[node] = no_dof;
    number(map);
    return map;
}

Eigen::VectorXd nodal_values(const DofMap& dofs, const Eigen::VectorXd& unknowns)
{
    Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dofs.dofs.size()));
    for (std::size_t i = 0; i < dofs.dofs.size(); ++i)
        if (dofs.dofs[i] != no_dof) values[i] = unknowns[dofs.dofs[i]];
    return values;
}

} // namespace damslip::fe2d
