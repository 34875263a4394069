#include "sliding/empirical/ensemble.hpp"

#include "sliding/empirical/slip_distribution.hpp"

#include <cassert>
#include <cmath>

namespace damslip::sliding {

namespace {

double weight_of(const RegressionResult& result, std::span<const RegressionWeight> weights)
{
    if (weights.empty()) return result.regression->use == EnsembleUse::estimate ? 1.0 : 0.0;
    double sum = 0.0;
    for (const RegressionWeight& w : weights)
        if (w.id == result.regression->id) sum += w.weight;
    return sum;
}

} // namespace

Ensemble weighted_ensemble(std::span<const RegressionResult> results, std::span<const RegressionWeight> weights)
{
    Ensemble ensemble;
    std::vector<SlipDistribution> members;
    double sum = 0.0, all = 0.0;
    for (const RegressionResult& result : results) {
        const double weight = weight_of(result, weights);
        assert(weight >= 0.0 && std::isfinite(weight));
        all += weight;
        if (weight <= 0.0 || !valid(result)) continue;
        sum += weight;
        const double to_natural = result.regression->logarithm == Logarithm::decimal ? std::log(10.0) : 1.0;
        members.push_back({weight, result.zero_probability.value_or(0.0), result.nonzero_median_cm.value_or(0.0),
                           result.sigma * to_natural});
        ensemble.members.push_back(result.regression->id);
    }
    if (all > 0.0) ensemble.weight_left_out = 1.0 - sum / all;
    if (members.empty()) return ensemble;
    for (SlipDistribution& m : members) {
        m.weight /= sum;
        ensemble.weights.push_back(m.weight);
    }
    ensemble.median_cm = quantile(members, 0.5);
    if (members.size() == 1 && members[0].sigma == 0.0 && members[0].median > 0.0) return ensemble;
    ensemble.low_cm = quantile(members, normal_cdf(-1.0));
    ensemble.high_cm = quantile(members, normal_cdf(1.0));
    return ensemble;
}

} // namespace damslip::sliding
