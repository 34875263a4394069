#pragma once

#include "core/version.hpp"
#include "fe2d/run/node_products.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace damslip::fe2d {

/// Are the signs of the interface's rest checked, by a factorisation of it, or known from another matrix of the same structure?
enum class InterfaceSigns { checked, known };

/// L D L^T of the inner nodes of one body in the order of interface_last, in 2 x 2 blocks, and the dense rest: the
/// Schur complement on the interface. One forward and one backward pass solve the body with whatever happens on the
/// interface in between, so a time step with contact costs no more than one without.
///
///     forward:   inner part becomes L⁻¹ b_i, interface part  b_c - A_ci A_ii⁻¹ b_i  (the condensed load)
///     backward:  from that and the interface displacements u_c:  u_i = A_ii⁻¹ (b_i - A_ic u_c)
///
/// With ties A is Tᵀ A T and u_c is q, their jumps: forward() begins with Tᵀ b, backward() ends with T u.
class InterfaceFactor {
public:
    /// @param matrix  symmetric, in the order (NodeOrder::to_new), both triangles. The inner part must be positive
    /// definite, or quasi-definite with acoustic water (CoupledSystem: L D Lᵀ then exists in every order; 2 x 2 blocks of
    /// one sign each); the whole may be singular (a body held by nothing).
    /// @param negative  how many of the inner unknowns have a negative pivot; -1: any number
    /// @param negative_nodes  the first nodes of the interface with a negative definite diagonal block, pressures; the others' is
    /// positive
    /// @param ties  by the nodes of the matrix
    InterfaceFactor(const SparseMatrix& matrix, int inner_nodes, int negative = 0, int negative_nodes = 0,
                    std::vector<Tie> ties = {}, InterfaceSigns signs = InterfaceSigns::checked);

    bool regular() const { return regular_; }
    const Eigen::MatrixXd& schur() const { return schur_; } ///< A_cc - A_ci A_ii⁻¹ A_ic, unknowns (x, y) by node

    /// @param level  the same bits on every level
    void forward(Eigen::VectorXd& b, VectorLevel level = vector_level()) const;
    /// @param b  interface part: u_c on entry, kept. Where it is zero nothing is read of the factor: jumps of pairs that stick.
    void backward(Eigen::VectorXd& b, VectorLevel level = vector_level()) const;
    /// Several vectors in one pass over the factor: up to four at a time, each with the same bits as alone.
    /// @param gathered  work space
    void forward(std::span<Eigen::VectorXd* const> b, std::vector<double>& gathered) const;
    void backward(std::span<Eigen::VectorXd* const> b, std::vector<double>& gathered) const;
    /// a_i^T A_ii⁻¹ b_i of two vectors after forward().
    double inner_product(const Eigen::Ref<const Eigen::VectorXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b) const;

    Eigen::Index inner_unknowns() const { return 2 * inner_; }
    std::size_t bytes() const;

    /// L(2i, 2j), L(2i+1, 2j), L(2i, 2j+1), L(2i+1, 2j+1): by columns. Two that follow each other in a column of blocks share
    /// their places: the first columns of both, then the second ones. The last of an odd number stands alone.
    struct alignas(32) Block {
        double v[4];
    };
    struct Pivot {
        double xx, xy, yy; ///< inverse of the diagonal block
    };

private:
    template <int columns>
    void forward_columns(double* x) const;
    template <int columns>
    void backward_columns(double* x) const;
    template <int columns>
    void forward_together(double* x) const;
    template <int columns>
    void backward_together(double* x) const;
    void forward_one(double* x, VectorLevel level) const;
    void backward_one(double* x, VectorLevel level) const;
#if DAMSLIP_HAS_AVX2
    void forward_avx2(double* x) const;
    void backward_avx2(double* x) const;
    template <int columns>
    void forward_columns_avx2(double* x) const;
    template <int columns>
    void backward_columns_avx2(double* x) const;
#endif

    void to_ties(Eigen::VectorXd& b) const;
    void from_ties(Eigen::VectorXd& x) const;

    int inner_;
    std::vector<Tie> ties_;
    bool regular_ = false;
    std::vector<int> begin_, row_; ///< blocks of column j: begin_[j] ... begin_[j+1]-1; row_: node, ascending
    std::vector<Block> block_;
    std::vector<Pivot> pivot_;
    Eigen::MatrixXd schur_;
};

} // namespace damslip::fe2d
