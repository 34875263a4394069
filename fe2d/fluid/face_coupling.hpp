#pragma once

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/mesh/reservoir_mesh.hpp"

namespace damslip::fe2d {

/// H = ∫ N_sᵀ n N_f dS over the face that water and dam share [m], rows: displacement unknowns, columns: `pressures` unknowns of
/// the water. n points out of the water into the dam, so +H p is the force of the pressure on the dam and Hᵀ ü the volume acceleration
/// the dam takes from the water (Goldgruber 2015, (3-39) with the other normal).
///
/// The two sides may have different nodes: the product of the two traces is integrated over every piece between neighbouring nodes of
/// either side, where it is quadratic, so the rows sum to the exact resultants. Both faces must have the same kinks. Water above the
/// crest has no partner.
SparseMatrix face_coupling(const Mesh& structure, const DofMap& displacements, const ReservoirMesh& water,
                           const DofMap& pressures, Eigen::Index unknowns);

/// ∫ N_f n·r dS over a chain of the water's boundary, n out of the water [m], length `unknowns`.
Eigen::VectorXd boundary_flux(const Mesh& water, const DofMap& pressures, const NodeChain& chain,
                              const Eigen::Vector2d& direction, Eigen::Index unknowns);

} // namespace damslip::fe2d
