#pragma once

#include "records/generate/target_spectrum.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// The two stages of generate().
namespace damslip::records {

/// What the first stage makes its record from.
struct RandomPhaseOptions {
    double dt = 0.01; ///< [s]
    double pga = 1.0; ///< [m/s^2]
    std::uint64_t seed = 1;
    std::uint64_t stream = 0; ///< component: independent phases of one seed
    int iterations = 12;
};

/// Sum of sines with random phases under an envelope, in the manner of SIMQKE (Gasparini & Vanmarcke 1976): amplitudes
/// start from the power spectrum that belongs to the target spectrum, and are multiplied by target over computed
/// spectrum at their period. Lines from 0.15 Hz to 0.8 of the Nyquist frequency (at most 40 Hz). The result follows the
/// target within some 10 to 20 %.
/// @param envelope  one value per sample   @returns acceleration [m/s^2], as long as the envelope
std::vector<double> random_phase_record(const TargetSpectrum& target, std::span<const double> envelope,
                                        const RandomPhaseOptions& options);

/// One pass of spectral matching in the time domain: Lilhanand & Tseng (1988) with the tapered cosine wavelets of Al
/// Atik & Abrahamson (2010). For each period wavelets are placed so that their oscillator answers them at the times of
/// its own positive and negative peak; the amplitudes that bring the larger peaks 70 % of their way to the target
/// together, while those of the other sign stay, solve a linear system (regularised least squares). PGA is one more
/// equation. Peaks that were lower before may surface, so the caller repeats passes and drops those that did harm.
/// @param accel  [m/s^2], changed in place; both ends keep their values
/// @param pga    [m/s^2]   @param periods  T [s] to match, rising
/// @param regularisation  [-], > 0; small: bold steps (1e-5), large: small ones (1)
void match_by_wavelets(std::vector<double>& accel, double dt, const TargetSpectrum& target, double pga,
                       std::span<const double> periods, double regularisation);

} // namespace damslip::records
