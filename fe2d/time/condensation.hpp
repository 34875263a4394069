#pragma once

#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/linear_system.hpp"

#include <span>

namespace damslip::fe2d {

/// A massless elastic body (rock) reduced exactly to the unknowns through which the rest of the model touches it.
///
/// With C = b K (one b for the whole body), loads f_i inside constant in time and equilibrium at the start, the inner
/// equations b (K_ii v_i + K_ic v_c) + K_ii u_i + K_ic u_c = f_i keep u_i = K_ii⁻¹ (f_i - K_ic u_c) for all times, so
/// the body acts on the rest through K_c = K_cc - K_ci K_ii⁻¹ K_ic and b K_c alone, at any step size and in any scheme.
class CondensedBody {
public:
    /// @param stiffness  of the body, n x n, symmetric, both triangles, supports eliminated
    /// @param kept       unknowns c that stay, each once; the order of results
    CondensedBody(const SparseMatrix& stiffness, std::span<const Eigen::Index> kept);

    /// Of K_ii; when it is not ok() the inner unknowns are not held and nothing below is valid.
    const SolverReport& report() const { return factor_.report(); }
    const Eigen::MatrixXd& stiffness() const { return stiffness_; } ///< K_c, symmetric
    Eigen::VectorXd
    condense_load(const Eigen::VectorXd& load) const; ///< f_c - K_ci K_ii⁻¹ f_i of a load on all n unknowns
    /// All n displacements from those kept and the constant load on all n unknowns (its kept part is not used).
    Eigen::VectorXd recover(const Eigen::VectorXd& kept_displacement, const Eigen::VectorXd& load) const;

private:
    struct Partition {
        std::vector<Eigen::Index> kept, inner;
        SparseMatrix k_cc, k_ci, k_ii;
    };
    static Partition partition(const SparseMatrix& stiffness, std::span<const Eigen::Index> kept);
    explicit CondensedBody(Partition partition);

    Partition parts_;
    LinearSolver factor_; ///< of K_ii
    Eigen::MatrixXd stiffness_;
};

/// Adds a dense block at the given unknowns to a sparse matrix: matrix(at[i], at[j]) += factor block(i, j).
void add_dense_block(SparseMatrix& matrix, const Eigen::MatrixXd& block, std::span<const Eigen::Index> at,
                     double factor);

} // namespace damslip::fe2d
