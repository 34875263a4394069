#pragma once

#include <span>
#include <vector>

namespace damslip::records {

/// Peak response of one oscillator (absolute values).
struct SpectrumPoint {
    double period = 0.0;                ///< T [s]; 0: rigid
    double displacement = 0.0;          ///< S_d, relative to the ground [m]
    double velocity = 0.0;              ///< S_v, relative to the ground [m/s]
    double pseudo_acceleration = 0.0;   ///< PSA = w^2 S_d [m/s^2]
    double absolute_acceleration = 0.0; ///< S_a = max |u'' + a_g| [m/s^2]; equals PSA without damping
};

struct ResponseSpectrum {
    double ratio = 0.05; ///< damping ratio zeta [-]
    std::vector<SpectrumPoint> points;
};

/// Elastic response spectrum of acceleration linear between samples, by the exact recursion of Nigam & Jennings (1969).
///
/// Peaks between samples are not missed: each interval is divided into equal steps of at most T/16, with damping shorter yet (the recursion stays
/// exact), and where the rate of a response changes its sign inside a step, the extreme of the cubic through values and
/// rates at both ends counts. The error of a peak is then below (w h)^4/384 = 6e-5 of it. Of intervals much longer than T only
/// the parts where a largest value can be are divided. The oscillator starts from
/// rest; a first sample other than zero is a jump of the ground acceleration. It is followed for one period T after the
/// record's end (free vibration).
///
/// @param accel    [m/s^2]   @param dt  [s], > 0
/// @param periods  T [s], >= 0. T < dt/1000 counts as rigid: S_d = S_v = 0, accelerations = PGA (error below 0.1 %)
/// @param ratio    zeta [-], 0 <= zeta <= 10
ResponseSpectrum response_spectrum(std::span<const double> accel, double dt, std::span<const double> periods,
                                   double ratio);

/// S_a of one oscillator, as response_spectrum computes it; what the modified Rayleigh damping weighs modes with
/// (Spears & Jensen 2012; Goldgruber (2015), eq. (2-58)).
/// @param frequency_hz  f [Hz], > 0   @param ratio  zeta [-], 0 <= zeta <= 10   @returns [m/s^2]
double peak_absolute_acceleration(std::span<const double> accel, double dt, double frequency_hz, double ratio);

/// `count` periods from `shortest` to `longest` [s], both included, equally spaced on a logarithmic scale.
std::vector<double> logarithmic_periods(double shortest, double longest, int count);

} // namespace damslip::records
