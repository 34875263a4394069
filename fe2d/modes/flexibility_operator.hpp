#pragma once

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <Eigen/SparseCholesky>

#include <vector>

namespace damslip::fe2d {

/// The symmetric operator  y -> L^T K^-1 L y  on the unknowns that have mass, M = L L^T there; its eigenvalues are 1 /
/// omega^2. In the form Spectra asks for.
class FlexibilityOperator {
public:
    using Scalar = double;

    /// `solver` holds the factorised K; both must outlive the operator. `valid()` is false when the mass is not
    /// positive definite.
    FlexibilityOperator(const LinearSolver& solver, const SparseMatrix& mass);

    bool valid() const { return factor_.info() == Eigen::Success; }
    Eigen::Index rows() const { return static_cast<Eigen::Index>(massive_.size()); }
    Eigen::Index cols() const { return rows(); }
    void perform_op(const double* in, double* out) const;

    Eigen::VectorXd
    displacement(const Eigen::VectorXd& y) const; ///< K^-1 L y on all unknowns: the mode shape up to its scale
    int applications() const { return applications_; }

private:
    const LinearSolver& solver_;
    std::vector<int> massive_; ///< unknowns with mass
    Eigen::Index unknowns_;
    Eigen::SimplicialLLT<SparseMatrix> factor_;
    SparseMatrix lower_; ///< L in the factor's order of unknowns
    mutable int applications_ = 0;
};

} // namespace damslip::fe2d
