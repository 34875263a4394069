#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace damslip::sliding {

/// A quantity that is linear over the rest of a sample interval: its value now and at the interval's end.
struct Line {
    double now = 0.0;
    double end = 0.0;

    double at(double fraction) const { return now + (end - now) * fraction; } ///< fraction of the rest, 0 ... 1
};

/// From one fraction of the rest to another.
inline Line part(const Line& line, double from, double to)
{
    return {from == 0.0 ? line.now : line.at(from), to == 1.0 ? line.end : line.at(to)};
}
inline Line operator-(const Line& a)
{
    return {-a.now, -a.end};
}
inline Line combine(double a, const Line& x, double b, const Line& y)
{
    return {a * x.now + b * y.now, a * x.end + b * y.end};
}

/// No event in the interval.
inline constexpr double never = HUGE_VAL;

/// Time from now, within `span`, after which the line is above zero: 0 if it is, or if it is zero and rises; `never` if
/// it does not get there. A line that reaches zero just at the end is the next interval's business.
inline double time_above_zero(const Line& line, double span)
{
    if (line.now > 0.0) return 0.0;
    if (line.end <= 0.0) return never;
    const double h = span * (-line.now / (line.end - line.now));
    return h < span ? h : never;
}

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

// Power series in time, sums of c_i h^i, of the slips that have no closed form.

inline std::vector<double> derivative(std::span<const double> c)
{
    std::vector<double> d(c.size() - 1);
    for (std::size_t i = 1; i < c.size(); ++i) d[i - 1] = static_cast<double>(i) * c[i];
    return d;
}

/// The longest of `span`, half of it, a quarter, ... at which the last two terms are below round-off of the largest one.
inline double length_to_round_off(std::span<const double> c, double span)
{
    double length = span;
    for (int halvings = 0; halvings < 200; ++halvings) {
        double largest = 0.0, last = 0.0, power = 1.0;
        for (std::size_t i = 0; i < c.size(); ++i, power *= length) {
            const double term = std::abs(c[i]) * power;
            largest = std::max(largest, term);
            if (i + 2 >= c.size()) last = std::max(last, term);
        }
        if (last <= 1e-17 * largest) break;
        length *= 0.5;
    }
    return length;
}

} // namespace damslip::sliding
