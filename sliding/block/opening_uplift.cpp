#include "sliding/block/opening_uplift.hpp"

#include "sliding/block/slow_water.hpp"

#include <algorithm>

namespace damslip::sliding {

double OpeningUplift::at(SlipDirection direction, double a_v) const
{
    const std::vector<double>& change = direction == SlipDirection::downstream ? downstream : upstream;
    if (a_v <= accel_v.front()) return change.front();
    if (a_v >= accel_v.back()) return change.back();
    const auto after =
        static_cast<std::size_t>(std::upper_bound(accel_v.begin(), accel_v.end(), a_v) - accel_v.begin());
    const double share = (a_v - accel_v[after - 1]) / (accel_v[after] - accel_v[after - 1]);
    return change[after - 1] + share * (change[after] - change[after - 1]);
}

double OpeningUplift::per_accel_v(SlipDirection direction) const
{
    if (accel_v.size() < 2) return 0.0;
    const double step = 0.5 * (accel_v[1] - accel_v[0]);
    return (at(direction, step) - at(direction, -step)) / (2.0 * step);
}

double OpeningUplift::largest() const
{
    return std::max({0.0, *std::max_element(downstream.begin(), downstream.end()),
                     *std::max_element(upstream.begin(), upstream.end())});
}

double OpeningUplift::largest(SlipDirection direction, double a_v_min, double a_v_max) const
{
    const auto change = [&](double a_v) {
        return slow ? slow->sliding(direction, a_v, slow->first(direction)).change : at(direction, a_v);
    };
    double most = std::max(change(a_v_min), change(a_v_max));
    for (const double a_v : accel_v)
        if (a_v_min < a_v && a_v < a_v_max) most = std::max(most, change(a_v));
    return most;
}

double OpeningUplift::next_bend(const Line& a_v, double from) const
{
    constexpr double round_off = 1e-12;
    double next = 1.0;
    for (const double bend : accel_v) {
        const double share = (bend - a_v.now) / (a_v.end - a_v.now);
        if (share > from + round_off && share < 1.0 - round_off) next = std::min(next, share);
    }
    return next;
}

} // namespace damslip::sliding
