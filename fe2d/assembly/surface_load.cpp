#include "fe2d/assembly/surface_load.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

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
