#include "verification/exact/two_blocks.hpp"

#include <algorithm>

namespace damslip::exact {

namespace {

double interpolated(const std::vector<double>& samples, double place)
{
    const auto k = static_cast<std::size_t>(place);
    if (k + 1 >= samples.size()) return 0.0;
    return samples[k] + (place - static_cast<double>(k)) * (samples[k + 1] - samples[k]);
}

} // namespace

TwoSlips two_blocks(const GroundMotion& motion, double lower, double upper, double mu_base, double mu_joint)
{
    const double dt = 4e-5, end = motion.dt * static_cast<double>(motion.accel_h.size() - 1) + 5.0;
    double v_lower = 0.0, v_upper = 0.0, p = 0.0, q = 0.0;
    TwoSlips slip;
    for (double t = dt; t < end; t += dt) {
        const double g = 9.81 + interpolated(motion.accel_v, t / motion.dt),
                     a = interpolated(motion.accel_h, t / motion.dt);
        const double free_lower = v_lower + dt * a, free_upper = v_upper + dt * a;
        for (int sweep = 0; sweep < 30; ++sweep) { // p on the lower block by the ground, q on the upper by the lower
            const double limit_p = mu_base * (lower + upper) * g * dt, limit_q = mu_joint * upper * g * dt;
            p = std::clamp(-lower * free_lower + q, -limit_p, limit_p);
            q = std::clamp((free_lower + p / lower - free_upper) / (1.0 / lower + 1.0 / upper), -limit_q, limit_q);
        }
        v_lower = free_lower + (p - q) / lower;
        v_upper = free_upper + q / upper;
        slip.base += dt * v_lower;
        slip.joint += dt * (v_upper - v_lower);
    }
    return slip;
}

} // namespace damslip::exact
