#pragma once

#include "core/vector_level.hpp"
#include "fe2d/run/node_order.hpp"

#include <Eigen/Core>

#include <vector>

namespace damslip::fe2d {

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

} // namespace damslip::fe2d
