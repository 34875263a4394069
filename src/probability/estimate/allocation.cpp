#include "probability/estimate/allocation.hpp"

#include "probability/laws/distribution.hpp"
#include "probability/laws/normal.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::probability {

double two_level_speed_up(double rho, double cost_dear, double cost_cheap)
{
    const double w = cost_cheap / cost_dear, r2 = std::min(1.0, rho * rho);
    if (!(r2 > w * (1.0 - r2))) return 1.0 / (1.0 + w);
    return 1.0 / std::pow(std::sqrt(1.0 - r2) + std::sqrt(r2 * w), 2);
}

PilotDecision decide_on_pilot(std::size_t n, double rho, const std::function<double(double)>& gain)
{
    PilotDecision d;
    d.rho = rho;
    d.rho_lower = -1.0;
    d.rho_upper = 1.0;
    if (n < 4 || !std::isfinite(rho)) {
        d.sentence = fmt::format("off: {} pairs in the pilot tell no correlation", n);
        return d;
    }
    const double half = normal_quantile(0.95) / std::sqrt(static_cast<double>(n) - 3.0);
    const double z = std::atanh(std::clamp(rho, -1.0 + 1e-12, 1.0 - 1e-12));
    d.rho_lower = std::tanh(z - half);
    d.rho_upper = std::tanh(z + half);
    d.speed_up = gain(std::max(0.0, rho));
    d.speed_up_lower = gain(std::max(0.0, d.rho_lower));
    d.use = d.speed_up_lower > 1.2;
    d.sentence = fmt::format("{}: ρ {:.2f} ({:.2f}…{:.2f}), {} {:.1f}, {:.1f} at least", d.use ? "on" : "off", rho,
                             d.rho_lower, d.rho_upper, d.use ? "gains" : "would gain", d.speed_up, d.speed_up_lower);
    return d;
}

double variance_gain(double rho, double share)
{
    return 1.0 / (1.0 - rho * rho * share);
}

double less_chance(double rho, std::size_t n, std::size_t parameters)
{
    if (n <= parameters + 1) return 0.0;
    const double r2 = 1.0 - (1.0 - rho * rho) * static_cast<double>(n - 1) / static_cast<double>(n - parameters - 1);
    return std::isfinite(r2) ? std::copysign(std::sqrt(std::max(0.0, r2)), rho) : rho;
}

double correlation(std::span<const double> a, std::span<const double> b)
{
    const double n = static_cast<double>(a.size());
    double mean_a = 0.0, mean_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) mean_a += a[i] / n, mean_b += b[i] / n;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : std::numeric_limits<double>::quiet_NaN();
}

TwoLevelSizes two_level_sizes(double budget, double rho, double cost_dear, double cost_cheap)
{
    const double r2 = std::min(rho * rho, 1.0 - 1e-9);
    const double ratio = std::clamp(std::sqrt(r2 * cost_dear / (cost_cheap * (1.0 - r2))), 1.0, 1000.0);
    TwoLevelSizes sizes;
    sizes.dear = static_cast<std::uint64_t>(std::max(0.0, budget / (cost_dear + ratio * cost_cheap)));
    const double left = budget - static_cast<double>(sizes.dear) * (cost_dear + cost_cheap);
    sizes.cheap = static_cast<std::uint64_t>(
        std::clamp(left / cost_cheap, 0.0, std::ceil((ratio - 1.0) * static_cast<double>(sizes.dear))));
    return sizes;
}

std::vector<std::uint64_t> allocate_strata(std::span<const Stratum> strata, double budget, std::uint64_t least)
{
    std::vector<double> wish;
    for (const Stratum& s : strata) {
        const double p = (s.z + 0.5) / (s.n + 1.0);
        wish.push_back(s.weight * std::sqrt(p * (1.0 - p) * (1.0 - s.rho * s.rho) / s.cost));
    }
    // Strata whose share falls below the least get that, and the rest is shared by the others, until none falls below.
    std::vector<std::uint64_t> sizes(strata.size(), 0);
    std::vector<bool> fixed(strata.size(), false);
    for (bool again = true; again;) {
        again = false;
        double left = budget, cost = 0.0;
        for (std::size_t i = 0; i < strata.size(); ++i) {
            if (fixed[i])
                left -= static_cast<double>(least) * strata[i].cost;
            else
                cost += wish[i] * strata[i].cost;
        }
        for (std::size_t i = 0; i < strata.size(); ++i) {
            if (fixed[i]) {
                sizes[i] = least;
                continue;
            }
            const double size = cost > 0.0 ? std::max(0.0, left) * wish[i] / cost : 0.0;
            sizes[i] = static_cast<std::uint64_t>(size * (1.0 + 1e-12));
            if (sizes[i] < least) again = fixed[i] = true;
        }
    }
    return sizes;
}

double batch_size(double cost_set_up, double cost_run, double icc)
{
    if (!(icc > 0.0)) return std::numeric_limits<double>::infinity(); // set-ups do not differ: one is enough
    return std::max(1.0, std::sqrt(cost_set_up / cost_run * (1.0 - icc) / icc));
}

} // namespace damslip::probability
