#pragma once

#include <Eigen/SparseCore>
#include <complex>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace damslip::fe2d {

/// (K + sC + s²M) x = b, s = σ + iω, of one body at several frequencies: complex symmetric L Lᵀ (no conjugates) by fronts,
/// ordered once for all frequencies (CHOLMOD), without pivoting. What that costs in digits is checked by every solution's
/// residual and mended by iterative refinement. A third of the time of an unsymmetric LU with pivoting (UMFPACK).
/// BLAS runs on one thread.
class FrequencySolver {
public:
    using Matrix = Eigen::SparseMatrix<double>;

    struct At {
        double frequency;    ///< ω [rad/s]
        double growth = 0.0; ///< σ >= 0 of loads that grow with e^{σt} [1/s]
    };

    /// @param mass, damping, stiffness  symmetric, of one size, stored whole
    /// @param body  subject of messages
    /// @throws std::bad_alloc
    FrequencySolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness, std::string body);
    ~FrequencySolver();
    FrequencySolver(const FrequencySolver&) = delete;
    FrequencySolver& operator=(const FrequencySolver&) = delete;

    /// Solutions for the same loads at several frequencies, on several threads (use_threads()).
    /// @param loads  real ones, one column each
    /// @param take  gets the number of a frequency and its solutions, of several frequencies at a time
    /// @param beside  other work for these threads
    /// @throws std::runtime_error  where a pivot is zero or ‖D x - b‖ > 1e-8 ‖b‖
    void solve(std::span<const At> frequencies, const Eigen::MatrixXd& loads,
               const std::function<void(std::size_t, const Eigen::MatrixXcd&)>& take,
               const std::function<void()>& beside = {}) const;
    Eigen::MatrixXcd solve(At frequency, const Eigen::MatrixXd& loads) const;

private:
    struct Implementation;
    std::unique_ptr<const Implementation> implementation_;
};

} // namespace damslip::fe2d
