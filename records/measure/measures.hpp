#pragma once

#include "records/record.hpp"

#include <optional>
#include <span>

namespace damslip::records {

/// What the regressions and reports need to know of one accelerogram. All but the mean period are exact for
/// acceleration that is linear between samples, starting from rest; the record is measured as it is, without baseline
/// correction.
struct Measures {
    double duration = 0.0;             ///< of the record [s]
    double pga = 0.0;                  ///< max |a| [m/s^2]
    double pga_time = 0.0;             ///< of the first such sample [s]
    double pgv = 0.0;                  ///< max |v| [m/s]
    double pgd = 0.0;                  ///< max |u| [m]; of an uncorrected record mostly drift
    double final_velocity = 0.0;       ///< [m/s]; not zero: the record wants a baseline correction
    double final_displacement = 0.0;   ///< [m]
    double arias_intensity = 0.0;      ///< I_A [m/s]
    double cumulative_velocity = 0.0;  ///< CAV, cumulative absolute velocity [m/s]
    double duration_5_75 = 0.0;        ///< D5-75 [s]
    double duration_5_95 = 0.0;        ///< D5-95 [s]
    std::optional<double> mean_period; ///< T_m [s]; none for a record of zeros or without content in 0.25 to 20 Hz
};

/// @param record  at least 2 samples, dt > 0, all finite (as every reader leaves it).
Measures measure(const Record& record);

/// Largest absolute values of the ground motion that starts from rest, and where it ends.
struct Peaks {
    double acceleration = 0.0;       ///< [m/s^2]
    double acceleration_time = 0.0;  ///< of the first sample that reaches it [s]
    double velocity = 0.0;           ///< [m/s]
    double displacement = 0.0;       ///< [m]
    double final_velocity = 0.0;     ///< [m/s], with its sign
    double final_displacement = 0.0; ///< [m], with its sign
};

/// Exact for acceleration linear between samples: velocity is quadratic and displacement cubic there, and their
/// extremes inside an interval (zeros of the acceleration and of the velocity) count.
/// @param accel  [m/s^2]   @param dt  [s], > 0
Peaks motion_peaks(std::span<const double> accel, double dt);

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

/// Frequency below which a share of the energy of an accelerogram lies, the integral of |A(f)|^2 from 0 to f over that from
/// 0 to 50 Hz or the Nyquist frequency [Hz]; trapezoid in steps of 0.1 Hz. Zero for a record of zeros.
/// @param accel  [any unit]   @param dt  [s], > 0   @param share  0 ... 1 [-]
double frequency_below(std::span<const double> accel, double dt, double share);

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
