#pragma once

#include <Eigen/SparseCore>

#include <complex>
#include <memory>

namespace damslip::fe2d {

/// (K + sC + s²M) x = b, s = σ + iω, of one body at one frequency after another: complex sparse LU (UMFPACK), ordered once
/// for all frequencies. BLAS runs on one thread. One object belongs to one thread at a time.
class FrequencySolver {
public:
    using Matrix = Eigen::SparseMatrix<double>;

    /// @param mass, damping, stiffness  symmetric, of one size, stored whole
    FrequencySolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness);
    ~FrequencySolver();
    FrequencySolver(const FrequencySolver&) = delete;
    FrequencySolver& operator=(const FrequencySolver&) = delete;

    /// @param frequency  ω [rad/s]
    /// @param growth  σ >= 0 of loads that grow with e^{σt} [1/s]
    /// @returns whether the matrix is regular
    /// @throws std::bad_alloc
    bool factorise(double frequency, double growth = 0.0);

    /// Real loads, one column each. Needs a factorisation that did not fail.
    Eigen::MatrixXcd solve(const Eigen::MatrixXd& loads) const;

    int factorisations() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace damslip::fe2d
