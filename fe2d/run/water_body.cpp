#include "fe2d/run/water_body.hpp"

#include "fe2d/fluid/fluid_model.hpp"

#include <cassert>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Entries of a matrix of the coupled system at their new places.
SparseMatrix moved(const SparseMatrix& matrix, const std::vector<Index>& to, Index size, Triplets entries = {})
{
    for (Index column = 0; column < matrix.outerSize(); ++column)
        for (SparseMatrix::InnerIterator it(matrix, column); it; ++it)
            entries.emplace_back(to[static_cast<std::size_t>(it.row())], to[static_cast<std::size_t>(column)],
                                 it.value());
    SparseMatrix result(size, size);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

VectorXd moved(const VectorXd& vector, const std::vector<Index>& to, Index size)
{
    VectorXd result = VectorXd::Zero(size);
    for (Index i = 0; i < vector.size(); ++i) result[to[static_cast<std::size_t>(i)]] = vector[i];
    return result;
}

} // namespace

WaterBody::WaterBody(const Scene& scene, const Model& model, WaterBeside beside)
    : water(build_fluid(scene)),
      dam_unknowns(2 * (beside == WaterBeside::dam ? model.mesh.dam_node_count : model.mesh.node_count()))
{
    assert(model.added_mass.nonZeros() == 0);
    const Index n = dam_unknowns;
    const Index dam = 2 * model.mesh.dam_node_count;
    coupling = face_coupling(model.mesh, model.dofs, water.reservoir, water.dofs, water.unknowns()).topRows(dam);
    coupling.conservativeResize(n, coupling.cols());
    const SparseMatrix none(n, n);
    const CoupledSystem system = couple(none, none, none, coupling, water);
    scale = system.scale;
    size = n + 2 * static_cast<Index>(system.water_pairs.size());

    std::vector<Index> to(static_cast<std::size_t>(system.size()));
    for (Index i = 0; i < n; ++i) to[static_cast<std::size_t>(i)] = i;
    Triplets alone; // stiffness of unknowns without a partner: any negative number
    const double unit = system.stiffness.diagonal().minCoeff();
    for (std::size_t pair = 0; pair < system.water_pairs.size(); ++pair)
        for (const std::size_t c : {0, 1}) {
            const Index here = n + static_cast<Index>(2 * pair + c), unknown = system.water_pairs[pair][c];
            if (unknown < 0)
                alone.emplace_back(here, here, unit);
            else
                to[static_cast<std::size_t>(unknown)] = here;
        }
    place.assign(to.begin() + n, to.end());
    mass = moved(system.mass, to, size);
    damping = moved(system.damping, to, size);
    stiffness = moved(system.stiffness, to, size, alone);
    velocity_x = moved(system.velocity_x, to, size);
    velocity_y = moved(system.velocity_y, to, size);
    displacement_y = moved(system.displacement_y, to, size);
}

} // namespace damslip::fe2d
