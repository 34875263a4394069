#include "records/generate/finish.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::records {

namespace {

struct EndState {
    double velocity = 0.0;     ///< in units of dt
    double displacement = 0.0; ///< in units of dt^2
};

EndState end_state(const std::vector<double>& accel)
{
    EndState s;
    for (std::size_t k = 1; k < accel.size(); ++k) {
        s.displacement += s.velocity + accel[k - 1] / 3.0 + accel[k] / 6.0;
        s.velocity += 0.5 * (accel[k - 1] + accel[k]);
    }
    return s;
}

std::size_t largest(const std::vector<double>& accel)
{
    return static_cast<std::size_t>(
        std::max_element(accel.begin(), accel.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
        accel.begin());
}

} // namespace

void end_at_rest(std::vector<double>& accel)
{
    const std::size_t n = accel.size();
    std::vector<double> bump(n), slope(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = static_cast<double>(k) / static_cast<double>(n - 1), s = std::sin(std::numbers::pi * x);
        bump[k] = s * s;
        slope[k] = x * bump[k];
    }
    const EndState a = end_state(bump), b = end_state(slope), now = end_state(accel);
    const double determinant = a.velocity * b.displacement - b.velocity * a.displacement;
    const double c0 = (now.velocity * b.displacement - b.velocity * now.displacement) / determinant;
    const double c1 = (a.velocity * now.displacement - now.velocity * a.displacement) / determinant;
    for (std::size_t k = 1; k + 1 < n; ++k) accel[k] -= c0 * bump[k] + c1 * slope[k];
}

void set_peak(std::vector<double>& accel, double pga)
{
    const auto move_to = [&](std::size_t k, double value) {
        const double d = value - accel[k];
        accel[k] = value;
        accel[k - 1] -= 0.5 * d;
        accel[k + 1] -= 0.5 * d;
    };
    const auto top = [&] { return std::clamp<std::size_t>(largest(accel), 2, accel.size() - 3); };
    if (const std::size_t k = top(); std::abs(accel[k]) < pga) move_to(k, std::copysign(pga, accel[k]));
    bool changed = true;
    for (int pass = 0; pass < 100 && changed; ++pass) {
        changed = false;
        for (std::size_t k = 2; k + 2 < accel.size(); ++k)
            if (std::abs(accel[k]) > pga) move_to(k, std::copysign(pga, accel[k])), changed = true;
    }
    // What the cuts left above or below, a common factor sets right; it too keeps an end at rest.
    const std::size_t k = largest(accel);
    const double factor = pga / std::abs(accel[k]);
    for (double& a : accel) a *= factor;
    accel[k] = std::copysign(pga, accel[k]);
}

void round_samples(std::vector<double>& accel, double pga)
{
    const std::size_t peak = largest(accel);
    for (std::size_t k = 0; k < accel.size(); ++k) {
        if (k == peak) continue;
        const double up = std::nearbyint(accel[k] * 1e6);
        const double millionths = std::abs(up / 1e6) > pga ? std::trunc(accel[k] * 1e6) : up;
        accel[k] = millionths / 1e6 + 0.0; // + 0.0: no negative zeros
    }
}

} // namespace damslip::records
