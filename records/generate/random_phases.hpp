#pragma once

#include "records/generate/target_spectrum.hpp"

#include <cstdint>
#include <span>
#include <vector>

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

} // namespace damslip::records
