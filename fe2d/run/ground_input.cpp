#include "fe2d/run/ground_input.hpp"

#include "core/defect.hpp"
#include "core/input_error.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

namespace {

/// @returns the motion. @throws InputError for what cannot be integrated
const GroundMotion& checked(const GroundMotion& motion)
{
    const auto finite = [](const std::vector<double>& a) {
        return std::all_of(a.begin(), a.end(), [](double value) { return std::isfinite(value); });
    };
    if (motion.dt > 0.0 && motion.accel_h.size() >= 2 && finite(motion.accel_h) && finite(motion.accel_v) &&
        (motion.accel_v.empty() || motion.accel_v.size() == motion.accel_h.size()))
        return motion;
    throw InputError(Diagnostic{motion.name, 0, 0, "the ground motion cannot be integrated.",
                                "a time step > 0 s and at least 2 finite samples, the vertical component as long as "
                                "the horizontal one",
                                "check the samples; records that are read from files are checked there"});
}

} // namespace

GroundInput::GroundInput(const GroundMotion& motion, MassDamping damping, double mass_coefficient)
    : motion_(checked(motion)), history_(motion_), drag_(damping == MassDamping::total ? mass_coefficient : 0.0)
{
}

GroundAcceleration GroundInput::at(double time) const
{
    const double place = time / motion_.dt, last = static_cast<double>(motion_.accel_h.size() - 1);
    const GroundState ground = history_.at(time);
    if (place > last * (1.0 + 1e-12)) return {0.0, 0.0, ground.velocity_h, ground.velocity_v, ground.displacement_v};
    const double clamped = std::clamp(place, 0.0, last);
    const auto k = std::min(static_cast<std::size_t>(clamped), motion_.accel_h.size() - 2);
    const double share = clamped - static_cast<double>(k);
    const auto value = [&](const std::vector<double>& a) { return a.empty() ? 0.0 : a[k] + share * (a[k + 1] - a[k]); };
    const double upstream = defect(Defect::polarity) ? -1.0 : 1.0;
    return {upstream * value(motion_.accel_h),
            value(motion_.accel_v),
            ground.velocity_h,
            ground.velocity_v,
            ground.displacement_v,
            drag_ * ground.velocity_h,
            drag_ * ground.velocity_v};
}

} // namespace damslip::fe2d
