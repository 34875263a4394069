#pragma once

#include <Eigen/SparseCore>
#include <complex>
#include <memory>

namespace damslip::fe2d {

/// (K + sC + s²M) x = b, s = σ + iω, of one body at one frequency after another: complex symmetric L Lᵀ (no conjugates) by fronts,
/// ordered once for all frequencies (CHOLMOD), without pivoting. What that costs in digits is checked by every solution's
/// residual and mended by iterative refinement. A third of the time of an unsymmetric LU with pivoting (UMFPACK).
/// BLAS runs on one thread. One object belongs to one thread at a time.
class FrequencySolver {
public:
    using Matrix = Eigen::SparseMatrix<double>;

    /// @param mass, damping, stiffness  symmetric, of one size, stored whole
    /// @throws std::bad_alloc
    FrequencySolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness);
    ~FrequencySolver();
    FrequencySolver(const FrequencySolver&) = delete;
    FrequencySolver& operator=(const FrequencySolver&) = delete;

    /// @param frequency  ω [rad/s]
    /// @param growth  σ >= 0 of loads that grow with e^{σt} [1/s]
    /// @returns whether all pivots are usable
    bool factorise(double frequency, double growth = 0.0);

    /// Real loads, one column each. Needs a factorisation that did not fail.
    /// @returns solutions; residual() says how good they are
    Eigen::MatrixXcd solve(const Eigen::MatrixXd& loads);

    double residual() const; ///< largest ‖D x - b‖/‖b‖ of the last solve() [-]
    int factorisations() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace damslip::fe2d
