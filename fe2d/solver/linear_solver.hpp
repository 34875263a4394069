#pragma once

#include "core/status.hpp"

#include <Eigen/SparseCore>
#include <cstdint>
#include <memory>
#include <string>

namespace damslip::fe2d {

enum class Factorisation {
    automatic,  ///< simplicial up to `supernodal_above` unknowns, supernodal beyond
    simplicial, ///< L D L^T without BLAS: the same bits on every machine; also for quasi-definite matrices
    supernodal  ///< L L^T with BLAS: faster for large matrices, positive definite ones only
};

enum class Definiteness {
    positive,      ///< a pivot <= 0 is reported as `not_positive_definite`
    quasi_definite ///< positive and negative pivots are expected: [[A, B], [B^T, -C]] with A, C positive definite;
                   ///< always simplicial
};

struct SolverOptions {
    Factorisation factorisation = Factorisation::automatic;
    Definiteness definiteness = Definiteness::positive;
    int supernodal_above = 20000;  ///< unknowns
    double residual_limit = 1e-10; ///< largest |A x - b| / |b| accepted after a factorisation [-]
    double smallest_pivot =
        1e-13; ///< of the matrix scaled to a unit diagonal; below it the matrix counts as singular [-]
};

enum class SolverStatus {
    ok,
    not_factorised,        ///< nothing has been factorised yet
    not_positive_definite, ///< a pivot <= 0 turned up: a mechanism, or the wrong definiteness
    singular,              ///< the smallest pivot is round-off: a mechanism, such as a body nothing holds
    inaccurate,            ///< the residual check failed
    out_of_memory
};

/// What one factorisation was and cost. The counters are exact, not estimates.
struct SolverReport {
    SolverStatus status = SolverStatus::not_factorised;
    double residual = 0.0;       ///< |A x - b| / |b|, largest components, for x = (1, -1, 1, ...) scaled, b = A x
    double forward_error = 0.0;  ///< |x_computed - x| / |x| of the same check: about condition number times round-off
    double smallest_pivot = 0.0; ///< relative to a unit diagonal
    int negative_pivots = 0;     ///< simplicial only
    bool supernodal = false;
    std::int64_t unknowns = 0;
    std::int64_t nonzeros_matrix = 0; ///< stored entries of A, both triangles
    std::int64_t nonzeros_factor = 0; ///< of L
    std::int64_t bytes = 0;           ///< held by the solver: factor and scaling
    int analyses = 0;                 ///< orderings computed so far
    int factorisations = 0;           ///< so far

    bool ok() const { return status == SolverStatus::ok; }
    Note note() const; ///< the status with its numbers
};

/// Sparse direct solver for symmetric systems (CHOLMOD). The matrix is scaled to D A D with D = a_ii^-1/2 rounded to
/// powers of two, so the scaling itself is exact. One object belongs to one thread at a time; different objects are
/// independent. BLAS runs on one thread.
class LinearSolver {
public:
    explicit LinearSolver(const SolverOptions& options = {});
    ~LinearSolver();
    LinearSolver(LinearSolver&&) noexcept;
    LinearSolver& operator=(LinearSolver&&) noexcept;

    /// Factorises a symmetric matrix stored whole (both triangles; the lower one is used) and checks one solution. The
    /// ordering is kept as long as the pattern stays the same. Never throws for a bad matrix: look at the report's
    /// status. @throws std::bad_alloc when memory does not suffice: that says nothing of the matrix
    const SolverReport& factorise(const Eigen::SparseMatrix<double>& matrix);

    const SolverReport& report() const;

    /// A x = b for one vector or, column by column, many: they are solved in blocks of 16. Needs a factorisation that
    /// did not fail.
    Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
    Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

    std::int64_t solves() const; ///< right-hand sides solved so far, the check's included

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Sets OpenBLAS and OpenMP to one thread (no-op with another BLAS): results then do not depend on the number of cores,
/// and runs do not compete with each other. Reading OPENBLAS_NUM_THREADS happens at load time, so the environment is
/// too late for a running program.
void use_one_blas_thread();

} // namespace damslip::fe2d
