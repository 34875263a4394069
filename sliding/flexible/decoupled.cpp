#include "core/text.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/flexible/decoupled_motion.hpp"
#include "sliding/flexible/flexible_slide.hpp"

#include <algorithm>

namespace damslip::sliding {

FlexibleSlide slide_decoupled(const GroundMotion& motion, const SlipStages& stages, const FlexibleBlock& flexible,
                              const SlideOptions& options)
{
    check_flexible(flexible, stages);
    check_motion(motion);
    const bool vertical = !motion.accel_v.empty();
    const double dt = motion.dt, longest = options.sliding.run_out_max;
    const auto a_h = [&](std::size_t k) { return options.polarity * motion.accel_h[k]; };
    const auto a_v = [&](std::size_t k) { return vertical ? motion.accel_v[k] : 0.0; };

    FlexibleSlide result;
    DecoupledMotion mass(stages, flexible, options);
    const auto note = [&](double time, double a_h_now, double a_v_now) {
        if (options.history == HistoryOutput::samples)
            mass.block().add_sample(time, mass.average_acceleration(a_h_now), a_v_now, result.slide.history);
    };
    note(0.0, a_h(0), a_v(0));
    const std::size_t last = motion.accel_h.size() - 1;
    for (std::size_t k = 0; k < last; ++k) {
        mass.cross(static_cast<double>(k) * dt, dt, {a_h(k), a_h(k + 1)}, {a_v(k), a_v(k + 1)});
        note(static_cast<double>(k + 1) * dt, a_h(k + 1), a_v(k + 1));
    }
    const double end = static_cast<double>(last) * dt;
    const bool stands = static_state(stages.front().block) == StaticState::at_rest;
    for (double t = 0.0; stands && t < longest && !mass.at_rest_for_good(); t += dt) {
        mass.cross(end + t, std::min(dt, longest - t), {}, {});
        note(end + std::min(t + dt, longest), 0.0, 0.0);
    }
    conclude(mass.block(), stages, options, end, result.slide);
    result.peak_acceleration = mass.peak_acceleration();
    if (result.slide.status == Status::at_rest && !mass.at_rest_for_good()) note_vibration(options, result.slide);
    return result;
}

} // namespace damslip::sliding
