#include "probability/estimate/subset.hpp"

#include "core/number.hpp"
#include "probability/laws/distribution.hpp"
#include "probability/laws/normal.hpp"
#include "probability/sampling/philox.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace damslip::probability {

namespace {

struct SubsetSample {
    std::vector<double> z;
    double response = 0.0;
};

/// Correlation factor of N = chains x steps indicators (Au & Beck 2001, eq. 29): 2 sum_k (1 - k chains / N) rho(k).
double chain_correlation(const std::vector<double>& indicators, std::size_t chains, double share)
{
    if (!(share > 0.0 && share < 1.0)) return 0.0;
    const std::size_t n = indicators.size(), steps = n / chains; // sample s of chain c at [s chains + c]
    double gamma = 0.0;
    for (std::size_t k = 1; k < steps; ++k) {
        double sum = 0.0;
        for (std::size_t i = 0; i + k * chains < n; ++i) sum += indicators[i] * indicators[i + k * chains];
        const double covariance = sum / static_cast<double>(n - k * chains) - share * share;
        gamma += 2.0 * (1.0 - static_cast<double>(k * chains) / static_cast<double>(n)) * covariance /
                 (share * (1.0 - share));
    }
    return std::max(0.0, gamma);
}

class SubsetRun {
public:
    SubsetRun(std::size_t dimension, const std::function<double(std::span<const double>)>& response, double limit,
              const SubsetOptions& options)
        : dimension_(dimension), response_(response), limit_(limit), options_(options),
          seeds_(static_cast<std::size_t>(std::lround(options.samples * options.level_probability)))
    {
    }

    SubsetResult run()
    {
        draw_first();
        std::size_t chains = options_.samples; // of the first level: all samples are independent
        double acceptance = 1.0, squares = 0.0;
        result_.probability = 1.0;
        for (int level = 0;; ++level) {
            std::vector<double> ordered;
            for (const SubsetSample& s : samples_) ordered.push_back(s.response);
            std::sort(ordered.begin(), ordered.end(), std::greater<>());
            // Halfway between the last sample above and the first below: p_0 of them lie beyond.
            const double between = 0.5 * (ordered[seeds_ - 1] + ordered[seeds_]);
            const bool last = between >= limit_ || level + 1 == options_.max_levels;
            const SubsetLevel now = measure(last ? limit_ : between, chains, acceptance);
            result_.levels.push_back(now);
            result_.probability *= now.share;
            if (now.share > 0.0)
                squares += (1.0 - now.share) / (now.share * static_cast<double>(options_.samples)) * (1.0 + now.gamma);
            if (last) {
                result_.reached = between >= limit_;
                break;
            }
            if (now.share == 0.0) break; // a plateau: no sample lies beyond its own level
            chains = next_level(now.threshold, static_cast<std::uint32_t>(level + 1), acceptance);
        }
        result_.cov = std::sqrt(squares);
        return std::move(result_);
    }

private:
    void draw_first()
    {
        for (std::uint32_t i = 0; i < options_.samples; ++i) {
            SubsetSample s;
            for (std::uint32_t k = 0; k < dimension_; ++k) s.z.push_back(normal_quantile(start_.uniform(i, k)));
            s.response = answer(s.z);
            samples_.push_back(std::move(s));
        }
    }

    double answer(const std::vector<double>& z)
    {
        ++result_.calls;
        return response_(z);
    }

    SubsetLevel measure(double threshold, std::size_t chains, double acceptance) const
    {
        std::vector<double> indicators;
        for (const SubsetSample& s : samples_) indicators.push_back(s.response > threshold ? 1.0 : 0.0);
        SubsetLevel level;
        level.threshold = threshold;
        level.share =
            std::accumulate(indicators.begin(), indicators.end(), 0.0) / static_cast<double>(indicators.size());
        level.acceptance = acceptance;
        level.gamma = chains == samples_.size() ? 0.0 : chain_correlation(indicators, chains, level.share);
        return level;
    }

    /// Chains from all samples beyond the threshold, side by side, until the level is full. @returns number of chains
    std::size_t next_level(double threshold, std::uint32_t level, double& acceptance)
    {
        std::vector<SubsetSample> next;
        for (SubsetSample& s : samples_)
            if (s.response > threshold) next.push_back(std::move(s));
        const std::size_t chains = next.size();
        const Stream moves(options_.seed, fmt::format("subset level {}", level), options_.replicate);
        std::size_t accepted = 0;
        while (next.size() < options_.samples) {
            SubsetSample s = next[next.size() - chains];
            const std::uint32_t i = static_cast<std::uint32_t>(next.size());
            std::vector<double> z = s.z;
            for (std::uint32_t k = 0; k < dimension_; ++k) { // each coordinate by itself: ratio of its normal densities
                const double trial = z[k] + options_.spread * (2.0 * moves.uniform(i, 2 * k) - 1.0);
                if (std::log(moves.uniform(i, 2 * k + 1)) < 0.5 * (z[k] * z[k] - trial * trial)) z[k] = trial;
            }
            if (z != s.z) {
                const double response = answer(z);
                if (response > threshold) s = {std::move(z), response}, ++accepted;
            }
            next.push_back(std::move(s));
        }
        acceptance = static_cast<double>(accepted) / static_cast<double>(options_.samples - chains);
        samples_ = std::move(next);
        return chains;
    }

    std::size_t dimension_;
    const std::function<double(std::span<const double>)>& response_;
    double limit_;
    const SubsetOptions& options_;
    std::size_t seeds_;
    Stream start_{options_.seed, "subset level 0", options_.replicate};
    std::vector<SubsetSample> samples_;
    SubsetResult result_;
};

} // namespace

SubsetResult subset_simulation(std::size_t dimension, const std::function<double(std::span<const double>)>& response,
                               double limit, const SubsetOptions& options)
{
    if (!(options.level_probability > 0.0 && options.level_probability < 0.5))
        throw ParameterError("level_probability", shortest(options.level_probability), "0 < p_0 < 0.5");
    if (options.samples * options.level_probability < 2.0)
        throw ParameterError("samples", fmt::format("{}", options.samples), "2 / p_0 at least");
    return SubsetRun(dimension, response, limit, options).run();
}

} // namespace damslip::probability
