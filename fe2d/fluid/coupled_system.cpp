#include "fe2d/fluid/coupled_system.hpp"

#include <cassert>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void place(const SparseMatrix& matrix, Index row, Index column, double factor, Triplets& entries)
{
    for (Index j = 0; j < matrix.outerSize(); ++j)
        for (SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry)
            entries.emplace_back(row + entry.row(), column + entry.col(), factor * entry.value());
}

SparseMatrix block_diagonal(const SparseMatrix& first, const SparseMatrix& second, double factor, Triplets entries = {})
{
    place(first, 0, 0, 1.0, entries);
    place(second, first.rows(), first.rows(), factor, entries);
    SparseMatrix matrix(first.rows() + second.rows(), first.rows() + second.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

Eigen::VectorXd water_rows(Index structure, const Eigen::VectorXd& values, double factor)
{
    Eigen::VectorXd all = Eigen::VectorXd::Zero(structure + values.size());
    all.tail(values.size()) = factor * values;
    return all;
}

/// Neighbours above each other in the mesh; what is left over, then the unknowns of the far end in their order.
std::vector<std::array<Index, 2>> pairs_of(const FluidModel& water, Index first)
{
    std::vector<std::array<Index, 2>> pairs;
    const auto columns = static_cast<int>(water.reservoir.surface.size()),
               rows = static_cast<int>(water.reservoir.face.size());
    for (int column = 0; column < columns; ++column) {
        std::vector<Index> unknowns;
        for (int row = 0; row < rows; ++row)
            if (const int unknown = water.dofs(row * columns + column); unknown != no_dof)
                unknowns.push_back(first + unknown);
        for (std::size_t k = 0; k < unknowns.size(); k += 2)
            pairs.push_back({unknowns[k], k + 1 < unknowns.size() ? unknowns[k + 1] : -1});
    }
    for (Index k = water.mesh_unknowns; k < water.unknowns(); k += 2)
        pairs.push_back({first + k, k + 1 < water.unknowns() ? first + k + 1 : -1});
    return pairs;
}

} // namespace

CoupledSystem couple(const SparseMatrix& mass, const SparseMatrix& damping, const SparseMatrix& stiffness,
                     const SparseMatrix& coupling, const FluidModel& water)
{
    const Index n = mass.rows();
    assert(coupling.rows() == n && coupling.cols() == water.unknowns());
    CoupledSystem system;
    system.structure_unknowns = n;
    system.water_unknowns = water.unknowns();
    system.scale = water.options.density * water.options.sound_speed();
    const double s = system.scale, s2 = s * s;
    system.mass = block_diagonal(mass, water.mass, -s2);
    system.stiffness = block_diagonal(stiffness, water.stiffness, -s2);
    Triplets across;
    place(coupling, 0, n, -s, across);
    place(coupling.transpose(), n, 0, -s, across);
    system.damping = block_diagonal(damping, water.damping, -s2, std::move(across));
    system.velocity_x = water_rows(n, water.flux_x, s);
    system.velocity_y = water_rows(n, water.flux_y, s);
    system.displacement_y = water_rows(n, water.end_y, s);
    system.water_pairs = pairs_of(water, n);
    return system;
}

std::vector<Index> unknowns_of_floor(const CoupledSystem& system, const FluidModel& water)
{
    std::vector<Index> unknowns = water.floor;
    for (Index& unknown : unknowns) unknown += system.structure_unknowns;
    return unknowns;
}

} // namespace damslip::fe2d
