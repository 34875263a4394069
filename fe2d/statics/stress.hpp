#pragma once

#include "fe2d/model/model.hpp"

#include <Eigen/Core>

namespace damslip::fe2d {

/// Stresses of a displacement state, tension positive [Pa].
struct StressField {
    Eigen::Matrix3Xd nodal;  ///< (xx, yy, xy) of every node: mean over its elements of the same region; a node on the
                             ///< curtain's edge takes the mean of rock and curtain. The two sides of the contact plane
                             ///< are separate nodes and stay separate
    Eigen::Matrix3Xd centre; ///< (xx, yy, xy) of every element at its centre, the most accurate place
};

/// @param displacement  of the unknowns, length dofs.count [m]
StressField stress_field(const Mesh& mesh, const DofMap& dofs, const Materials& materials,
                         const Eigen::VectorXd& displacement);

struct PrincipalStress {
    double major = 0.0; ///< the larger (more tensile) one [Pa]
    double minor = 0.0; ///< [Pa]
    double angle = 0.0; ///< of the major one from the x axis, -pi/2 ... pi/2 [rad]
};
PrincipalStress principal_stress(const Eigen::Vector3d& stress);

} // namespace damslip::fe2d
