#include "sliding/planes/joint_motion.hpp"

#include "records/measure/response_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::sliding {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// Values between the samples, linear, then zero.
std::vector<double> refined(const std::vector<double>& samples, int parts, std::size_t count)
{
    std::vector<double> out(count, 0.0);
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
        for (int k = 0; k < parts; ++k)
            out[i * static_cast<std::size_t>(parts) + static_cast<std::size_t>(k)] =
                samples[i] + (samples[i + 1] - samples[i]) * k / parts;
    out[(samples.size() - 1) * static_cast<std::size_t>(parts)] = samples.back();
    return out;
}

void add(const std::vector<double>& a, double factor, std::vector<double>& sum)
{
    if (factor != 0.0)
        for (std::size_t i = 0; i < a.size(); ++i) sum[i] += factor * a[i];
}

/// Adds what one component of the ground's motion makes of both places.
void add_component(const std::vector<double>& accel, double dt, const TiedPart& part, bool vertical, JointMotions& motions)
{
    const auto shares = [vertical](const PlaceShares& place, bool up) -> const ModalShares& {
        return vertical ? (up ? place.v_of_v : place.h_of_v) : (up ? place.v_of_h : place.h_of_h);
    };
    const auto add_all = [&](const std::vector<double>& a, const auto& share) {
        add(a, share(shares(part.joint, false)), motions.joint.accel_h);
        add(a, share(shares(part.joint, true)), motions.joint.accel_v);
        add(a, share(shares(part.mean, false)), motions.mean.accel_h);
        add(a, share(shares(part.mean, true)), motions.mean.accel_v);
    };
    std::vector<double> absolute(accel.size());
    for (std::size_t n = 0; n < part.modes.size(); ++n) {
        const double omega = two_pi * part.modes[n].frequency, ratio = part.modes[n].ratio;
        const records::OscillatorStep step(omega, ratio, dt);
        records::OscillatorState state; // relative to ground that moves with `accel`
        for (std::size_t i = 0; i < accel.size(); ++i) {
            if (i > 0) state = step.advance(state, accel[i - 1], accel[i]);
            absolute[i] = -omega * (omega * state.displacement + 2.0 * ratio * state.velocity);
        }
        add_all(absolute, [n](const ModalShares& s) { return s.of_mode[n]; });
    }
    add_all(accel, [](const ModalShares& s) { return s.rest; });
}

} // namespace

JointMotions joint_motions(const GroundMotion& ground, const TiedPart& part, int parts, double tail)
{
    JointMotions motions;
    const double dt = ground.dt / parts;
    const std::size_t count = (ground.accel_h.size() - 1) * static_cast<std::size_t>(parts) + 1 +
                              static_cast<std::size_t>(std::ceil(tail / dt));
    for (GroundMotion* m : {&motions.joint, &motions.mean}) {
        m->name = ground.name;
        m->dt = dt;
        m->accel_h.assign(count, 0.0);
        m->accel_v.assign(count, 0.0);
    }
    add_component(refined(ground.accel_h, parts, count), dt, part, false, motions);
    if (!ground.accel_v.empty()) add_component(refined(ground.accel_v, parts, count), dt, part, true, motions);
    return motions;
}

SlideResult slide_above(const GroundMotion& ground, const TiedPart& part, const SlipStages& stages,
                        const SlideOptions& options)
{
    GroundMotion motion = ground;
    for (double& a : motion.accel_h) a *= options.polarity;
    SlideOptions own = options;
    own.polarity = 1;
    double highest = 0.0, tail = 0.0;
    constexpr double settled = 7.0; // e^-7 of the vibration is left
    for (const TiedMode& mode : part.modes) {
        highest = std::max(highest, mode.frequency);
        const double decay = two_pi * mode.frequency * mode.ratio;
        tail = std::max(tail, decay > 0.0 ? settled / decay : options.sliding.run_out_max);
    }
    tail = std::min(tail, options.sliding.run_out_max);
    constexpr double steps_per_period = 20.0;
    const int parts = std::max(1, static_cast<int>(std::ceil(motion.dt * highest * steps_per_period)));
    const auto larger = [&](int k) {
        const JointMotions motions = joint_motions(motion, part, k, tail);
        SlideResult of_joint = slide(motions.joint, stages, own), of_mean = slide(motions.mean, stages, own);
        return of_mean.max_slip > of_joint.max_slip ? of_mean : of_joint;
    };
    own.history = HistoryOutput::none;
    const double coarse = larger(parts).max_slip;
    own.history = options.history;
    SlideResult fine = larger(2 * parts);
    fine.slip_error = std::abs(fine.max_slip - coarse);
    return fine;
}

} // namespace damslip::sliding
