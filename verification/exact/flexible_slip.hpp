#pragma once

#include <functional>
#include <span>

/// A block on a level base with one mode: x'' + 2 zeta omega x' + omega^2 x = a - s'', s'' = a - Gamma x'' - a_y.
namespace damslip::exact {

struct FlexibleSlipCase {
    double omega = 0.0;      ///< [rad/s]
    double damping = 0.0;    ///< zeta [-]
    double mass_ratio = 0.0; ///< Gamma [-]
    double yield = 0.0;      ///< a_y in both directions [m/s^2]
};

/// Slip at the time t under a = A from t = 0 on, undamped, (1 - Gamma) A > a_y. It slides from the first instant: then
/// (1 - Gamma) x'' + omega^2 x = a_y, so x = a_y/omega^2 (1 - cos(omega t/sqrt(1 - Gamma))), and s'' integrated twice is
/// s = (A - a_y) t^2/2 - Gamma x.
double slip_under_step(const FlexibleSlipCase& c, double A, double t);

/// Slip by time stepping with impulses: both rates take the forces of a step h, then friction takes the impulse that
/// stops the slip, at most a_y h (Moreau 1999). Of first order in h; knows nothing of events or modes in closed form.
double slip_by_impulses(const FlexibleSlipCase& c, const std::function<double(double)>& accel, double duration,
                        double h);

/// Slip one way under the acceleration k = a - Gamma x'' of a base that does not slide: x by Runge-Kutta of fourth order,
/// between its steps k as a cubic by its values and rates at both, and the slip by that cubic; starts and stops by
/// bisection. Steps of 1/(fineness omega) at most, four to a sample at least, `quiet` [s] beyond the record's end: k is
/// wrong by 1/(384 fineness^4) of itself.
/// @param accel  samples `dt` apart, linear between them [m/s^2]; > 0 drives the slip
double slip_decoupled_by_steps(const FlexibleSlipCase& c, std::span<const double> accel, double dt, double quiet,
                               double fineness = 32.0);

} // namespace damslip::exact
