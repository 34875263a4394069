#pragma once

#include "fe2d/run/node_order.hpp"
#include "fe2d/run/vector_level.hpp"

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
    std::size_t bytes() const { return block_.size() * sizeof(Block) + (column_.size() + begin_.size()) * sizeof(int); }

private:
    struct alignas(64) Block { // a line of the cache
        double k[4], m[4];     ///< xx, yx, xy, yy
    };
#if DAMSLIP_HAS_AVX2
    void multiply_avx2(const double* gathered, Products& out) const;
    void multiply_avx2(const double* x, double* stiffness, double* mass) const;
#endif
    std::vector<int> begin_, column_;
    std::vector<Block> block_;
};

} // namespace damslip::fe2d
