#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

/// Power series in time, sums of c_i h^i, of the slips that have no closed form.
namespace damslip::sliding {

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
