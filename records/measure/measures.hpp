#pragma once

#include "records/record.hpp"

#include <optional>
#include <span>
#include <vector>

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

/// Relative motion of a linear oscillator on moving ground: u'' + 2 zeta w u' + w^2 u = -a_g(t).
struct OscillatorState {
    double displacement = 0.0; ///< u, relative to the ground [m]
    double velocity = 0.0;     ///< u' [m/s]
};

/// The exact step of the oscillator under ground acceleration that is linear over the step, Nigam & Jennings (1969):
///
///     (u, u')_1 = A (u, u')_0 + B (a_0, a_1)
///
/// The matrices exp(L h), phi_1, phi_2 are summed as power series of L h, L = [0 1; -w^2 -2 zeta w]: no cancellation
/// for long periods (the closed forms lose (w h)^-3 digits), and the same expression for no, sub- and over-critical
/// damping. Limits: w = 0 gives the free mass u'' = -a_g exactly.
class OscillatorStep {
public:
    /// @param circular_frequency  w [rad/s], >= 0   @param ratio  zeta [-], >= 0
    /// @param step  h [s], > 0, with w h (1 + 2 zeta) <= 2 so that the series converges to round-off (asserted)
    OscillatorStep(double circular_frequency, double ratio, double step);

    /// `count` such steps as one, under ground acceleration that is linear over them all.
    /// @param count  >= 1
    OscillatorStep repeated(int count) const;

    /// @param a0, a1  ground acceleration at the start and the end of the step [m/s^2]
    OscillatorState advance(const OscillatorState& s, double a0, double a1) const
    {
        return {a_[0] * s.displacement + a_[1] * s.velocity + b_[0] * a0 + b_[1] * a1,
                a_[2] * s.displacement + a_[3] * s.velocity + b_[2] * a0 + b_[3] * a1};
    }

private:
    OscillatorStep() = default;
    /// `first` over p parts of the time, `second` over q more.
    static OscillatorStep in_turn(const OscillatorStep& first, int p, const OscillatorStep& second, int q);

    double a_[4]; ///< rows (u, u')
    double b_[4]; ///< rows (u, u'), columns (a_0, a_1)
};

} // namespace damslip::records
