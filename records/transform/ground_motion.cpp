#include "records/transform/ground_motion.hpp"

#include "records/transform/transform.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

void flip_and_scale(Record& h, std::optional<Record>& v, const MotionOptions& options)
{
    const double factor = options.scale * (options.scale_to_pga ? factor_to_pga(h, *options.scale_to_pga) : 1.0);
    h = scaled(std::move(h), factor * options.polarity);
    if (v) v = scaled(std::move(*v), factor);
}

/// Brings both records to one time step.
void share_grid(Record& h, Record& v, std::vector<std::string>& notes)
{
    constexpr int most_parts = 16;
    constexpr double same = 1e-9; // relative; steps of text files carry fewer digits
    for (int m = 1; m <= most_parts; ++m) {
        const double n = std::round(m * v.dt / h.dt);
        if (n < 1.0 || n > most_parts || std::abs(n * h.dt - m * v.dt) > same * m * v.dt) continue;
        const double dt_h = h.dt, dt_v = v.dt;
        if (m > 1) h = subdivided(h, m);
        if (n > 1.0) v = subdivided(v, static_cast<int>(n));
        v.dt = h.dt;
        if (m > 1 || n > 1.0)
            notes.push_back(fmt::format("horizontal dt = {} s and vertical dt = {} s subdivided to {} s (same motion)",
                                        dt_h, dt_v, h.dt));
        return;
    }
    const bool horizontal_is_coarse = h.dt > v.dt;
    Record& coarse = horizontal_is_coarse ? h : v;
    const double dt = std::min(h.dt, v.dt);
    const std::size_t before = coarse.warnings.size();
    coarse = resampled(coarse, dt);
    for (std::size_t k = before; k < coarse.warnings.size(); ++k)
        notes.push_back(
            fmt::format("{} component {}", horizontal_is_coarse ? "horizontal" : "vertical", coarse.warnings[k]));
}

/// Zeros at the end of the shorter component.
void pad(std::vector<double>& accel, std::size_t n, const char* component, std::vector<std::string>& notes)
{
    if (accel.size() >= n) return;
    notes.push_back(fmt::format("{} component filled up with {} zero samples to the length of the other", component,
                                n - accel.size()));
    if (accel.back() != 0.0) notes.back() += fmt::format(" (its last sample is {:.3g} m/s2)", accel.back());
    accel.resize(n, 0.0);
}

void start_at_zero(GroundMotion& motion)
{
    const double h0 = motion.accel_h.front(), v0 = motion.accel_v.empty() ? 0.0 : motion.accel_v.front();
    if (h0 == 0.0 && v0 == 0.0) return;
    motion.accel_h.insert(motion.accel_h.begin(), 0.0);
    if (!motion.accel_v.empty()) motion.accel_v.insert(motion.accel_v.begin(), 0.0);
    motion.notes.push_back(fmt::format("a zero sample was put {} s before the first, which is {:.3g} m/s2", motion.dt,
                                       h0 != 0.0 ? h0 : v0));
}

} // namespace

GroundMotion make_ground_motion(const Record& horizontal, const std::optional<Record>& vertical,
                                const MotionOptions& options)
{
    assert(options.polarity == 1 || options.polarity == -1);
    assert(std::isfinite(options.scale));
    Record h = horizontal;
    std::optional<Record> v = vertical;
    GroundMotion motion;
    motion.name = h.name;
    flip_and_scale(h, v, options);
    if (v) share_grid(h, *v, motion.notes);
    motion.dt = h.dt;
    motion.accel_h = std::move(h.acceleration);
    if (v) {
        motion.accel_v = std::move(v->acceleration);
        const std::size_t n = std::max(motion.accel_h.size(), motion.accel_v.size());
        pad(motion.accel_h, n, "horizontal", motion.notes);
        pad(motion.accel_v, n, "vertical", motion.notes);
    }
    start_at_zero(motion);
    return motion;
}

} // namespace damslip::records
