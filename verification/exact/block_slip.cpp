#include "verification/exact/block_slip.hpp"

#include <cmath>
#include <numbers>

namespace damslip::exact {
namespace {

/// Coasting to rest on a base with the yield a_y: v^2 / (2 a_y).
double coasting(double v, double a_y)
{
    return v * v / (2.0 * a_y);
}

/// Root of a function that is positive at lo and negative at hi, by bisection in extended precision.
template <typename Function>
long double bisect(Function&& f, long double lo, long double hi)
{
    for (int k = 0; k < 200; ++k) {
        const long double mid = 0.5L * (lo + hi);
        (f(mid) > 0.0L ? lo : hi) = mid;
    }
    return 0.5L * (lo + hi);
}

} // namespace

// v = (A - a_y) t0 after s_1 = (A - a_y) t0^2/2, then coasting: D = s_1 + v^2/(2 a_y) = A (A - a_y) t0^2/(2 a_y).
double slip_under_rectangle(double A, double t0, double a_y)
{
    return A * (A - a_y) * t0 * t0 / (2.0 * a_y);
}

double slip_under_triangle(double A, double t1, double a_y)
{
    return slip_under_triangle_after_start(A, t1, a_y, a_y);
}

// Slope p = A/t1. Sliding starts at a = a_start with the excess e_0 = a_start - a_y and gains over T = (A - a_start)/p:
//   v_1 = e_0 T + p T^2/2,  s_1 = e_0 T^2/2 + p T^3/6.
// From the peak with the excess e = A - a_y: v = v_1 + e t - p t^2/2, zero at t_2 = (e + sqrt(e^2 + 2 p v_1))/p. If t_2
// <= t1 the block stops on the way down; else it coasts from t = t1 on. For a_start = a_y: D = (e^3/p^2)(1 + 2
// sqrt(2)/3) as long as a_y >= A (2 - sqrt 2).
double slip_under_triangle_after_start(double A, double t1, double a_start, double a_y)
{
    if (a_start >= A) return 0.0;
    const double p = A / t1, T = (A - a_start) / p, e_0 = a_start - a_y, e = A - a_y;
    const double v_1 = e_0 * T + p * T * T / 2.0;
    const double s_1 = e_0 * T * T / 2.0 + p * T * T * T / 6.0;
    const double t_2 = std::fmin(t1, (e + std::sqrt(e * e + 2.0 * p * v_1)) / p);
    const double v_2 = v_1 + e * t_2 - p * t_2 * t_2 / 2.0;
    const double s_2 = v_1 * t_2 + e * t_2 * t_2 / 2.0 - p * t_2 * t_2 * t_2 / 6.0;
    return s_1 + s_2 + (t_2 < t1 ? 0.0 : coasting(v_2, a_y));
}

// s'' = (A - a_y) - (A/t_d) t: v = (A - a_y) t - A t^2/(2 t_d) is zero at t = 2 t_d (A - a_y)/A <= t_d, where s is the
// D given.
double slip_under_decaying_ramp(double A, double t_d, double a_y)
{
    const double e = A - a_y;
    return 2.0 / 3.0 * t_d * t_d * e * e * e / (A * A);
}

// From t_1 = asin(a_y/A)/omega: v = (A/omega)(cos omega t_1 - cos omega t) - a_y (t - t_1),
// s = (A/omega)(t - t_1) cos omega t_1 - (A/omega^2)(sin omega t - sin omega t_1) - a_y (t - t_1)^2/2.
// The stop solves v = 0, by bisection past the second crossing of a_y; if v > 0 at pi/omega the block coasts.
double slip_under_half_sine(double A, double omega, double a_y)
{
    const long double w = omega, r = static_cast<long double>(a_y) / A, t_1 = std::asin(r) / w,
                      end = std::numbers::pi_v<long double> / w;
    const auto v = [&](long double t) { return A / w * (std::cos(w * t_1) - std::cos(w * t)) - a_y * (t - t_1); };
    const auto s = [&](long double t) {
        return A / w * (t - t_1) * std::cos(w * t_1) - A / (w * w) * (std::sin(w * t) - r) -
               a_y * (t - t_1) * (t - t_1) / 2.0L;
    };
    if (v(end) > 0.0L) return static_cast<double>(s(end) + v(end) * v(end) / (2.0L * a_y));
    return static_cast<double>(s(bisect(v, end - t_1, end)));
}

double slip_per_sine_cycle(double A, double omega, double a_y)
{
    const long double w = omega, r = static_cast<long double>(a_y) / A, t_1 = std::asin(r) / w;
    const long double cycle = 2.0L * std::numbers::pi_v<long double> / w;
    const auto v = [&](long double t) { return A / w * (std::cos(w * t_1) - std::cos(w * t)) - a_y * (t - t_1); };
    const long double t = bisect(v, cycle / 2.0L - t_1, cycle + t_1);
    return static_cast<double>(A / w * (t - t_1) * std::cos(w * t_1) - A / (w * w) * (std::sin(w * t) - r) -
                               a_y * (t - t_1) * (t - t_1) / 2.0L);
}

// To s_r with e_1 = A - a_1: t_r = sqrt(2 s_r/e_1), v_r = e_1 t_r; then e_2 = A - a_2 for the rest of t0, then coasting
// with a_2.
double slip_with_residual(double A, double t0, double a_1, double a_2, double s_r)
{
    const double e_1 = A - a_1, e_2 = A - a_2, t_r = std::sqrt(2.0 * s_r / e_1), rest = t0 - t_r;
    const double v_r = e_1 * t_r, v_0 = v_r + e_2 * rest;
    return s_r + v_r * rest + e_2 * rest * rest / 2.0 + coasting(v_0, a_2);
}

// s'' = (A - a_0) - omega^2 s from rest: s = (A - a_0)/omega^2 (1 - cos omega t), at rest at t = pi/omega. There a_y =
// 2 A - a_0 > A: it stays.
double slip_with_hardening(double A, double a_0, double omega)
{
    return 2.0 * (A - a_0) / (omega * omega);
}

// s'' = e + kappa s from rest, e = A - a_0: s = (e/kappa)(cosh(sqrt(kappa) t) - 1). It reaches s_r at t_r = acosh(1 +
// kappa s_r/e)/sqrt(kappa) with v_r^2 = s_r (2 e + kappa s_r); from there the excess is constant, e + kappa s_r.
double slip_with_softening(double A, double t0, double a_0, double kappa, double s_r)
{
    const double e = A - a_0, a_r = a_0 - kappa * s_r;
    const double t_r = std::acosh(1.0 + kappa * s_r / e) / std::sqrt(kappa), rest = t0 - t_r;
    const double v_r = std::sqrt(s_r * (2.0 * e + kappa * s_r)), v_0 = v_r + (A - a_r) * rest;
    return s_r + v_r * rest + (A - a_r) * rest * rest / 2.0 + coasting(v_0, a_r);
}

// a_y = mu (g - q t) falls to A at t_0 = (g - A/mu)/q; from there s'' = mu q (t - t_0): v = mu q tau^2/2, s = mu q
// tau^3/6 at tau = T - t_0.
double slip_under_falling_vertical(double A, double q, double T, double mu, double g)
{
    const double tau = T - (g - A / mu) / q;
    return mu * q * tau * tau * tau / 6.0 + coasting(mu * q * tau * tau / 2.0, mu * g);
}

// To the opening as above with tau = (A/mu)/q, s'' = A there; then s'' = A for the rest, then coasting.
double slip_with_lift_off(double A, double q, double T, double mu, double g)
{
    const double tau = A / mu / q, v = mu * q * tau * tau / 2.0, rest = T - g / q, v_end = v + A * rest;
    return mu * q * tau * tau * tau / 6.0 + v * rest + A * rest * rest / 2.0 + coasting(v_end, mu * g);
}

// Gap: y'' = q - g up to T, then -g: falls back to zero at t_f after T with the speed w, w^2 = y_T'^2 + 2 g y_T. Along
// the base s'' = A up to T, then none in flight; landing takes off mu m w/(m + M_w) (at most all) of the rate, after
// which s'' = -mu m g/(m + M_w).
double slip_with_landing(double A, double q, double T, double mu, double g, double mass, double added_mass)
{
    const double y = (q - g) * T * T / 2.0, y_rate = (q - g) * T, w = std::sqrt(y_rate * y_rate + 2.0 * g * y);
    const double share = mass / (mass + added_mass), v = A * T, flight = (y_rate + w) / g;
    const double after = std::fmax(0.0, v - mu * share * w);
    return A * T * T / 2.0 + v * flight + coasting(after, mu * share * g);
}

double slip_with_sloped_friction(double A, double mu, double slope, double g, double a_v0, double q, int steps)
{
    using Real = long double;
    const auto accel = [&](Real t, Real s) { return A - (mu + slope * s) * (g + a_v0 + q * t); };
    const auto advance = [&](Real t, Real& s, Real& v, Real h) {
        const Real k1 = accel(t, s), s2 = s + h / 2 * v, v2 = v + h / 2 * k1, k2 = accel(t + h / 2, s2);
        const Real s3 = s + h / 2 * v2, v3 = v + h / 2 * k2, k3 = accel(t + h / 2, s3);
        const Real s4 = s + h * v3, v4 = v + h * k3, k4 = accel(t + h, s4);
        s += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    };
    Real s = 0, v = 0;
    const Real h = 1.0L / steps;
    for (int k = 0;; ++k) {
        const Real t = k * h;
        Real s_next = s, v_next = v;
        advance(t, s_next, v_next, h);
        if (v_next > 0) {
            s = s_next;
            v = v_next;
            continue;
        }
        const auto rate_after = [&](Real x) {
            Real s_x = s, v_x = v;
            advance(t, s_x, v_x, x);
            return v_x;
        };
        const Real x = bisect(rate_after, 0, h);
        advance(t, s, v, x);
        return static_cast<double>(s);
    }
}

double slip_of_interpolant(std::span<const double> accel, double dt, double yield_down, double yield_up)
{
    // Every interval is cut at the times where a crosses either yield, so that the relative acceleration keeps one sign
    // in a piece and the rate is monotone there; within a piece a stop is found by bisection.
    using Real = long double;
    const Real h = dt, down = yield_down, up = yield_up;
    Real s = 0, v = 0;
    for (std::size_t k = 0; k < accel.size(); ++k) {
        const bool after = k + 1 == accel.size(); // coasting: one long interval of zero ground acceleration
        const Real a0 = after ? 0.0L : accel[k], a1 = after ? 0.0L : accel[k + 1], length = after ? 1e4L : h;
        const auto ground = [&](Real t) { return a0 + (a1 - a0) * (t / length); };
        Real cuts[4] = {0, length, length, length};
        int n = 1;
        for (const Real level : {down, -up})
            if ((a0 < level && a1 > level) || (a0 > level && a1 < level))
                cuts[n++] = length * ((level - a0) / (a1 - a0));
        if (n == 3 && cuts[1] > cuts[2]) {
            const Real swap = cuts[1];
            cuts[1] = cuts[2];
            cuts[2] = swap;
        }
        cuts[n] = length;
        for (int piece = 0; piece < n; ++piece) {
            Real t = cuts[piece];
            const Real end = cuts[piece + 1];
            while (t < end) {
                const Real middle = ground(0.5L * (t + end));
                Real level;
                if (v > 0 || (v == 0 && middle > down))
                    level = down;
                else if (v < 0 || (v == 0 && middle < -up))
                    level = -up;
                else
                    break; // at rest to the end of the piece
                const Real e0 = ground(t) - level, e1 = ground(end) - level, d = end - t;
                const auto rate = [&](Real x) { return v + e0 * x + (e1 - e0) * x * x / (2 * d); };
                const auto path = [&](Real x) { return v * x + e0 * x * x / 2 + (e1 - e0) * x * x * x / (6 * d); };
                const bool forward = level == down;
                const bool stops = v != 0 && (forward ? rate(d) < 0 : rate(d) > 0);
                const Real x = stops ? bisect([&](Real y) { return forward ? rate(y) : -rate(y); }, 0, d) : d;
                s += path(x);
                v = stops ? 0 : rate(x);
                if (!stops) break;
                t += x;
            }
        }
    }
    return static_cast<double>(s);
}

} // namespace damslip::exact
