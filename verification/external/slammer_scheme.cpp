#include "verification/external/slammer_scheme.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::external {

namespace {

using std::numbers::pi;
constexpr double mass_ratio = 8.0 / (pi * pi); ///< Gamma

/// Deflection, its rate and second derivative.
struct Mode {
    double x = 0.0, rate = 0.0, accel = 0.0;
};

/// A step of Newmark's average acceleration in increments. @param inertia  1 on a base at rest, 1 - Gamma on a sliding one
/// @param change, load  of the acceleration that drives it
Mode newmark_step(const SlammerColumn& c, double inertia, const Mode& m, double change, double load, double dt)
{
    const double damping = 2.0 * c.damping * c.omega;
    const double stiffness = c.omega * c.omega + 2.0 * damping / dt + 4.0 * inertia / (dt * dt);
    const double force = change + (4.0 * inertia / dt + 2.0 * damping) * m.rate + 2.0 * inertia * m.accel;
    const double dx = force / stiffness;
    Mode next;
    next.x = m.x + dx;
    next.rate = m.rate + 2.0 / dt * dx - 2.0 * m.rate;
    next.accel = (load - damping * next.rate - c.omega * c.omega * next.x) / inertia;
    return next;
}

/// The first step starts from nothing.
Mode first_step(const SlammerColumn& c, double load, double dt)
{
    return newmark_step(c, 1.0, {}, load, load, dt);
}

} // namespace

SlammerResponse slammer_response(const SlammerColumn& column, std::span<const double> accel, double dt)
{
    SlammerResponse response;
    response.drive.reserve(accel.size());
    Mode mode;
    for (std::size_t i = 0; i < accel.size(); ++i) {
        mode = i == 0 ? first_step(column, accel[0], dt)
                      : newmark_step(column, 1.0, mode, accel[i] - accel[i - 1], accel[i], dt);
        const double drive = accel[i] - mass_ratio * mode.accel;
        response.drive.push_back(drive);
        response.largest_drive = std::max(response.largest_drive, std::abs(drive));
        response.largest_deflection = std::max(response.largest_deflection, std::abs(mode.x));
    }
    return response;
}

double slammer_decoupled(std::span<const double> drive, double dt, double yield)
{
    bool slides = false;
    double slip = 0.0, rate = 0.0;
    for (std::size_t j = 0; j < drive.size(); ++j) {
        if (!slides) {
            slides = drive[j] > yield;
            continue;
        }
        if (j == 0) continue;
        const double change = drive[j] - drive[j - 1], excess = drive[j - 1] - yield;
        const double next_rate = rate + excess * dt + 0.5 * change * dt;
        if (next_rate > 0.0) {
            slip += rate * dt + 0.5 * dt * dt * excess + change * dt * dt / 6.0;
            rate = next_rate;
        } else {
            slides = false;
            rate = 0.0;
        }
    }
    return slip;
}

double slammer_coupled(const SlammerColumn& column, std::span<const double> accel, double dt, double yield)
{
    bool slides = false;
    Mode mode;
    double slip = 0.0, rate = 0.0, slip_accel = 0.0;
    for (std::size_t j = 0; j < accel.size(); ++j) {
        const double inertia = slides ? 1.0 - mass_ratio : 1.0;
        const double load = slides ? yield : accel[j];
        const double change = slides ? 0.0 : j == 0 ? accel[0] : accel[j] - accel[j - 1];
        const Mode before = mode;
        mode = j == 0 ? first_step(column, accel[0], dt) : newmark_step(column, inertia, before, change, load, dt);
        if (!slides) {
            slides = accel[j] - mass_ratio * mode.accel > yield;
            continue;
        }
        const double next_accel = accel[j] - yield - mass_ratio * mode.accel;
        const double next_rate = rate + 0.5 * dt * (next_accel + slip_accel);
        if (next_rate > 0.0) {
            slip += 0.5 * dt * (next_rate + rate);
            rate = next_rate;
            slip_accel = next_accel;
            continue;
        }
        // It stops within the step: slip up to there, then the rest of the step on a base at rest.
        const double part = -rate / (next_rate - rate);
        slides = false;
        if (part == 0.0) {
            slip += 0.5 * dt * next_rate; // a start taken back leaves this, below zero
        } else {
            const double ground = accel[j - 1] + part * (accel[j] - accel[j - 1]);
            const double stop_accel = ground - yield - mass_ratio * mode.accel;
            const double stop_rate = rate + 0.5 * part * dt * (stop_accel + slip_accel);
            slip += 0.5 * part * dt * (rate + stop_rate);
            const double rest = (1.0 - part) * dt, damping = 2.0 * column.damping * column.omega,
                         spring = column.omega * column.omega;
            const double force =
                accel[j] - yield +
                ((1.0 - mass_ratio) - 0.5 * damping * rest - 0.25 * spring * rest * rest) * mode.accel -
                spring * rest * mode.rate;
            const double new_accel = force / (1.0 + 0.5 * damping * rest + 0.25 * spring * rest * rest);
            mode = {mode.x + mode.rate * rest + 0.25 * rest * rest * (mode.accel + new_accel),
                    mode.rate + 0.5 * rest * (mode.accel + new_accel), new_accel};
        }
        rate = slip_accel = 0.0;
    }
    return slip;
}

std::optional<StrainCompatible> slammer_equivalent_linear(const StrainColumn& column, std::span<const double> accel,
                                                          double dt)
{
    constexpr int most_iterations = 100;
    constexpr double settled = 0.05;
    const auto foundation = [&](double velocity) {
        return std::min(0.2, 0.55016 * std::pow(column.base_velocity / velocity, -0.9904));
    };
    StrainCompatible now{column.velocity, column.damping + foundation(column.velocity), 0};
    double soil = column.damping;
    while (now.iterations < most_iterations) {
        ++now.iterations;
        const SlammerColumn linear{pi * now.velocity / (2.0 * column.height), now.damping};
        // The deflection of the top is 4/pi of that of the mode's average.
        const double top = 4.0 / pi * slammer_response(linear, accel, dt).largest_deflection;
        const double strain = 100.0 * 0.65 * 1.57 * top / column.height, ratio = strain / column.reference_strain;
        const double velocity = column.velocity / std::sqrt(1.0 + ratio);
        const double masing =
            1.0 / pi * (4.0 * (ratio - std::log(1.0 + ratio)) / (ratio * ratio / (1.0 + ratio)) - 2.0);
        const double new_soil = 0.62 * std::pow(1.0 + ratio, -0.1) * masing + 0.01;
        const bool stays = std::abs(1.0 - velocity * velocity / (now.velocity * now.velocity)) <= settled &&
                           std::abs(1.0 - new_soil / soil) <= settled;
        now.velocity = velocity;
        now.damping = new_soil + foundation(velocity);
        soil = new_soil;
        if (stays) return now;
    }
    return std::nullopt;
}

} // namespace damslip::external
