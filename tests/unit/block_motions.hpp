#pragma once

#include "records/record.hpp"
#include "sliding/block/rigid_block.hpp"

#include <cmath>
#include <numbers>
#include <vector>

/// Ground motions and blocks of the sliding tests.
namespace damslip::test {

/// Samples of a function at 0, dt, ..., n dt.
template <typename Function>
GroundMotion sampled(Function&& accel_h, double dt, int n)
{
    GroundMotion motion{"test", dt, {}, {}, {}};
    for (int k = 0; k <= n; ++k) motion.accel_h.push_back(accel_h(k * dt));
    return motion;
}

template <typename FunctionH, typename FunctionV>
GroundMotion sampled(FunctionH&& accel_h, FunctionV&& accel_v, double dt, int n)
{
    GroundMotion motion = sampled(accel_h, dt, n);
    for (int k = 0; k <= n; ++k) motion.accel_v.push_back(accel_v(k * dt));
    return motion;
}

inline GroundMotion steady(double a_h, double duration, int n = 1)
{
    return sampled([=](double) { return a_h; }, duration / n, n);
}

/// Horizontal base, mass 1, g = 10: yield accelerations a_y downstream and a_up upstream.
inline sliding::RigidBlock block_with_yields(double a_y, double a_up)
{
    sliding::RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    block.friction = 0.5 * (a_y + a_up) / 10.0;
    block.horizontal_force = 0.5 * (a_up - a_y);
    return block;
}

inline sliding::RigidBlock block_with_yield(double a_y)
{
    return block_with_yields(a_y, a_y);
}

inline double relative(double a, double b)
{
    return std::abs(a - b) / std::abs(b);
}

/// A wild but repeatable broad-band motion: decaying sum of sines with unrelated periods.
inline GroundMotion wild_motion(double peak, double dt, int n)
{
    return sampled(
        [=](double t) {
            const double envelope = t < 2.0 ? t / 2.0 : std::exp(-0.15 * (t - 2.0));
            return peak * envelope *
                   (0.5 * std::sin(7.3 * t) + 0.35 * std::sin(19.1 * t + 1.0) + 0.3 * std::sin(41.7 * t + 2.0));
        },
        dt, n);
}

/// The same piecewise-linear functions with `parts` samples for each one.
inline GroundMotion subdivided(const GroundMotion& motion, int parts)
{
    const auto refine = [parts](const std::vector<double>& a) {
        std::vector<double> fine;
        for (std::size_t k = 0; k + 1 < a.size(); ++k)
            for (int i = 0; i < parts; ++i) fine.push_back(a[k] + (a[k + 1] - a[k]) * i / parts);
        if (!a.empty()) fine.push_back(a.back());
        return fine;
    };
    return {motion.name, motion.dt / parts, refine(motion.accel_h), refine(motion.accel_v), {}};
}

} // namespace damslip::test
