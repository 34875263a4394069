#include "sliding/empirical/ensemble.hpp"

#include "sliding/empirical/regression_rows.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::sliding {

namespace {

/// One member's distribution of D [cm].
struct Member {
    double weight;
    double zero;   ///< P(D = 0)
    double median; ///< of D > 0; 0: D = 0 surely
    double sigma;  ///< of ln D; 0: a step

    double below(double d) const ///< P(D <= d), d > 0
    {
        if (median <= 0.0) return 1.0;
        const double z = std::log(d / median);
        const double share = sigma > 0.0 ? normal_cdf(z / sigma) : (z >= 0.0 ? 1.0 : 0.0);
        return zero + (1.0 - zero) * share;
    }
};

double weight_of(const RegressionResult& result, std::span<const RegressionWeight> weights)
{
    if (weights.empty()) return result.regression->use == EnsembleUse::estimate ? 1.0 : 0.0;
    double sum = 0.0;
    for (const RegressionWeight& w : weights)
        if (w.id == result.regression->id) sum += w.weight;
    return sum;
}

bool valid(const RegressionResult& result)
{
    return result.median_cm && result.within_range;
}

/// Smallest D with P(D' <= D) >= q: bisection on ln D between bounds outside of which no member has weight.
double quantile(const std::vector<Member>& members, double q)
{
    const auto below = [&](double d) {
        double p = 0.0;
        for (const Member& m : members) p += m.weight * m.below(d);
        return p;
    };
    double low = 1e300, high = 0.0;
    for (const Member& m : members)
        if (m.median > 0.0) {
            low = std::min(low, m.median * std::exp(-12.0 * m.sigma));
            high = std::max(high, m.median * std::exp(12.0 * m.sigma));
        }
    if (high == 0.0 || below(0.999 * low) >= q) return 0.0;
    double a = std::log(0.999 * low), b = std::log(high);
    for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (a + b);
        (below(std::exp(middle)) >= q ? b : a) = middle;
    }
    return std::exp(b);
}

} // namespace

Ensemble weighted_ensemble(std::span<const RegressionResult> results, std::span<const RegressionWeight> weights)
{
    Ensemble ensemble;
    std::vector<Member> members;
    double sum = 0.0, all = 0.0;
    for (const RegressionResult& result : results) {
        const double weight = weight_of(result, weights);
        assert(weight >= 0.0 && std::isfinite(weight));
        all += weight;
        if (weight <= 0.0 || !valid(result)) continue;
        sum += weight;
        const double to_natural = result.regression->logarithm == Logarithm::decimal ? std::log(10.0) : 1.0;
        members.push_back(
            {weight, result.zero_probability.value_or(0.0), *result.median_cm, result.sigma * to_natural});
        ensemble.members.push_back(result.regression->id);
    }
    if (all > 0.0) ensemble.weight_left_out = 1.0 - sum / all;
    if (members.empty()) return ensemble;
    double mean = 0.0;
    for (Member& m : members) {
        m.weight /= sum;
        ensemble.weights.push_back(m.weight);
        mean += m.weight * (1.0 - m.zero) * m.median;
    }
    ensemble.mean_cm = mean;
    ensemble.low_cm = quantile(members, normal_cdf(-1.0));
    ensemble.median_cm = quantile(members, 0.5);
    ensemble.high_cm = quantile(members, normal_cdf(1.0));
    return ensemble;
}

} // namespace damslip::sliding
