#pragma once

#include <cmath>

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

} // namespace damslip::sliding
