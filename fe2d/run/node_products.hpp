#pragma once

#include "core/version.hpp"

#include <Eigen/Core>
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

/// An interface node that moves by its unknowns beyond an inner one: u_upper = u_lower + q.
struct Tie {
    int upper = 0, lower = 0;
};

/// Tᵀ A T of u = T (inner unknowns, q). @param ties  by the nodes of the matrix
SparseMatrix tied(const SparseMatrix& matrix, std::span<const Tie> ties);

/// Minimum degree order of the inner nodes (Amestoy, Davis & Duff 1996) by the pattern of a matrix with two unknowns per
/// node.
NodeOrder interface_last(const SparseMatrix& matrix, std::span<const int> interface_nodes);

/// Vectors of one body that a step multiplies with K and M.
struct ProductVectors {
    const Eigen::VectorXd& stiffness_1;
    const Eigen::VectorXd& stiffness_2;
    const Eigen::VectorXd& mass_1;
    const Eigen::VectorXd& mass_2;
};

struct Products {
    Eigen::VectorXd stiffness_1, stiffness_2, mass_1, mass_2; ///< K x₁, K x₂, M x₃, M x₄
    Eigen::VectorXd dam_mass_1, dam_mass_2; ///< M_dam x₃, M_dam x₄: set by who knows the dam's share
    std::vector<double> gathered;           ///< work space: the eight entries of each node side by side
};

/// K and M of one body with two unknowns per node in common 2 x 2 blocks, so that the four products of a step read
/// the matrices once.
class BlockProducts {
public:
    BlockProducts(const SparseMatrix& stiffness, const SparseMatrix& mass);

    /// @param level  the same bits on every level
    void multiply(const ProductVectors& in, Products& out, VectorLevel level = vector_level()) const;
    /// K x and M x of one vector.
    void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& stiffness, Eigen::VectorXd& mass,
                  VectorLevel level = vector_level()) const;
    std::size_t bytes() const;

private:
    struct alignas(32) Block {
        double v[4]; ///< xx, yx, xy, yy
    };
#if DAMSLIP_HAS_AVX2
    void multiply_avx2(const double* gathered, Products& out) const;
    void multiply_avx2(const double* x, double* stiffness, double* mass) const;
#endif
    const Block* full_mass(int node) const
    {
        return full_mass_.data() + full_begin_[node];
    }

    std::vector<int> begin_, column_;
    std::vector<Block> stiffness_;
    std::vector<double> mass_;     ///< of nodes whose rows have m_xx = m_yy and no m_xy: one number for a block
    std::vector<Block> full_mass_; ///< of the others, as those that move water
    std::vector<int> full_begin_;  ///< where the row of a node begins in full_mass_; -1: it stands in mass_
};

/// Columns of L D Lᵀ of a symmetric matrix in the order given, without pivoting: row by row of L (Davis 2005, ACM TOMS 31, 587-591),
/// both unknowns of a node at a time. Every number is computed by the operations of Eigen::SimplicialLDLT in its order, so it has
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

    /// What elimination leaves of the other nodes: A_cc - L_c D L_cᵀ. @param matrix  that was factorised
    Eigen::MatrixXd schur(const SparseMatrix& matrix) const;
};

/// @param matrix  both triangles, of which the lower one is read
/// @param eliminated  nodes whose columns are computed, the first ones; the rest of the matrix may be singular
NodeLdlt node_ldlt(const SparseMatrix& matrix, int eliminated, VectorLevel level = vector_level());

/// Is the pattern made of full 2 x 2 blocks, those on the diagonal among them? Unknowns that stand alone, with a number on the
/// diagonal only, are left out of it: they are held.
bool in_node_blocks(const SparseMatrix& matrix);

} // namespace damslip::fe2d
