#pragma once

#include <span>

namespace damslip::records {

/// Frequency below which a share of the energy of an accelerogram lies, the integral of |A(f)|^2 from 0 to f over that from
/// 0 to 50 Hz or the Nyquist frequency [Hz]; trapezoid in steps of 0.1 Hz. Zero for a record of zeros.
/// @param accel  [any unit]   @param dt  [s], > 0   @param share  0 ... 1 [-]
double frequency_below(std::span<const double> accel, double dt, double share);

} // namespace damslip::records
