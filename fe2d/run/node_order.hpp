#pragma once

#include <Eigen/SparseCore>

#include <span>
#include <vector>

namespace damslip::fe2d {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Order of the nodes of one body (two unknowns each): inner nodes so that a factorisation fills in little, then the
/// interface nodes as given. Vectors in this order need no permutation while stepping.
struct NodeOrder {
    std::vector<int> old_node; ///< by new node
    std::vector<int> new_node; ///< by old node
    int inner = 0;             ///< nodes that are not on the interface; they come first

    int nodes() const { return static_cast<int>(old_node.size()); }
    Eigen::VectorXd to_new(const Eigen::VectorXd& old_vector) const;
    Eigen::VectorXd to_old(const Eigen::VectorXd& new_vector) const;
    SparseMatrix to_new(const SparseMatrix& old_matrix) const;
};

/// Minimum degree order of the inner nodes (Amestoy, Davis & Duff 1996) by the pattern of a matrix with two unknowns per
/// node.
NodeOrder interface_last(const SparseMatrix& matrix, std::span<const int> interface_nodes);

} // namespace damslip::fe2d
