#pragma once

#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/linear_system.hpp"
#include "fe2d/time/scheme.hpp"

namespace damslip::fe2d {

/// How displacements of the interface follow its forces within one step.
struct InterfaceFlexibility {
    Eigen::MatrixXd response; ///< G = A⁻¹ Bᵀ, n x m [m^2/N]
    Eigen::MatrixXd delassus; ///< W = (1+α) B A⁻¹ Bᵀ, m x m, symmetric, positive semi-definite [m^2/N]
};

/// The matrix of one step size, factorised once:
///
///     A = a0 M + (1+α)(a1 C + K)
///
/// The low-rank part of C enters by the Sherman-Morrison-Woodbury formula, A⁻¹b = x - Z (I + S'UᵀZ)⁻¹ S'Uᵀ x with x =
/// A_s⁻¹ b, Z = A_s⁻¹U, S' = (1+α) a1 S, so A_s keeps the sparsity of K.
class StepOperator {
public:
    /// @param constants  of the step; step_constants() unless a test wants them wrong
    /// A singular A (a floating, massless part) shows in report(); nothing may be solved then.
    StepOperator(const LinearSystem& system, const StepConstants& constants, const SolverOptions& solver = {});

    const StepConstants& constants() const { return constants_; }
    const SolverReport& report() const { return factor_.report(); }
    Eigen::VectorXd solve(const Eigen::VectorXd& right_hand_side) const;       ///< A⁻¹ b
    Eigen::MatrixXd solve_columns(const SparseMatrix& right_hand_sides) const; ///< A⁻¹ of n x m columns, 16 at a time
    InterfaceFlexibility flexibility(const SparseMatrix& interface_map) const; ///< B is m x n

private:
    void correct_low_rank(Eigen::MatrixXd& solutions) const;

    StepConstants constants_;
    LinearSolver factor_;
    Eigen::MatrixXd columns_;  ///< U
    Eigen::MatrixXd response_; ///< Z = A_s⁻¹ U
    Eigen::MatrixXd small_;    ///< (I + S'UᵀZ)⁻¹ S', k x k
};

} // namespace damslip::fe2d
