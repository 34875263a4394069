#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace damslip::probability {

struct SubsetOptions {
    std::uint32_t samples = 1000;   ///< of each level; a multiple of 1 / level_probability
    double level_probability = 0.1; ///< p_0
    double spread = 1.5;            ///< half-width of the uniform proposal of each coordinate
    int max_levels = 20;
    std::uint64_t seed = 1;
    std::uint32_t replicate = 0;
};

struct SubsetLevel {
    double threshold = 0.0;  ///< response reached by p_0 of the samples; the last: the limit
    double share = 0.0;      ///< of the samples beyond it
    double acceptance = 1.0; ///< of the proposals
    double gamma = 0.0;      ///< correlation factor: c.o.v.^2 = (1 - share) / (share N) (1 + gamma)
};

struct SubsetResult {
    double probability = 0.0;
    double cov =
        0.0; ///< coefficient of variation, levels taken as independent (Au & Beck 2001, eq. 28-29): a lower guess, of repeated runs up to half as much again
    std::vector<SubsetLevel> levels;
    std::size_t calls = 0;
    bool reached =
        false; ///< false: the limit was not met within max_levels; `probability` is then no estimate but an upper guess
};

/// P(response(z) > limit), z independent standard normal: subset simulation with the modified Metropolis algorithm (Au & Beck 2001).
/// Draws are of Philox: the same seed gives the same bits.
SubsetResult subset_simulation(std::size_t dimension, const std::function<double(std::span<const double>)>& response,
                               double limit, const SubsetOptions& options = {});

} // namespace damslip::probability
