#pragma once

#include "core/vector_level.hpp"
#include "fe2d/run/node_order.hpp"

#include <Eigen/Core>

#include <vector>

namespace damslip::fe2d {

/// L D Lᵀ of a symmetric matrix in the order given, without pivoting: row by row of L (Davis 2005, ACM TOMS 31, 587-591), both
/// unknowns of a node at a time. Every number is computed by the operations of Eigen::SimplicialLDLT in its order, so it has
/// the same bits, on every vector level. A matrix whose pattern is not made of full 2 x 2 blocks goes through Eigen's class.
struct NodeLdlt {
    /// L(2i, 2j), L(2i+1, 2j), L(2i, 2j+1), L(2i+1, 2j+1)
    struct Block {
        double v[4];
    };
    bool exists = false; ///< false: a pivot is zero
    std::vector<int> begin,
        row; ///< blocks below the diagonal of column j: begin[j] ... begin[j+1]-1; row: node, ascending
    std::vector<Block> block;
    std::vector<double> inside; ///< L(2j+1, 2j)
    Eigen::VectorXd diagonal;   ///< D
};

/// @param matrix  both triangles, of which the lower one is read @param added  to its diagonal
NodeLdlt node_ldlt(const SparseMatrix& matrix, const Eigen::VectorXd& added, VectorLevel level = vector_level());

/// Is the pattern made of full 2 x 2 blocks, those on the diagonal among them? Unknowns that stand alone, with a number on the
/// diagonal only, are left out of it: they are held.
bool in_node_blocks(const SparseMatrix& matrix);

} // namespace damslip::fe2d
