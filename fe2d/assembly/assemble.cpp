#include "fe2d/assembly/assemble.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

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

namespace {

/// Gauss-Legendre points on (0, 1).
struct LinePoint {
    double t, weight;
};
constexpr std::array<LinePoint, 2> two_points{{{0.21132486540518713, 0.5}, {0.78867513459481287, 0.5}}};
constexpr std::array<LinePoint, 5> five_points{{{0.046910077030668, 0.118463442528095},
                                                {0.230765344947158, 0.239314335249683},
                                                {0.5, 0.284444444444444},
                                                {0.769234655052842, 0.239314335249683},
                                                {0.953089922969332, 0.118463442528095}}};

/// The wet part of an edge from node a to node b, as an interval of its parameter t.
struct Edge {
    int a, b, mid; ///< mid: -1 where the edge is linear
    Point pa, pb;
    double length, from, to;

    int size() const { return mid < 0 ? 2 : 3; }
    std::array<int, 3> nodes() const { return {a, b, mid}; }
    std::array<double, 3> shape(double t) const
    {
        if (mid < 0) return {1.0 - t, t, 0.0};
        return {(1.0 - t) * (1.0 - 2.0 * t), t * (2.0 * t - 1.0), 4.0 * t * (1.0 - t)};
    }

    Point at(double t) const { return {pa.x + t * (pb.x - pa.x), pa.y + t * (pb.y - pa.y)}; }
    Eigen::Vector2d outward() const { return {(pb.y - pa.y) / length, (pa.x - pb.x) / length}; }
};

/// Interval of t in (0, 1) in which y(t) <= level; empty where from >= to.
void clip(Edge& edge, double level)
{
    edge.from = 0.0;
    edge.to = 1.0;
    if (edge.pa.y <= level && edge.pb.y <= level) return;
    if (edge.pa.y > level && edge.pb.y > level)
        edge.to = 0.0;
    else if (edge.pa.y > level)
        edge.from = (edge.pa.y - level) / (edge.pa.y - edge.pb.y);
    else
        edge.to = (level - edge.pa.y) / (edge.pb.y - edge.pa.y);
}

template <class Visit>
void for_each_wet_edge(const Mesh& mesh, const NodeChain& chain, double level, Visit visit)
{
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        Edge edge{.a = chain[i],
                  .b = chain[i + 1],
                  .mid = mid_node(mesh, chain[i], chain[i + 1]),
                  .pa = mesh.nodes[chain[i]],
                  .pb = mesh.nodes[chain[i + 1]],
                  .length = 0,
                  .from = 0,
                  .to = 0};
        edge.length = std::hypot(edge.pb.x - edge.pa.x, edge.pb.y - edge.pa.y);
        if (edge.length == 0.0) continue; // the two nodes of a lift joint
        clip(edge, level);
        if (edge.to > edge.from) visit(edge);
    }
}

void add(Eigen::VectorXd& sum, const DofMap& dofs, int node, const Eigen::Vector2d& force)
{
    for (const int c : {0, 1})
        if (const int dof = dofs(node, c); dof != no_dof) sum[dof] += force[c];
}

/// Integral of m N_i N_j over the wet part; rows and columns as Edge::nodes.
Eigen::Matrix3d edge_mass(const Edge& edge, const AddedMassLaw& law)
{
    // The outward normal of a body that widens downwards points up: phi = asin(n_y).
    const double inclination = std::asin(std::clamp(edge.outward()[1], -1.0, 1.0));
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const LinePoint& p : five_points) {
        const double t = edge.from + p.t * (edge.to - edge.from);
        const double m = law(edge.at(t), inclination) * p.weight * (edge.to - edge.from) * edge.length;
        const auto n = edge.shape(t);
        for (int i = 0; i < edge.size(); ++i)
            for (int j = 0; j <= i; ++j) sum(i, j) += m * n[j] * n[i];
    }
    return sum.selfadjointView<Eigen::Lower>();
}

/// Adds integral of N^T p dS times `direction`, p piecewise linear over the distance along a straight line of nodes.
void add_profile(Eigen::VectorXd& sum, const DofMap& dofs, const std::vector<int>& nodes,
                 const std::vector<double>& distance, const PressureProfile& profile, const Eigen::Vector2d& direction)
{
    for (std::size_t e = 0; e + 1 < nodes.size(); ++e)
        for (std::size_t k = 0; k + 1 < profile.points.size(); ++k) {
            const ProfilePoint &p0 = profile.points[k], &p1 = profile.points[k + 1];
            const double a = distance[e], b = distance[e + 1], pa = p0.distance, pb = p1.distance;
            const double from = std::max(a, pa), to = std::min(b, pb);
            if (!(to > from)) continue;
            for (const LinePoint& g : two_points) { // linear pressure times linear shape: exact
                const double x = from + g.t * (to - from), t = (x - a) / (b - a);
                const double p = p0.pressure + (x - pa) / (pb - pa) * (p1.pressure - p0.pressure);
                const Eigen::Vector2d force = p * g.weight * (to - from) * direction;
                add(sum, dofs, nodes[e], (1.0 - t) * force);
                add(sum, dofs, nodes[e + 1], t * force);
            }
        }
}

} // namespace

Eigen::VectorXd pressure_load(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain,
                              const PressureField& pressure, double surface_level)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(dofs.count);
    for_each_wet_edge(mesh, chain, surface_level, [&](const Edge& edge) {
        for (const LinePoint& p : two_points) {
            const double t = edge.from + p.t * (edge.to - edge.from);
            const Eigen::Vector2d force =
                -pressure(edge.at(t)) * p.weight * (edge.to - edge.from) * edge.length * edge.outward();
            const auto n = edge.shape(t); // linear pressure times quadratic shape at most: exact
            for (int i = 0; i < edge.size(); ++i) add(sum, dofs, edge.nodes()[i], n[i] * force);
        }
    });
    return sum;
}

SparseMatrix added_mass_matrix(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain, const AddedMassLaw& law,
                               double surface_level)
{
    std::vector<Eigen::Triplet<double>> entries;
    for_each_wet_edge(mesh, chain, surface_level, [&](const Edge& edge) {
        const Eigen::Matrix3d m = edge_mass(edge, law);
        const Eigen::Matrix2d nn = edge.outward() * edge.outward().transpose();
        const auto nodes = edge.nodes();
        for (int i = 0; i < edge.size(); ++i)
            for (int j = 0; j < edge.size(); ++j)
                for (int c = 0; c < 2; ++c)
                    for (int d = 0; d < 2; ++d)
                        if (const int row = dofs(nodes[i], c), column = dofs(nodes[j], d);
                            row != no_dof && column != no_dof && nn(c, d) != 0.0)
                            entries.emplace_back(row, column, m(i, j) * nn(c, d));
    });
    SparseMatrix matrix(dofs.count, dofs.count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

Eigen::VectorXd added_mass_inertia(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain,
                                   const AddedMassLaw& law, double surface_level, const Eigen::Vector2d& direction)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(dofs.count);
    for_each_wet_edge(mesh, chain, surface_level, [&](const Edge& edge) {
        const Eigen::Matrix3d m = edge_mass(edge, law);
        const Eigen::Vector2d normal = edge.outward() * edge.outward().dot(direction);
        for (int i = 0; i < edge.size(); ++i) add(sum, dofs, edge.nodes()[i], m.row(i).sum() * normal);
    });
    return sum;
}

std::vector<AddedMassPoint> added_mass_points(const Mesh& mesh, const NodeChain& chain, const AddedMassLaw& law,
                                              double surface_level)
{
    std::vector<AddedMassPoint> points;
    for_each_wet_edge(mesh, chain, surface_level, [&](const Edge& edge) {
        const Eigen::Vector2d normal = edge.outward();
        const double inclination = std::asin(std::clamp(normal[1], -1.0, 1.0));
        for (const LinePoint& p : five_points) {
            const double t = edge.from + p.t * (edge.to - edge.from);
            const double m = law(edge.at(t), inclination) * p.weight * (edge.to - edge.from) * edge.length;
            points.push_back({edge.nodes(), edge.shape(t), normal, edge.at(t), m});
        }
    });
    return points;
}

Eigen::VectorXd uplift_load(const Mesh& mesh, const DofMap& dofs, const PressureProfile& profile, ContactSide side)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(dofs.count);
    const ContactPlane& plane = mesh.contact;
    const bool on_dam = side == ContactSide::dam;
    const std::vector<int>& nodes = mesh.seam ? (on_dam ? mesh.seam->body : mesh.seam->rock)
                                              : (on_dam ? plane.dam_nodes : plane.rock_nodes);
    if (nodes.empty()) return sum;
    const std::vector<double>& distance = mesh.seam ? (on_dam ? mesh.seam->body_distance : mesh.seam->rock_distance)
                                                    : (on_dam ? plane.distance : plane.rock_node_distance);
    const double sign = on_dam ? 1.0 : -1.0;
    if (mesh.seam) {
        for (std::size_t e = 0; e + 1 < nodes.size(); ++e) {
            const Point a = mesh.nodes[nodes[e]], b = mesh.nodes[nodes[e + 1]];
            const double length = distance[e + 1] - distance[e];
            if (!(length > 0.0)) continue; // both nodes of a bend
            add_profile(sum, dofs, {nodes[e], nodes[e + 1]}, {distance[e], distance[e + 1]}, profile,
                        sign / length * Eigen::Vector2d(a.y - b.y, b.x - a.x));
        }
        return sum;
    }
    const Point first = mesh.nodes[nodes.front()], last = mesh.nodes[nodes.back()];
    const double length = plane.distance.back();
    const Eigen::Vector2d up = sign / length * Eigen::Vector2d(first.y - last.y, last.x - first.x);
    add_profile(sum, dofs, nodes, distance, profile, up);
    return sum;
}

Eigen::VectorXd lift_water_load(const Mesh& mesh, const DofMap& dofs, std::size_t joint, const PressureProfile& profile)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(dofs.count);
    const LiftPlane& lift = mesh.lifts.at(joint);
    Eigen::Vector2d normal(0.0, 1.0);
    if (mesh.seam && joint == 0) { // the base of the dam
        const Point a = mesh.nodes[lift.lower_nodes.front()], b = mesh.nodes[lift.lower_nodes.back()];
        normal = Eigen::Vector2d(a.y - b.y, b.x - a.x) / lift.distance.back();
    }
    add_profile(sum, dofs, lift.upper_nodes, lift.distance, profile, normal);
    add_profile(sum, dofs, lift.lower_nodes, lift.distance, profile, -normal);
    return sum;
}

std::optional<Eigen::VectorXd> point_load(const Mesh& mesh, const DofMap& dofs, Point at, const Eigen::Vector2d& force)
{
    double best = -HUGE_VAL;
    std::array<int, 3> nodes{};
    Eigen::Vector3d shares;
    for (int e = 0; e < mesh.dam_element_count; ++e) {
        const Element& element = mesh.elements[e];
        for (int half = 0; half < element.size() - 2; ++half) { // the triangles (0, 1, 2) and (0, 2, 3)
            const std::array<int, 3> n{element.nodes[0], element.nodes[half + 1], element.nodes[half + 2]};
            const Point a = mesh.nodes[n[0]], b = mesh.nodes[n[1]], c = mesh.nodes[n[2]];
            const double twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
            const double s = ((at.x - a.x) * (c.y - a.y) - (c.x - a.x) * (at.y - a.y)) / twice;
            const double t = ((b.x - a.x) * (at.y - a.y) - (at.x - a.x) * (b.y - a.y)) / twice;
            const Eigen::Vector3d trial(1.0 - s - t, s, t);
            // Distance outside, as a length: the most negative share times the triangle's size.
            const double inside = std::min(0.0, trial.minCoeff()) * std::sqrt(std::abs(twice));
            if (inside <= best) continue;
            best = inside;
            nodes = n;
            shares = trial;
        }
    }
    const double size = std::abs(mesh.nodes[mesh.crest.front()].y - mesh.nodes[mesh.contact.dam_nodes.front()].y);
    if (best < -1e-6 * size) return std::nullopt;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(dofs.count);
    for (int i = 0; i < 3; ++i) add(sum, dofs, nodes[i], shares[i] * force);
    return sum;
}

} // namespace damslip::fe2d
