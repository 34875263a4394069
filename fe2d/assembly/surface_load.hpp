#pragma once

#include "core/geometry.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "scene/uplift_models.hpp"

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace damslip::fe2d {

/// Mass of water that moves with the face in its normal direction, per area of wet face [kg/m^2]; `face_angle` phi is
/// the inclination of the face from the vertical, positive where the body widens downwards [rad].
using AddedMassLaw = std::function<double(Point, double face_angle)>;

/// Loads and added mass on boundary chains. Integrals are taken below `surface_level` only: an edge that the water
/// surface cuts is integrated over its wet part, so a level between two nodes costs no accuracy in the resultant. Chains
/// are of corners; edges with a node in their middle are integrated with their three shape functions.

inline constexpr double everywhere = std::numeric_limits<double>::infinity();

/// Pressure at a point of the boundary [Pa]; positive pushes against the body.
using PressureField = std::function<double(Point)>;

/// Nodal forces - integral of N^T p n_out dS [N/m] of a pressure on a chain. Exact for pressures linear along each wet
/// edge.
Eigen::VectorXd pressure_load(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain,
                              const PressureField& pressure, double surface_level = everywhere);

/// Integral of m N^T n n^T N dS [kg/m] (Goldgruber 2015, (3-29) with m the normal component): consistent, full along
/// each edge.
SparseMatrix added_mass_matrix(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain, const AddedMassLaw& law,
                               double surface_level);

/// The same matrix times a rigid translation of every node, the fixed ones included [kg/m]; compare inertia_vector.
Eigen::VectorXd added_mass_inertia(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain,
                                   const AddedMassLaw& law, double surface_level, const Eigen::Vector2d& direction);

enum class ContactSide { dam, rock };

/// Water pressure in the joint [N/m]: on the dam it lifts along the upward normal of the plane, on the rock it presses
/// the opposite way.
/// @param profile  integrated exactly, whatever the mesh; nothing outside of it
Eigen::VectorXd uplift_load(const Mesh& mesh, const DofMap& dofs, const PressureProfile& profile, ContactSide side);

/// Water pressure in a lift joint on both its faces [N/m]: it lifts the block above along the upward normal of the joint
/// and presses the dam below the opposite way; with shared unknowns (tied) the two cancel.
/// @param profile  distances from the upstream face along the joint [m]
Eigen::VectorXd lift_water_load(const Mesh& mesh, const DofMap& dofs, std::size_t joint,
                                const PressureProfile& profile);

/// A force at a point of the dam, shared by the nodes of its element so that force and moment are kept [N/m].
/// @returns nothing when the point is more than 1e-6 of the dam's size outside.
std::optional<Eigen::VectorXd> point_load(const Mesh& mesh, const DofMap& dofs, Point at, const Eigen::Vector2d& force);

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
