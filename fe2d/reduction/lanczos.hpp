#pragma once

#include <Eigen/SparseCore>

#include <functional>

namespace damslip::fe2d {

/// Eigenpairs of B y = θ y, B self-adjoint in the inner product of M, largest θ first.
struct LanczosPairs {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors; ///< M-orthonormal columns
    bool converged = false;
    int applications = 0;
};

/// Lanczos (1950) without restart, with full reorthogonalisation, a second time where the first one
/// cancels (Daniel, Gragg, Kaufman & Stewart 1976), from a fixed start:
/// same problem, same bits.
/// @param multiply  x -> M^-1-self-adjoint operator applied to (M x), given M x
/// @param deflated  M-orthonormal columns that the search leaves out
/// @param tolerance  of the residual over the largest θ's own size [-]
LanczosPairs lanczos(const std::function<Eigen::VectorXd(const Eigen::VectorXd& mass_times_x)>& multiply,
                     const Eigen::SparseMatrix<double>& mass, const Eigen::MatrixXd& deflated, int count,
                     double tolerance);

} // namespace damslip::fe2d
