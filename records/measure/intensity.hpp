#pragma once

#include <span>

namespace damslip::records {

/// Arias intensity of acceleration linear between samples, exactly:
///
///     I_A = pi/(2 g) * integral of a^2 dt,   per interval  (a0^2 + a0 a1 + a1^2) dt/3
///
/// Arias (1970); Goldgruber (2015), eq. (4-8); g = 9.80665 m/s^2, the unit, not the site's gravity.
/// @param accel  [m/s^2]   @param dt  [s], > 0   @returns I_A [m/s]
double arias_intensity(std::span<const double> accel, double dt);

/// Cumulative absolute velocity, integral of |a| dt, exactly: an interval in which a changes sign counts its two
/// triangles. Electric Power Research Institute (1988), without the threshold of the later "standardised" CAV.
/// @returns CAV [m/s]
double cumulative_absolute_velocity(std::span<const double> accel, double dt);

/// Time between the instants at which `from` and `to` of the integral of a^2 have arrived (Trifunac & Brady 1975), both
/// found inside their interval: the running integral is a cubic of time there.
/// @param from, to  0 <= from < to <= 1   @returns [s]; 0 for a record of zeros
double significant_duration(std::span<const double> accel, double dt, double from, double to);

} // namespace damslip::records
