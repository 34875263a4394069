#include "fe2d/reduction/lanczos.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Without symmetry and the same every time: a linear congruential sequence in -1 ... 1.
VectorXd start_vector(Index n)
{
    VectorXd v(n);
    std::uint32_t state = 20150101u;
    for (double& x : v) {
        state = 1664525u * state + 1013904223u;
        x = static_cast<double>(state) / 2147483648.0 - 1.0;
    }
    return v;
}

} // namespace

LanczosPairs lanczos(const std::function<VectorXd(const VectorXd& mass_times_x)>& multiply,
                     const Eigen::SparseMatrix<double>& mass, const MatrixXd& deflated, int count, double tolerance)
{
    const Index n = mass.rows(), rigid = deflated.cols(), limit = std::min<Index>(n - rigid, 6 * count + 60);
    // Columns: deflated, then Lanczos vectors; both are kept M-orthonormal to everything before.
    MatrixXd basis(n, rigid + limit + 1), mass_basis(n, rigid + limit + 1);
    basis.leftCols(rigid) = deflated;
    mass_basis.leftCols(rigid) = mass * deflated;
    Index used = rigid;
    const auto append = [&](VectorXd x) {
        for (int pass = 0; pass < 2; ++pass) { // once more only where the first pass left little
            const double before = x.norm();
            x -= basis.leftCols(used) * (mass_basis.leftCols(used).transpose() * x).eval();
            if (x.norm() > 0.5 * before) break;
        }
        const VectorXd mx = mass * x;
        const double norm = std::sqrt(std::max(0.0, x.dot(mx)));
        if (norm > 0.0) {
            basis.col(used) = x / norm;
            mass_basis.col(used) = mx / norm;
            ++used;
        }
        return norm;
    };
    LanczosPairs result;
    append(start_vector(n));
    VectorXd diagonal(limit), below(limit);
    Index next_check = std::min<Index>(limit, 2 * count + 10);
    for (Index j = 0; j < limit; ++j) {
        VectorXd y = multiply(mass_basis.col(rigid + j));
        ++result.applications;
        diagonal[j] = y.dot(mass_basis.col(rigid + j));
        y -= diagonal[j] * basis.col(rigid + j);
        if (j > 0) y -= below[j - 1] * basis.col(rigid + j - 1);
        below[j] = append(y);
        const bool exhausted = j + 1 == limit || below[j] == 0.0;
        if (j + 1 < next_check && !exhausted) continue;
        next_check = j + 1 + 10;
        Eigen::SelfAdjointEigenSolver<MatrixXd> ritz;
        ritz.computeFromTridiagonal(diagonal.head(j + 1), below.head(j));
        const Index found = std::min<Index>(count, j + 1);
        const double worst = (below[j] * ritz.eigenvectors().row(j).tail(found)).cwiseAbs().maxCoeff();
        result.converged = found == count && worst <= tolerance * ritz.eigenvalues()[j + 1 - found];
        if (!result.converged && !exhausted) continue;
        result.values = ritz.eigenvalues().tail(found).reverse();
        result.vectors = basis.middleCols(rigid, j + 1) * ritz.eigenvectors().rightCols(found).rowwise().reverse();
        break;
    }
    return result;
}

} // namespace damslip::fe2d
