#include "fe2d/fluid/face_coupling.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

/// An edge of one side, going up.
struct Edge {
    int lower = 0, upper = 0, mid = -1; ///< nodes; mid: of a quadratic edge
    Point a, b;                         ///< places of the lower and the upper one

    double share_of_upper(double y) const { return (y - a.y) / (b.y - a.y); }
    std::array<std::pair<int, double>, 3> shape(double t) const ///< nodes with N at a share t of the way up
    {
        if (mid < 0) return {{{lower, 1.0 - t}, {upper, t}, {-1, 0.0}}};
        return {{{lower, (1.0 - t) * (1.0 - 2.0 * t)}, {upper, t * (2.0 * t - 1.0)}, {mid, 4.0 * t * (1.0 - t)}}};
    }
};

std::vector<Edge> edges_upwards(const Mesh& mesh, const NodeChain& chain)
{
    std::vector<Edge> edges;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        int lower = chain[k], upper = chain[k + 1];
        if (mesh.nodes[lower].y > mesh.nodes[upper].y) std::swap(lower, upper);
        edges.push_back({lower, upper, mid_node(mesh, lower, upper), mesh.nodes[lower], mesh.nodes[upper]});
    }
    return edges;
}

} // namespace

SparseMatrix face_coupling(const Mesh& structure, const DofMap& displacements, const ReservoirMesh& water,
                           const DofMap& pressures, Index unknowns)
{
    std::vector<Eigen::Triplet<double>> entries;
    const std::vector<Edge> dam = edges_upwards(structure, structure.upstream_face);
    for (const Edge& wet : edges_upwards(water.mesh, water.face)) {
        const Eigen::Vector2d normal(1.0, -(wet.b.x - wet.a.x) / (wet.b.y - wet.a.y)); // n dS/dy
        for (const Edge& dry : dam) {
            const double low = std::max(wet.a.y, dry.a.y), high = std::min(wet.b.y, dry.b.y);
            if (!(high > low)) continue;
            for (const double sign : {-1.0, 1.0}) { // two points of Gauss: exact for linear N_f times quadratic N_s
                const double weight = 0.5 * (high - low), y = 0.5 * (low + high) + sign * weight / std::sqrt(3.0);
                const double eta = wet.share_of_upper(y), xi = dry.share_of_upper(y);
                for (const auto& [pressure_node, n_f] : {std::pair{wet.lower, 1.0 - eta}, std::pair{wet.upper, eta}})
                    for (const auto& [dam_node, n_s] : dry.shape(xi))
                        for (const int c : {0, 1}) {
                            if (dam_node < 0) continue;
                            const int row = displacements(dam_node, c), column = pressures(pressure_node);
                            if (row != no_dof && column != no_dof)
                                entries.emplace_back(row, column, weight * n_s * n_f * normal[c]);
                        }
            }
        }
    }
    SparseMatrix coupling(displacements.count, unknowns);
    coupling.setFromTriplets(entries.begin(), entries.end());
    return coupling;
}

Eigen::VectorXd boundary_flux(const Mesh& water, const DofMap& pressures, const NodeChain& chain,
                              const Eigen::Vector2d& direction, Index unknowns)
{
    Eigen::VectorXd flux = Eigen::VectorXd::Zero(unknowns);
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        const Point a = water.nodes[chain[k]], b = water.nodes[chain[k + 1]];
        const double through = direction.x() * (b.y - a.y) - direction.y() * (b.x - a.x);
        for (const int node : {chain[k], chain[k + 1]})
            if (pressures(node) != no_dof) flux[pressures(node)] += 0.5 * through;
    }
    return flux;
}

} // namespace damslip::fe2d
