#include "records/measure/frequency_content.hpp"

#include <algorithm>
#include <cassert>
#include <complex>
#include <numbers>
#include <vector>

namespace damslip::records {

namespace {

/// |sum a_k exp(-i w k dt)|^2, by Horner's rule.
double power(std::span<const double> accel, double angle)
{
    const std::complex<double> turn = std::polar(1.0, -angle);
    std::complex<double> sum = 0.0;
    for (std::size_t k = accel.size(); k-- > 0;) sum = sum * turn + accel[k];
    return std::norm(sum);
}

} // namespace

double frequency_below(std::span<const double> accel, double dt, double share)
{
    assert(dt > 0.0 && share >= 0.0 && share <= 1.0);
    constexpr double df = 0.1, largest = 50.0;
    std::vector<double> below{0.0};
    double before = power(accel, 0.0);
    for (double f = df; f <= std::min(largest, 0.5 / dt) + 1e-9; f = df * static_cast<double>(below.size())) {
        const double now = power(accel, 2.0 * std::numbers::pi * f * dt);
        below.push_back(below.back() + 0.5 * (before + now));
        before = now;
    }
    if (below.back() == 0.0) return 0.0;
    const auto at = std::lower_bound(below.begin(), below.end(), share * below.back());
    return df * static_cast<double>(at - below.begin());
}

} // namespace damslip::records
