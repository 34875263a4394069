#pragma once

#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/rock/wave_box.hpp"

namespace damslip::fe2d {

struct ReductionOptions {
    double wanted = 0.02; ///< gate: largest error of the interface's flexibility in between the sampled frequencies [-]
    double kept = 0.01;   ///< what the basis may leave of a snapshot, of the flexibility it stands for [-]
    double sampling = 0.8;  ///< sampled frequencies over what the box's answer lasts [-]
    int checks = 5;         ///< frequencies of the gate
    int largest_rounds = 6; ///< of adding snapshots where the gate is failed

    friend bool operator==(const ReductionOptions&, const ReductionOptions&) = default;
};

/// Reduces a box of rock to its interface (ReducedRock).
///
/// Basis: K⁻¹R and real and imaginary part of D(iω_k)⁻¹R, D = K + iωC - ω²M, and of D(σ + iω)⁻¹R at two places beyond the
/// highest frequency, R loads in the form of Legendre polynomials
/// along the interface in both directions, degree < max(3, 1 + ⌈¾ ω_max length/c_s⌉). ω_k lie as densely as the box's answer to a blow
/// is long: 2 D_e(ω)/c_s, D_e the depth where the sponge has taken all but 1/e of a wave. Proper orthogonal decomposition in the norm
/// K + (ω_max/2)² M, each snapshot divided by the root of the flexibility |RᵀD⁻¹R| of its own load: a snapshot's error
/// enters the flexibility squared in that norm, so what is left of a column is the relative error made there. (Columns of
/// norm 1 weigh what happens far away in the sponge: ten times the error at equal N.)
///
/// Everything is a congruence with real vectors: passive whatever is cut. Checked by the box itself for two loads,
/// pseudo-random and always the same, at frequencies in between; where it fails the worst frequency's snapshots go in and a
/// finer cut is made.
///
/// Where the first nodes are the water's floor (WaveBoxInput::floor) there are two groups of loads, tractions on the base and pressures
/// on the floor, polynomials of the same kind over either length; rows of the floor are ReducedRock::floor; the check has two more
/// loads, pseudo-random pressures on the floor alone.
ReducedRock reduce_rock(const WaveBoxInput& input, const WaveBox& box, const ReductionOptions& options = {});

/// Vᵀ A V of a symmetric A, symmetric to the bit: its upper triangle by blocks of columns, on several threads.
Eigen::MatrixXd projected(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixXd& v);

/// Proper orthogonal decomposition: columns that make the leading directions of snapshots orthonormal.
/// @param gram  of the snapshots @param kept  what may be left of one's square [-]
Eigen::MatrixXd leading_directions(const Eigen::MatrixXd& gram, double kept);

/// Frequencies ω_k > 0, ascending, the last one the highest [rad/s].
std::vector<double> sampled_frequencies(const WaveBoxInput& input, double sampling);

} // namespace damslip::fe2d
