#pragma once

#include "fe2d/mesh/mesh.hpp"

#include <Eigen/Core>

namespace damslip::fe2d {

/// One contact plane as m pairs of nodes. Plane vectors have length 2m: normal components (along the upward normal),
/// then tangential ones (downstream); interface vectors of a body are (x, y) by node.
struct Plane {
    Eigen::Vector2d normal{0.0, 1.0};  ///< up, out of the rock
    Eigen::Vector2d tangent{1.0, 0.0}; ///< downstream
    Eigen::VectorXd distance;          ///< of the pairs from the heel along the plane [m]
    Eigen::VectorXd area;              ///< length of the base that belongs to a pair [m]; their sum is the base length

    Eigen::Index pairs() const { return area.size(); }
    double length() const { return area.sum(); }
    Eigen::VectorXd weights() const { return area / length(); } ///< area weights, sum 1 [-]

    // Of any number of nodes on the plane: the pairs, or the rock's whole line.
    Eigen::VectorXd to_plane(const Eigen::VectorXd& interface) const;
    Eigen::VectorXd to_interface(const Eigen::VectorXd& plane) const;
    Eigen::MatrixXd to_plane(const Eigen::MatrixXd& interface) const; ///< Q A Qᵀ
};

Plane plane_of(const Mesh& mesh);      ///< between dam and rock
Plane plane_of(const LiftPlane& lift); ///< horizontal, between two blocks of the dam

} // namespace damslip::fe2d
