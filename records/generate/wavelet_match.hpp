#pragma once

#include "records/generate/target_spectrum.hpp"

#include <span>
#include <vector>

namespace damslip::records {

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
