#pragma once

#include <optional>
#include <span>

namespace damslip::records {

/// Mean period of the Fourier amplitude spectrum, Rathje, Abrahamson & Bray (1998); Rathje, Faraj, Russell & Bray
/// (2004):
///
///     T_m = sum C_i^2 / f_i  /  sum C_i^2,   0.25 Hz <= f_i <= 20 Hz
///
/// The record is padded with zeros to a power of two of samples and to at least 20 s, so that the frequency step is at
/// most 0.05 Hz as the 2004 paper asks. Above the Nyquist frequency there is nothing to sum: dt > 0.025 s cuts the
/// band.
/// @param accel  [m/s^2]   @param dt  [s], > 0
/// @returns [s]; nothing where the band holds no amplitude (a record of zeros, dt > 2 s).
std::optional<double> mean_period(std::span<const double> accel, double dt);

} // namespace damslip::records
