#pragma once

#include "fe2d/assembly/surface_load.hpp"

#include <array>
#include <vector>

namespace damslip::fe2d {

/// One quadrature point of the added mass: a mass that moves with the face in its normal direction alone.
struct AddedMassPoint {
    std::array<int, 3> nodes{-1, -1, -1}; ///< both corners of the edge and its middle; -1: linear edge
    std::array<double, 3> shape{};        ///< N_i there [-]
    Eigen::Vector2d normal;               ///< outward unit vector
    Point at;
    double mass = 0.0; ///< [kg/m]
};

/// The points of added_mass_matrix(): the sum of mass N_i N_j n n^T over them is that matrix, to round-off. For programs
/// that know point masses, but no matrices of a face.
std::vector<AddedMassPoint> added_mass_points(const Mesh& mesh, const NodeChain& chain, const AddedMassLaw& law,
                                              double surface_level);

} // namespace damslip::fe2d
