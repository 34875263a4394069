#include "records/transform/sequence.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

constexpr int most_parts = 16;
constexpr double same = 1e-9; ///< relative; steps of text files carry fewer digits

/// The step that both are whole multiples of; 0: none.
double common_part(double a, double b)
{
    for (int m = 1; m <= most_parts; ++m) {
        const double n = std::round(m * b / a);
        if (n >= 1.0 && n <= most_parts && std::abs(n * a - m * b) <= same * m * b) return a / m;
    }
    return 0.0;
}

double common_step(const std::vector<GroundMotion>& motions, bool& exact)
{
    double step = motions.front().dt, finest = step;
    exact = true;
    for (const GroundMotion& motion : motions) {
        finest = std::min(finest, motion.dt);
        if (exact) step = common_part(step, motion.dt);
        exact = exact && step > 0.0;
    }
    return exact ? step : finest;
}

/// Linear between the samples, which every whole part of a step keeps.
std::vector<double> at_step(const std::vector<double>& accel, double dt, double step)
{
    const double parts = std::round(dt / step);
    if (parts == 1.0 && std::abs(dt - step) <= same * dt) return accel;
    const bool whole = std::abs(dt - parts * step) <= same * dt;
    const auto last = static_cast<double>(accel.size() - 1);
    const auto count = static_cast<std::size_t>(whole ? parts * last : std::floor(last * dt / step * (1.0 + same)));
    std::vector<double> result;
    for (std::size_t i = 0; i <= count; ++i) {
        const double place = std::min(last, static_cast<double>(i) * (whole ? 1.0 / parts : step / dt));
        const auto k = std::min(static_cast<std::size_t>(place), accel.size() - 2);
        const double share = place - static_cast<double>(k);
        result.push_back(accel[k] + share * (accel[k + 1] - accel[k]));
    }
    return result;
}

} // namespace

GroundMotion one_after_the_other(const std::vector<GroundMotion>& motions, double pause)
{
    bool exact = true;
    const bool vertical =
        std::any_of(motions.begin(), motions.end(), [](const GroundMotion& m) { return !m.accel_v.empty(); });
    GroundMotion all;
    all.dt = common_step(motions, exact);
    all.pause = pause;
    for (const GroundMotion& motion : motions) {
        all.events.push_back({motion.name, all.accel_h.size()});
        for (const std::string& note : motion.notes) all.notes.push_back(motion.name + ": " + note);
        if (!exact && motion.dt != all.dt)
            all.notes.push_back(fmt::format("{}: dt = {} s interpolated at {} s, the finest of the sequence",
                                            motion.name, motion.dt, all.dt));
        const std::vector<double> h = at_step(motion.accel_h, motion.dt, all.dt);
        all.accel_h.insert(all.accel_h.end(), h.begin(), h.end());
        if (!vertical) continue;
        const std::vector<double> v =
            motion.accel_v.empty() ? std::vector<double>(h.size(), 0.0) : at_step(motion.accel_v, motion.dt, all.dt);
        all.accel_v.insert(all.accel_v.end(), v.begin(), v.end());
    }
    return all;
}

GroundMotion as_played(const GroundMotion& sequence, const std::vector<double>& starts)
{
    if (!sequence.is_sequence()) return sequence;
    GroundMotion played = sequence;
    played.events.clear();
    for (auto component : {&GroundMotion::accel_h, &GroundMotion::accel_v}) {
        const std::vector<double>& samples = sequence.*component;
        std::vector<double>& out = played.*component;
        out.clear();
        if (samples.empty()) continue;
        for (std::size_t e = 0; e < std::min(starts.size(), sequence.events.size()); ++e) {
            const auto first = static_cast<std::size_t>(std::llround(starts[e] / sequence.dt));
            out.resize(std::max(out.size(), first), 0.0);
            const auto from = samples.begin() + static_cast<std::ptrdiff_t>(sequence.events[e].first);
            out.insert(out.end(), from, samples.begin() + static_cast<std::ptrdiff_t>(sequence.last_of(e)) + 1);
        }
    }
    return played;
}

} // namespace damslip::records
