#pragma once

#include <Eigen/SparseCore>

#include <vector>

namespace damslip::fe2d {

/// Trace of the rock's displacements on the dam's contact nodes when the dam has slid along the plane: the segment-to-
/// segment (mortar) projection of the two sides with dual shape functions on the dam (Wohlmuth 2000), so that the
/// contact force of a dam node stays its own unknown:
///
///     P_ij = (1/A_i) ∫ ψ_i N_j dx,   ∫ ψ_i N_k^dam dx = δ_ik A_i
///
/// gap g = u_dam - P u_rock, forces on the rock -P^T λ. Rows sum to one and P x_rock = x_dam + s, so force and moment
/// resultants pass exactly whatever the meshes and the slip; P depends smoothly on s, also where a node passes another.
/// With equal meshes and s = 0 it is the identity.
class Pairing {
public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    /// @param dam   places of the dam's nodes along the plane, increasing [m]
    /// @param rock  places of the rock's nodes, increasing [m]
    Pairing(std::vector<double> dam, std::vector<double> rock);

    /// How far the dam may slide so that all of it still faces rock [m].
    double reach_upstream() const { return rock_.front() - dam_.front(); } ///< <= 0
    double reach_downstream() const { return rock_.back() - dam_.back(); } ///< >= 0
    bool reaches(double slip) const;
    double smallest_element() const; ///< of both sides [m]

    /// @param slip  of the dam, positive downstream, within reach [m]
    Matrix weights(double slip) const; ///< P, m x n [-]

private:
    std::vector<double> dam_, rock_;
};

} // namespace damslip::fe2d
