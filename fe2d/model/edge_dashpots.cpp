#include "fe2d/model/edge_dashpots.hpp"

#include <cmath>
#include <utility>

namespace damslip::fe2d {

ElasticWaves elastic_waves(const ElasticMaterial& material)
{
    const double e = material.young_modulus, nu = material.poisson_ratio, rho = material.density;
    return {std::sqrt(e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu) * rho)), std::sqrt(e / (2.0 * (1.0 + nu) * rho))};
}

SparseMatrix edge_dashpots(const Mesh& mesh, const DofMap& dofs, const ElasticMaterial& rock)
{
    const ElasticWaves c = elastic_waves(rock);
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(dofs.count);
    const auto add = [&](const NodeChain& chain, int across) {
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            const Point a = mesh.nodes[static_cast<std::size_t>(chain[i])],
                        b = mesh.nodes[static_cast<std::size_t>(chain[i + 1])];
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            const int mid = mid_node(mesh, chain[i], chain[i + 1]);
            const double share = mid < 0 ? 0.5 : 1.0 / 6.0; // row sums of the edge's mass matrix
            for (const auto& [node, part] :
                 {std::pair{chain[i], share}, {chain[i + 1], share}, {mid, 1.0 - 2.0 * share}})
                for (const int component : {0, 1}) {
                    if (node < 0) continue;
                    if (const int dof = dofs(node, component); dof != no_dof)
                        diagonal[dof] += part * length * rock.density * (component == across ? c.p : c.s);
                }
        }
    };
    add(mesh.box_left, 0);
    add(mesh.box_right, 0);
    add(mesh.box_bottom, 1);
    std::vector<Eigen::Triplet<double>> entries;
    for (int dof = 0; dof < dofs.count; ++dof)
        if (diagonal[dof] != 0.0) entries.emplace_back(dof, dof, diagonal[dof]);
    SparseMatrix matrix(dofs.count, dofs.count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

} // namespace damslip::fe2d
