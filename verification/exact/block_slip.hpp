#pragma once

#include <span>

/// Closed solutions of the sliding block: s'' = a(t) - a_y while it slides, starting at rest. SI units; each derivation
/// is in the .cpp file.
namespace damslip::exact {

/// Ground acceleration A for the time t0, then none: D = A (A - a_y) t0^2 / (2 a_y). Newmark (1965).
double slip_under_rectangle(double A, double t0, double a_y);

/// Ground acceleration rising linearly from 0 to A in t1 and falling to 0 in t1, then none.
double slip_under_triangle(double A, double t1, double a_y);

/// The same triangle on a block that starts at the yield a_start and slides on with a_y <= a_start from then on
/// (cohesion lost at first slip).
double slip_under_triangle_after_start(double A, double t1, double a_start, double a_y);

/// Ground acceleration A (1 - t/t_d), A/2 <= a_y < A: D = (2/3) t_d^2 (A - a_y)^3 / A^2, at rest from t = 2 t_d (A -
/// a_y)/A on.
double slip_under_decaying_ramp(double A, double t_d, double a_y);

/// Ground acceleration A sin(omega t) for half a period, then none.
double slip_under_half_sine(double A, double omega, double a_y);

/// One cycle of a long train A sin(omega t), one-way; a_y/A >= 0.4, so that the block stops within the cycle.
double slip_per_sine_cycle(double A, double omega, double a_y);

/// Ground acceleration A for t0, then none; yield a_1 until the slip s_r, a_2 from there on.
double slip_with_residual(double A, double t0, double a_1, double a_2, double s_r);

/// Steady ground acceleration A on friction that grows with slip, a_y(s) = a_0 + omega^2 s: the block stops at s = 2 (A
/// - a_0)/omega^2.
double slip_with_hardening(double A, double a_0, double omega);

/// Ground acceleration A for t0, then none; a_y(s) = a_0 - kappa s up to the slip s_r, constant a_0 - kappa s_r beyond
/// it.
double slip_with_softening(double A, double t0, double a_0, double kappa, double s_r);

/// Ground acceleration linear between samples, zero after the last one, unequal yields, upstream sliding where up is
/// finite; integrated in extended precision with bisection for every event: slow, independent of the program. @returns
/// slip, positive downstream
double slip_of_interpolant(std::span<const double> accel, double dt, double yield_down, double yield_up);

/// Ground accelerations A upstream and a_v = -q t up for the time T, then none; block of mass 1, friction mu, gravity
/// g, horizontal base, no lift-off.
double slip_under_falling_vertical(double A, double q, double T, double mu, double g);

/// The same with q T > g: the base opens at t = g/q and stays open to T; without flight, zero resistance while open.
double slip_with_lift_off(double A, double q, double T, double mu, double g);

/// Steady A upstream and a_v = -q < -g for the time T, then none, ballistic: the block flies from t = 0 on, lands
/// plastically and coasts. `mass` and `added_mass` (horizontal) [kg/m].
double slip_with_landing(double A, double q, double T, double mu, double g, double mass, double added_mass);

/// s'' = A - (mu + slope s)(g + a_v0 + q t) from rest at t = 0 to its first stop, by classical Runge-Kutta steps in
/// extended precision (no closed form exists); the error, of order step^4, is what remains at `steps` per second.
double slip_with_sloped_friction(double A, double mu, double slope, double g, double a_v0, double q, int steps);

} // namespace damslip::exact
