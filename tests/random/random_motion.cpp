#include "random/random_motion.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace damslip::random {

namespace {

/// Triangles at random places; zero beyond them.
std::vector<double> pulses(Draw& draw, int samples, double peak)
{
    std::vector<double> a(static_cast<std::size_t>(samples), 0.0);
    for (int k = draw.whole(1, 5); k > 0; --k) {
        const double middle = draw.between(0, samples - 1), half = draw.between(1, 0.3 * samples + 1),
                     top = draw.between(-1, 1) * peak;
        for (int i = 0; i < samples; ++i)
            a[static_cast<std::size_t>(i)] += top * std::max(0.0, 1.0 - std::abs(i - middle) / half);
    }
    if (!draw.chance(0.1)) a.front() = 0.0; // else it begins at full strength
    return a;
}

std::vector<double> component(Draw& draw, int samples, double peak)
{
    const double kind = draw.unit();
    if (kind < 0.04) return std::vector<double>(static_cast<std::size_t>(samples), 0.0);
    if (kind < 0.08) return std::vector<double>(static_cast<std::size_t>(samples), peak); // an offset that stays
    if (kind < 0.14) {
        std::vector<double> spike(static_cast<std::size_t>(samples), 0.0);
        spike[static_cast<std::size_t>(draw.whole(0, samples - 1))] = 5 * peak;
        return spike;
    }
    return pulses(draw, samples, peak);
}

std::string csv(const std::vector<double>& a, double dt)
{
    std::string text = "time_s,accel_m_s2\n";
    for (std::size_t i = 0; i < a.size(); ++i)
        text += fmt::format("{:.9g},{:.5g}\n", static_cast<double>(i) * dt, a[i]);
    return text;
}

} // namespace

void random_motion(Draw& draw, SceneFiles& files)
{
    const double dt = draw.chance(0.25) ? 0.005 : draw.log_between(0.005, 0.05);
    const int samples = draw.whole(2, 60);
    const double peak = draw.chance(0.1) ? draw.log_between(1e-9, 30) : draw.between(0.5, 8);
    files.horizontal = csv(component(draw, samples, peak), dt);
    if (draw.chance(0.6)) files.vertical = csv(component(draw, samples, peak * draw.between(0.2, 2)), dt);
}

} // namespace damslip::random
