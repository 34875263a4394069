#pragma once

#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/time/condensation.hpp"

#include <Eigen/SparseCore>

#include <complex>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

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

/// Steady answer to a horizontal ground acceleration of 1 m/s², positive downstream, on a tied base.
struct TransferPoint {
    double frequency = 0.0;     ///< [Hz]
    std::complex<double> crest; ///< absolute acceleration of the crest's upstream end in x, per ground acceleration [-]
    std::complex<double>
        deflection; ///< what of `crest` the dam's own deformation makes, beyond the ground's motion and
                    ///< the rigid one of the base [-]; on a rigid base crest - 1
    std::complex<double>
        water_force;     ///< on the dam in x, beyond the static one [N/m per m/s²]; 0 without acoustic water
    bool regular = true; ///< false: an undamped resonance, no value
};

/// Radiating rock below the dam: its dynamic stiffness, the inverse of ReducedRock::response(), stands on the unknowns of
/// the base.
struct RockBelow {
    const ReducedRock& rock; ///< rows as unknowns_of_base(), then those of the water's floor where it is the rock's
    double stiffness_damping = 0.0; ///< b_K [s]
};

/// @param structure    of the model: structure_system(), or dam_on_free_base() where `rock` is below it
/// @param water        acoustic water, or null; the model then has no added mass
/// @param frequencies  > 0 [Hz]
/// @param rock         radiating rock, or null: what the structure stands on is part of it
std::vector<TransferPoint> transfer_functions(const Model& model, const LinearSystem& structure,
                                              const FluidModel* water, const std::vector<double>& frequencies,
                                              const RockBelow* rock = nullptr);

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
