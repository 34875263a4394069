#pragma once

#include <Eigen/SparseCore>

#include <complex>
#include <memory>

namespace damslip::fe2d {

/// Answers in the steady state: everything varies as Re(z e^{iωt}),
///
///     (-ω² M + iω G + K) z = f(ω)
///
/// with real sparse M, G, K of one size. Any of them may be indefinite or singular; L U with pivoting (UMFPACK), one factorisation per
/// frequency, the ordering kept.
class HarmonicSolver {
public:
    using Matrix = Eigen::SparseMatrix<double>;

    HarmonicSolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness);
    ~HarmonicSolver();
    HarmonicSolver(HarmonicSolver&&) noexcept;

    /// @param frequency  ω [rad/s]
    /// @returns false where the matrix is singular to working accuracy: an undamped resonance. Nothing may be solved then.
    bool factorise(double frequency);
    Eigen::VectorXcd solve(const Eigen::VectorXcd& right_hand_side) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace damslip::fe2d
