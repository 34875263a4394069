#pragma once

#include <Eigen/SparseCore>

#include <cassert>

namespace damslip::fe2d {

/// Mass, damping and stiffness stored at the same places, zeros included, so that a matrix made of them at any frequency
/// has the pattern of each and is ordered once.
struct SharedPattern {
    Eigen::SparseMatrix<double> mass, damping, stiffness;
};

/// @pre of one size
inline SharedPattern on_one_pattern(const Eigen::SparseMatrix<double>& mass, const Eigen::SparseMatrix<double>& damping,
                                    const Eigen::SparseMatrix<double>& stiffness)
{
    assert(mass.rows() == stiffness.rows() && damping.rows() == stiffness.rows());
    const auto pattern = [](Eigen::SparseMatrix<double> m) {
        m.makeCompressed();
        m.coeffs().setOnes();
        return m;
    };
    Eigen::SparseMatrix<double> zero = pattern(mass) + pattern(damping) + pattern(stiffness);
    zero.makeCompressed();
    zero.coeffs().setZero();
    SharedPattern shared{mass + zero, damping + zero, stiffness + zero};
    assert(shared.mass.nonZeros() == zero.nonZeros() && shared.damping.nonZeros() == zero.nonZeros());
    return shared;
}

} // namespace damslip::fe2d
