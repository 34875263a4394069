#pragma once

#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/scheme.hpp"

#include <Eigen/SparseCore>
#include <span>

namespace damslip::fe2d {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// M ü + C u̇ + K u = R(t) + Bᵀ λ: everything of the model that is linear, supports already eliminated. n unknowns.
/// All matrices are n x n and symmetric, both triangles stored. M may be singular (massless rock); a0 M + a1 C + K must
/// be positive definite. The interface forces λ of contact stay outside: no matrix here knows them.
struct LinearSystem {
    SparseMatrix mass;        ///< M, structure and added mass [kg/m]
    SparseMatrix damping;     ///< sparse part of C [N s/m^2]
    SparseMatrix stiffness;   ///< K [N/m^2]
    LowRank damping_low_rank; ///< rest of C (damping of the deformation only); may be empty

    Eigen::Index size() const { return stiffness.rows(); }
    void add_damping_product(const Eigen::VectorXd& velocity, Eigen::VectorXd& force) const; ///< force += C velocity
};

/// True where a row of M holds no non-zero entry.
std::vector<char> massless_unknowns(const SparseMatrix& mass);

/// Largest natural circular frequency of K - ω² M, undamped, by 80 steps of Lanczos' method, which approaches it from
/// below (relative error below 1e-6 in the tests) [rad/s]; infinite when M is singular. Needed by conditionally stable
/// schemes only.
double highest_frequency(const LinearSystem& system);

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
