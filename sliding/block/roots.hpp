#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "sliding/block/line.hpp"

namespace damslip::sliding {

/// First time h >= 0 at which v0 + a0 h + j h^2/2, positive just after h = 0, falls back to zero; `never` without one.
/// v0 >= 0. Both roots come from the one sum that does not cancel.
inline double time_of_stop(double v0, double a0, double j)
{
    if (v0 == 0.0 && a0 == 0.0) return j > 0.0 ? never : 0.0;
    const double discriminant = a0 * a0 - 2.0 * j * v0;
    if (discriminant < 0.0) return never;
    const double root = std::sqrt(discriminant);
    if (a0 <= 0.0) return v0 == 0.0 ? 0.0 : 2.0 * v0 / (root - a0);
    return j < 0.0 ? (a0 + root) / -j : never;
}

/// Root of `function` between lo and hi, where it has opposite signs (or is zero at one of them): secant steps kept
/// inside a shrinking bracket by bisection, until the bracket is a few units in the last place wide. The sign change is
/// what counts; no derivative is needed.
template <typename Function>
double bracketed_root(Function&& function, double lo, double hi)
{
    double f_lo = function(lo);
    double f_hi = function(hi);
    if (f_lo == 0.0) return lo;
    if (f_hi == 0.0) return hi;
    for (int k = 0; k < 200; ++k) {
        const double width = hi - lo;
        if (!(width > 4e-16 * std::max(std::abs(lo), std::abs(hi)))) break;
        double x = lo - f_lo * (width / (f_hi - f_lo));
        // Every third step halves the bracket, so that one end cannot stay for ever; the others keep off the ends.
        if (k % 3 == 2 || !(x > lo && x < hi)) x = lo + 0.5 * width;
        if (!(x > lo && x < hi)) break;
        const double f = function(x);
        if (f == 0.0) return x;
        if ((f < 0.0) == (f_lo < 0.0)) {
            lo = x;
            f_lo = f;
        } else {
            hi = x;
            f_hi = f;
        }
    }
    return std::abs(f_lo) < std::abs(f_hi) ? lo : hi;
}

/// Value of c[0] + c[1] x + c[2] x^2 + ...
inline double polynomial(std::span<const double> c, double x)
{
    double sum = 0.0;
    for (std::size_t i = c.size(); i-- > 0;) sum = sum * x + c[i];
    return sum;
}

/// First x in (0, span] at which the polynomial, positive just after x = 0, falls to zero or below; `never` without
/// one. Certain: the interval is cut at the zeros of the derivative, found in the same way; the recursion ends where
/// one coefficient outweighs the rest.
double first_fall_to_zero(std::span<const double> coefficients, double span);

} // namespace damslip::sliding
