#include "fe2d/run/ground_input.hpp"

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
    return {value(motion_.accel_h),
            value(motion_.accel_v),
            ground.velocity_h,
            ground.velocity_v,
            ground.displacement_v,
            drag_ * ground.velocity_h,
            drag_ * ground.velocity_v};
}

PlayedGround::PlayedGround(const GroundMotion& motion, MassDamping damping, double mass_coefficient)
    : motion_(motion), played_(motion), damping_(damping), coefficient_(mass_coefficient)
{
    if (motion_.is_sequence()) {
        played_.events.clear();
        played_.accel_h.clear();
        played_.accel_v.clear();
        append(0);
    } else {
        input_.emplace(played_, damping_, coefficient_);
        end_ = input_->duration();
    }
}

void PlayedGround::append(std::size_t event)
{
    event_ = event;
    const auto first = static_cast<std::ptrdiff_t>(motion_.events[event].first),
               end = static_cast<std::ptrdiff_t>(motion_.last_of(event)) + 1;
    start_ = motion_.dt * static_cast<double>(played_.accel_h.size());
    for (auto component : {&GroundMotion::accel_h, &GroundMotion::accel_v}) {
        const std::vector<double>& all = motion_.*component;
        if (!all.empty())
            (played_.*component).insert((played_.*component).end(), all.begin() + first, all.begin() + end);
    }
    end_ = motion_.dt * static_cast<double>(played_.accel_h.size() - 1);
    if (more())
        rest(played_.accel_h.size() + 1);
    else
        input_.emplace(played_, damping_, coefficient_);
}

/// Zero samples up to a number of samples, and some in store.
void PlayedGround::rest(std::size_t samples)
{
    constexpr std::size_t store = 2048;
    played_.accel_h.resize(samples + store, 0.0);
    if (!motion_.accel_v.empty()) played_.accel_v.resize(samples + store, 0.0);
    input_.emplace(played_, damping_, coefficient_);
}

GroundAcceleration PlayedGround::at(double time)
{
    if (more())
        if (const double last = time / motion_.dt + 2.0; last > static_cast<double>(played_.accel_h.size()))
            rest(static_cast<std::size_t>(last));
    return input_->at(time);
}

double PlayedGround::samples_end() const
{
    const std::size_t events = std::max<std::size_t>(1, motion_.events.size());
    return motion_.dt * static_cast<double>(motion_.accel_h.size() - events);
}

void PlayedGround::next(double time)
{
    const auto last = static_cast<std::size_t>(std::llround(end_ / motion_.dt));
    const auto first = std::max(last + 2, static_cast<std::size_t>(std::floor(time / motion_.dt + 1e-9)) + 1);
    played_.accel_h.resize(first, 0.0);
    if (!motion_.accel_v.empty()) played_.accel_v.resize(first, 0.0);
    append(event_ + 1);
}

} // namespace damslip::fe2d
