#include "fe2d/time/ground_load.hpp"

#include <cassert>
#include <cmath>

namespace damslip::fe2d {

GroundHistory::GroundHistory(const GroundMotion& motion) : dt_(motion.dt)
{
    assert(dt_ > 0.0 && (motion.accel_v.empty() || motion.accel_v.size() == motion.accel_h.size()));
    GroundState now;
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k) {
        const double h = motion.accel_h[k], v = motion.accel_v.empty() ? 0.0 : motion.accel_v[k];
        if (k > 0) {
            now.velocity_h += 0.5 * dt_ * (now.accel_h + h);
            now.velocity_v += 0.5 * dt_ * (now.accel_v + v);
        }
        now.accel_h = h;
        now.accel_v = v;
        samples_.push_back(now);
    }
    duration_ = samples_.empty() ? 0.0 : dt_ * static_cast<double>(samples_.size() - 1);
}

GroundState GroundHistory::at(double time) const
{
    if (samples_.empty() || time < 0.0) return {};
    double position = time / dt_;
    const double whole = std::round(position); // a step that divides dt falls on samples up to round-off
    if (std::abs(position - whole) < 1e-9 * std::max(1.0, whole)) position = whole;
    const auto last = static_cast<double>(samples_.size() - 1);
    if (position > last) return {0.0, 0.0, samples_.back().velocity_h, samples_.back().velocity_v};
    const auto k = static_cast<std::size_t>(position);
    const GroundState& a = samples_[k];
    const double share = position - static_cast<double>(k);
    if (share == 0.0) return a;
    const GroundState& b = samples_[k + 1];
    GroundState state;
    state.accel_h = a.accel_h + share * (b.accel_h - a.accel_h);
    state.accel_v = a.accel_v + share * (b.accel_v - a.accel_v);
    state.velocity_h = a.velocity_h + 0.5 * share * dt_ * (a.accel_h + state.accel_h);
    state.velocity_v = a.velocity_v + 0.5 * share * dt_ * (a.accel_v + state.accel_v);
    return state;
}

void GroundLoad::evaluate(const GroundState& ground, Eigen::VectorXd& load) const
{
    load = still + ground.accel_h * mass_x - ground.accel_v * mass_y;
    if (damped_x.size() > 0) load += ground.velocity_h * damped_x - ground.velocity_v * damped_y;
}

} // namespace damslip::fe2d
