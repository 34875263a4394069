#pragma once

#include "records/record.hpp"

namespace damslip::exact {

/// A ground motion that is a function of time, sampled.
/// @param a_h  of the time [s], upstream positive [m/s²] @param n  intervals in `duration` [s]
template <class Function>
GroundMotion ground_of(Function&& a_h, double duration, int n)
{
    GroundMotion m;
    m.dt = duration / n;
    for (int k = 0; k <= n; ++k) m.accel_h.push_back(a_h(k * m.dt));
    return m;
}

inline GroundMotion stillness(double duration, int n)
{
    return ground_of([](double) { return 0.0; }, duration, n);
}

} // namespace damslip::exact
