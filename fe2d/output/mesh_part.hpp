#pragma once

#include "fe2d/mesh/mesh.hpp"

#include <Eigen/Core>

#include <vector>

namespace damslip::fe2d {

/// Some elements of a mesh with the nodes they use, as a mesh of its own without chains and planes.
struct MeshPart {
    Mesh mesh;
    std::vector<int> nodes;    ///< of the whole mesh, by node of the part
    std::vector<int> elements; ///< the same of elements

    /// Columns of the part's nodes, or elements. @param values  one column per node (element) of the whole mesh
    Eigen::MatrixXd at_nodes(const Eigen::MatrixXd& values) const;
    Eigen::MatrixXd at_elements(const Eigen::MatrixXd& values) const;
};

/// @param first, end  elements first ... end - 1
MeshPart part_of(const Mesh& mesh, int first, int end);

} // namespace damslip::fe2d
