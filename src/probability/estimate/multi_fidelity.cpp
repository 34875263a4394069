#include "probability/estimate/multi_fidelity.hpp"

#include "core/number.hpp"
#include "probability/estimate/calibration.hpp"
#include "probability/estimate/two_level.hpp"
#include "probability/laws/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::probability {

namespace {

/// rho_i^2 - rho_(i+1)^2 of the chosen models, the one behind the last with rho = 0.
std::vector<double> correlation_steps(std::span<const ModelStatistics> models, const std::vector<std::size_t>& chosen)
{
    std::vector<double> steps;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const double rho = models[chosen[i]].rho, next = i + 1 < chosen.size() ? models[chosen[i + 1]].rho : 0.0;
        steps.push_back(rho * rho - next * next);
    }
    return steps;
}

bool admissible(std::span<const ModelStatistics> models, const std::vector<std::size_t>& chosen,
                const std::vector<double>& steps)
{
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!(steps[i] > 0.0)) return false;
        if (i > 0 && !(models[chosen[i - 1]].cost / models[chosen[i]].cost > steps[i - 1] / steps[i])) return false;
    }
    return true;
}

MfmcPlan sized(std::span<const ModelStatistics> models, std::vector<std::size_t> chosen,
               const std::vector<double>& steps, double budget)
{
    MfmcPlan plan;
    const double w1 = models[0].cost;
    double cost = 0.0, root = 0.0;
    std::vector<double> r;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const ModelStatistics& m = models[chosen[i]];
        r.push_back(std::sqrt(w1 * steps[i] / (m.cost * steps[0])));
        cost += m.cost * r.back();
        root += std::sqrt(m.cost / w1 * steps[i]);
        plan.weights.push_back(m.rho * models[0].sigma / m.sigma);
    }
    plan.weights[0] = 1.0;
    const double m1 = budget / cost;
    for (const double ratio : r) plan.sizes.push_back(static_cast<std::uint64_t>(ratio * m1 * (1.0 + 1e-12)));
    plan.ratio = root * root;
    plan.models = std::move(chosen);
    plan.variance = plan.sizes[0] > 0 ? mfmc_variance(models, plan) : std::numeric_limits<double>::infinity();
    return plan;
}

void check_models(std::span<const ModelStatistics> models, double budget)
{
    if (models.empty() || models.size() > 16)
        throw ParameterError("models", fmt::format("{}", models.size()), "1 to 16");
    for (std::size_t i = 0; i < models.size(); ++i) {
        const ModelStatistics& m = models[i];
        if (!(m.cost > 0.0)) throw ParameterError("cost", shortest(m.cost), "seconds > 0");
        if (!(m.sigma > 0.0)) throw ParameterError("sigma", shortest(m.sigma), "a number > 0");
        if (i > 0 && !(std::abs(m.rho) < 1.0)) throw ParameterError("rho", shortest(m.rho), "-1 < rho < 1");
    }
    if (!(budget >= models[0].cost))
        throw ParameterError("budget", shortest(budget), fmt::format("one run at least, {:g} s", models[0].cost));
}

} // namespace

double mfmc_variance(std::span<const ModelStatistics> models, const MfmcPlan& plan)
{
    const double sigma = models[plan.models[0]].sigma;
    double variance = sigma * sigma / static_cast<double>(plan.sizes[0]);
    for (std::size_t i = 1; i < plan.models.size(); ++i) {
        const ModelStatistics& m = models[plan.models[i]];
        const double a = plan.weights[i] * m.sigma;
        variance += (1.0 / static_cast<double>(plan.sizes[i - 1]) - 1.0 / static_cast<double>(plan.sizes[i])) *
                    (a * a - 2.0 * a * m.rho * sigma);
    }
    return variance;
}

MfmcPlan plan_mfmc(std::span<const ModelStatistics> given, double budget)
{
    check_models(given, budget);
    std::vector<ModelStatistics> models(given.begin(), given.end());
    models[0].rho = 1.0;
    MfmcPlan best;
    best.variance = std::numeric_limits<double>::infinity();
    for (std::uint32_t mask = 0; mask < 1u << (models.size() - 1); ++mask) {
        std::vector<std::size_t> chosen{0};
        for (std::size_t i = 1; i < models.size(); ++i)
            if (mask >> (i - 1) & 1u) chosen.push_back(i);
        std::stable_sort(chosen.begin() + 1, chosen.end(), [&](std::size_t a, std::size_t b) {
            return std::abs(models[a].rho) > std::abs(models[b].rho);
        });
        const std::vector<double> steps = correlation_steps(models, chosen);
        if (!admissible(models, chosen, steps)) continue;
        MfmcPlan plan = sized(models, std::move(chosen), steps, budget);
        if (plan.variance < best.variance) best = std::move(plan);
    }
    return best; // the dear model alone is always admissible
}

double mfmc_estimate(const MfmcPlan& plan, std::span<const std::vector<double>> answers)
{
    const auto mean = [&](std::size_t j, std::uint64_t size) {
        if (answers[j].size() < size)
            throw ParameterError("answers", fmt::format("{}", answers[j].size()),
                                 fmt::format("{} of model {}", size, j));
        double sum = 0.0;
        for (std::uint64_t s = 0; s < size; ++s) sum += answers[j][s];
        return sum / static_cast<double>(size);
    };
    double estimate = mean(0, plan.sizes[0]);
    for (std::size_t j = 1; j < plan.models.size(); ++j)
        estimate += plan.weights[j] * (mean(j, plan.sizes[j]) - mean(j, plan.sizes[j - 1]));
    return estimate;
}

MfmcEstimate mfmc_with_error(const MfmcPlan& plan, std::span<const std::vector<double>> answers, double confidence)
{
    const std::size_t models = plan.models.size();
    MfmcEstimate e;
    e.p = mfmc_estimate(plan, answers);
    std::vector<double> of_dear; // what the samples of the dear model add
    double variance = 0.0, variance_of_dear = 0.0;
    for (std::size_t group = 0; group < models; ++group) { // samples m_(group-1) ... m_group - 1
        const std::uint64_t first = group > 0 ? plan.sizes[group - 1] : 0, last = plan.sizes[group];
        std::vector<double> added;
        for (std::uint64_t s = first; s < last; ++s) {
            double c = 0.0;
            for (std::size_t i = group; i < models; ++i) {
                const double own = plan.weights[i] * answers[i][s],
                             next = i + 1 < models ? plan.weights[i + 1] * answers[i + 1][s] : 0.0;
                c += (own - next) / static_cast<double>(plan.sizes[i]);
            }
            added.push_back(c);
        }
        const double part = static_cast<double>(added.size()) * variance_of(added);
        variance += part;
        if (group > 0) continue;
        variance_of_dear = part;
        of_dear = std::move(added);
    }
    const auto n = static_cast<double>(plan.sizes[0]);
    e.se = std::sqrt(variance);
    e.degrees = variance_of_dear > 0.0 ? degrees_of_variance(of_dear) * std::pow(variance / variance_of_dear, 2)
                                       : std::max(1.0, n - 1.0);
    e.printed = std::clamp(e.p, 0.0, 1.0);
    e.interval = wilson_of_estimate(e.p, e.se, n, e.degrees, confidence);
    return e;
}

} // namespace damslip::probability
