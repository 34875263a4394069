#include "fe2d/assembly/assemble.hpp"

#include <algorithm>
#include <cassert>

namespace damslip::fe2d {

namespace {

/// Unknowns of an element in the order of its matrix.
struct ElementDofs {
    std::array<int, 18> index{};
    int count = 0;
};

ElementDofs dofs_of(const Element& element, const DofMap& map)
{
    ElementDofs dofs;
    for (const int node : element.all())
        for (int c = 0; c < map.components; ++c) dofs.index[dofs.count++] = map(node, c);
    return dofs;
}

} // namespace

SparseMatrix assemble(const Mesh& mesh, const DofMap& dofs, const ElementMatrixFunction& element_matrix)
{
    return assemble(mesh, dofs, dofs, element_matrix);
}

SparseMatrix assemble(const Mesh& mesh, const DofMap& rows, const DofMap& columns,
                      const ElementMatrixFunction& element_matrix)
{
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(mesh.elements.size() * 16 * static_cast<std::size_t>(rows.components * columns.components));
    for (const Element& element : mesh.elements) {
        const ElementMatrix m = element_matrix(element, corners(mesh, element));
        if (m.size() == 0) continue;
        const ElementDofs r = dofs_of(element, rows), c = dofs_of(element, columns);
        assert(m.rows() == r.count && m.cols() == c.count);
        for (int j = 0; j < c.count; ++j)
            for (int i = 0; i < r.count; ++i)
                if (r.index[i] != no_dof && c.index[j] != no_dof) entries.emplace_back(r.index[i], c.index[j], m(i, j));
    }
    SparseMatrix matrix(rows.count, columns.count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

Eigen::VectorXd assemble_vector(const Mesh& mesh, const DofMap& dofs, const ElementVectorFunction& element_vector)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(dofs.count);
    for (const Element& element : mesh.elements) {
        const ElementVector f = element_vector(element, corners(mesh, element));
        if (f.size() == 0) continue;
        const ElementDofs d = dofs_of(element, dofs);
        assert(f.size() == d.count);
        for (int i = 0; i < d.count; ++i)
            if (d.index[i] != no_dof) sum[d.index[i]] += f[i];
    }
    return sum;
}

const ElasticMaterial& Materials::of(Region region) const
{
    assert(region != Region::reservoir);
    switch (region) {
    case Region::dam: return dam;
    case Region::rock: return rock;
    case Region::block: return block;
    default: return curtain;
    }
}

Materials materials_of(const Scene& scene)
{
    Materials materials;
    materials.kind = q4_kind(scene.mesh.element);
    materials.dam = elastic_material(scene.dam, scene, "dam");
    if (!scene.foundation) return materials;
    materials.rock = elastic_material(scene.foundation->material, scene, "foundation");
    materials.curtain = materials.block = materials.rock;
    if (scene.curtain && scene.curtain->young_modulus) {
        materials.curtain.young_modulus = *scene.curtain->young_modulus;
        materials.curtain.poisson_ratio = scene.curtain->poisson_ratio;
    }
    return materials;
}

Materials without_rock_density(Materials materials)
{
    materials.rock.density = 0.0;
    materials.curtain.density = 0.0;
    return materials;
}

SparseMatrix stiffness_matrix(const Mesh& mesh, const DofMap& dofs, const Materials& materials)
{
    std::array<Eigen::Matrix3d, region_count> d;
    for (const Region region : {Region::dam, Region::rock, Region::curtain, Region::block})
        d[static_cast<int>(region)] = plane_strain_matrix(materials.of(region));
    return assemble(mesh, dofs, [&](const Element& element, const Corners& corners) {
        return elastic_stiffness(corners, element.size(), element.share * d[static_cast<int>(element.region)],
                                 materials.kind, extra_nodes(element));
    });
}

SparseMatrix dam_stiffness_matrix(const Mesh& mesh, const DofMap& dofs, const Materials& materials)
{
    const Eigen::Matrix3d d = plane_strain_matrix(materials.dam);
    return assemble(mesh, dofs, [&](const Element& element, const Corners& corners) -> ElementMatrix {
        if (element.region != Region::dam) return {};
        return elastic_stiffness(corners, element.size(), element.share * d, materials.kind, extra_nodes(element));
    });
}

SparseMatrix mass_matrix(const Mesh& mesh, const DofMap& dofs, const Materials& materials, MassKind kind)
{
    return assemble(mesh, dofs, [&](const Element& element, const Corners& corners) -> ElementMatrix {
        const double density = element.share * materials.of(element.region).density;
        if (density == 0.0) return {};
        return elastic_mass(corners, element.size(), density, kind, extra_nodes(element));
    });
}

Eigen::VectorXd inertia_vector(const Mesh& mesh, const DofMap& dofs, const Materials& materials,
                               const Eigen::Vector2d& direction, MassKind kind)
{
    // The shape functions sum to one, so M r = integral of rho N^T r: the same for the consistent matrix and row sums.
    // The lumped mass of quadratic elements is not the row sums.
    return assemble_vector(mesh, dofs, [&](const Element& element, const Corners& corners) -> ElementVector {
        const double density = element.share * materials.of(element.region).density;
        if (density == 0.0) return {};
        const ExtraNodes extra = extra_nodes(element);
        if (kind == MassKind::lumped && extra.any())
            return elastic_mass(corners, element.size(), density, kind, extra) *
                   direction.replicate(element.size() + extra.count(), 1);
        return body_force(corners, element.size(), density * direction, extra);
    });
}

Eigen::VectorXd gravity_load(const Mesh& mesh, const DofMap& dofs, const Materials& materials, double gravity,
                             std::span<const Region> regions)
{
    return assemble_vector(mesh, dofs, [&](const Element& element, const Corners& corners) -> ElementVector {
        const double density = element.share * materials.of(element.region).density;
        if (density == 0.0 || std::find(regions.begin(), regions.end(), element.region) == regions.end()) return {};
        return body_force(corners, element.size(), {0.0, -density * gravity}, extra_nodes(element));
    });
}

Eigen::VectorXd locked_stress_load(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& stress)
{
    return assemble_vector(mesh, dofs, [&](const Element& element, const Corners& corners) -> ElementVector {
        assert(element.linear());
        Eigen::Vector4d at = Eigen::Vector4d::Zero();
        for (int i = 0; i < element.size(); ++i) at[i] = stress[element.nodes[static_cast<std::size_t>(i)]];
        if (at.isZero(0.0)) return {};
        ElementVector force = ElementVector::Zero(2 * element.size());
        const auto add = [&](const QuadraturePoint& p) {
            for (int i = 0; i < element.size(); ++i) force[2 * i] -= p.weight * p.shape.dot(at) * p.gradient(0, i);
        };
        if (element.size() == 4)
            for (const QuadraturePoint& p : q4_points(corners)) add(p);
        else
            for (const QuadraturePoint& p : t3_points(corners)) add(p);
        return element.share * force;
    });
}

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
    if (base == Base::tied && mesh.seam)
        for (const auto& [upstream, downstream, rock] : mesh.seam->bends)
            for (const int component : {0, 1}) fix({downstream, rock}, component);
    number(map);
    const auto share = [&map](int node, int with) {
        for (const int component : {0, 1}) map.dofs[2 * node + component] = map.dofs[2 * with + component];
    };
    if (base == Base::tied && mesh.seam)
        for (const auto& [upstream, downstream, rock] : mesh.seam->bends) {
            share(downstream, upstream);
            share(rock, upstream);
        }
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
