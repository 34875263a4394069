#include "verification/exact/column_on_base.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::exact {

int ThrownColumn::arrivals() const
{
    return std::max(0, static_cast<int>(std::ceil(0.5 * (velocity / friction_velocity - 1.0))));
}

double ThrownColumn::stop_time() const
{
    return 2.0 * arrivals() * height / wave_speed;
}

double ThrownColumn::slip(double t) const
{
    const double interval = 2.0 * height / wave_speed, end = std::clamp(t, 0.0, stop_time());
    const double n = std::floor(end / interval), passed = n * (velocity - n * friction_velocity) * interval;
    return passed + (end - n * interval) * (velocity - (2.0 * n + 1.0) * friction_velocity);
}

double ThrownColumn::final_slip() const
{
    const double n = arrivals();
    return 2.0 * height / wave_speed * n * (velocity - n * friction_velocity);
}

double ThrownColumn::held_stress() const
{
    return velocity / friction_velocity - 2.0 * arrivals();
}

} // namespace damslip::exact
