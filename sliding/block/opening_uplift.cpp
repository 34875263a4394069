#include "sliding/block/opening_uplift.hpp"

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

} // namespace damslip::sliding
