#pragma once

#include <Eigen/SparseCore>

#include <complex>
#include <memory>
#include <span>

namespace damslip::fe2d {

/// Answers in the steady state: everything varies as Re(z e^{iωt}),
///
///     (-ω² M + iω G + K) z = f(ω)
///
/// with real sparse M, G, K of one size. Any of them may be indefinite or singular; L U with pivoting (UMFPACK), one factorisation per
/// frequency, the ordering kept. Some unknowns may have a dense block of their own on top, another at each frequency.
class HarmonicSolver {
public:
    using Matrix = Eigen::SparseMatrix<double>;

    /// @param block_at  unknowns of the dense block, each once; none: no block
    HarmonicSolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness,
                   std::span<const Eigen::Index> block_at = {});
    ~HarmonicSolver();
    HarmonicSolver(HarmonicSolver&&) noexcept;

    /// @param frequency  ω [rad/s]
    /// @param block  at the unknowns of the dense block
    /// @returns false where the matrix is singular to working accuracy: an undamped resonance. Nothing may be solved then.
    bool factorise(double frequency, const Eigen::MatrixXcd& block = {});
    Eigen::VectorXcd solve(const Eigen::VectorXcd& right_hand_side) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace damslip::fe2d
