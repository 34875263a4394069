#include "probability/estimate/two_level.hpp"

#include "core/number.hpp"
#include "probability/estimate/calibration.hpp"
#include "probability/laws/distribution.hpp"
#include "probability/sampling/permutation.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <map>

namespace damslip::probability {

namespace {

/// h of the samples outside one fold.
Calibration calibrate_on(const std::vector<const DearSample*>& training)
{
    std::vector<const std::vector<double>*> cheap;
    std::vector<double> f;
    for (const DearSample* s : training) {
        cheap.push_back(&s->cheap);
        f.push_back(s->f);
    }
    return calibrate(cheap, f);
}

/// Whether g pays with N further cheap samples, and its best weight, both from samples outside the fold.
struct ControlWeight {
    double alpha = 0.0;
    PilotDecision decision;
};
ControlWeight control_weight(const Calibration& h, const std::vector<const DearSample*>& training, double n,
                             double cheap)
{
    ControlWeight control;
    std::vector<double> f, g;
    for (const DearSample* s : training) {
        f.push_back(s->f);
        g.push_back(h(s->cheap));
    }
    const double share = cheap / (n + cheap), variance = variance_of(g);
    const double rho = variance > 0.0 ? less_chance(correlation(f, g), f.size(), training.front()->cheap.size()) : 0.0;
    control.decision = decide_on_pilot(f.size(), rho, [share](double r) { return variance_gain(r, share); });
    if (!control.decision.use) return control;
    const double mean_f = mean_of(f), mean_g = mean_of(g);
    double covariance = 0.0;
    for (std::size_t i = 0; i < f.size(); ++i)
        covariance += (f[i] - mean_f) * (g[i] - mean_g) / static_cast<double>(f.size() - 1);
    control.alpha = std::clamp(covariance / variance * share, 0.0, 1.0);
    return control;
}

/// What the fold nearest to paying says, where none pays.
std::string why_off(const std::vector<TwoLevelFold>& folds)
{
    const TwoLevelFold& nearest = *std::ranges::max_element(
        folds, {}, [](const TwoLevelFold& f) { return f.decision.sentence.empty() ? 0.0 : f.decision.speed_up_lower; });
    return nearest.decision.sentence.empty() ? "off: no further run of the cheap model" : nearest.decision.sentence;
}

/// Fold of each cluster: clusters in the order of their numbers, dealt out by a random permutation.
std::map<std::size_t, std::size_t> folds_of_clusters(std::span<const DearSample> dear,
                                                     std::span<const CheapSample> cheap, std::uint64_t seed,
                                                     std::size_t folds)
{
    // Those with dear samples are dealt out first, so that the folds share these evenly.
    std::map<std::size_t, std::size_t> fold;
    for (const DearSample& s : dear) fold.emplace(s.cluster, 0);
    const auto deal = [&](std::map<std::size_t, std::size_t>& clusters, std::uint32_t block) {
        const std::vector<std::uint32_t> order =
            permutation(Stream(seed, "folds of clusters"), static_cast<std::uint32_t>(clusters.size()), block);
        std::size_t k = 0;
        for (auto& [cluster, of] : clusters) of = order[k++] % folds;
    };
    deal(fold, 0);
    std::map<std::size_t, std::size_t> others;
    for (const CheapSample& s : cheap)
        if (!fold.contains(s.cluster)) others.emplace(s.cluster, 0);
    deal(others, 1);
    fold.merge(others);
    return fold;
}

void check_samples(std::span<const DearSample> dear, std::span<const CheapSample> cheap)
{
    if (dear.size() < 2)
        throw ParameterError("samples", fmt::format("{}", dear.size()), "2 of the dear model at least");
    for (const DearSample& s : dear) {
        if (!(s.f >= 0.0 && s.f <= 1.0)) throw ParameterError("f", shortest(s.f), "0 to 1");
        if (s.cheap.size() != dear.front().cheap.size() || s.cheap.empty())
            throw ParameterError("cheap", fmt::format("{} values", s.cheap.size()),
                                 "as many as the other samples have");
    }
    for (const CheapSample& s : cheap)
        if (s.cheap.size() != dear.front().cheap.size())
            throw ParameterError("cheap", fmt::format("{} values", s.cheap.size()),
                                 "as many as the other samples have");
}

} // namespace

Interval wilson_of_estimate(double p, double se, double n, double degrees, double confidence, double* n_eff)
{
    const double inner = std::clamp(p, 0.5 / n, 1.0 - 0.5 / n); // p (1 - p) of a number of trials is 0 beyond the ends
    const double most = 20.0 * n;
    const double trials = se > 0.0 ? std::min(most, inner * (1.0 - inner) / (se * se)) : most;
    if (n_eff) *n_eff = trials;
    return wilson_by_quantile(std::clamp(p, 0.0, 1.0) * trials, trials,
                              gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, degrees));
}

TwoLevelEstimate two_level(std::span<const DearSample> dear, std::span<const CheapSample> cheap, std::uint64_t seed,
                           std::size_t folds, double confidence)
{
    check_samples(dear, cheap);
    const double n = static_cast<double>(dear.size());
    TwoLevelEstimate e;
    const std::map<std::size_t, std::size_t> fold = folds_of_clusters(dear, cheap, seed, folds);
    std::vector<std::vector<const DearSample*>> inside(folds), outside(folds);
    std::vector<std::vector<const CheapSample*>> further(folds);
    for (const DearSample& s : dear)
        for (std::size_t k = 0; k < folds; ++k) (fold.at(s.cluster) == k ? inside : outside)[k].push_back(&s);
    for (const CheapSample& s : cheap) further[fold.at(s.cluster)].push_back(&s);

    std::vector<double> f, g, residuals;
    double of_cheap = 0.0, variance_of_cheap = 0.0;
    for (std::size_t k = 0; k < folds; ++k) {
        const Calibration h = calibrate_on(outside[k]);
        const double share = static_cast<double>(inside[k].size()) / n;
        TwoLevelFold& part = e.folds.emplace_back(TwoLevelFold{inside[k].size(), further[k].size(), 0.0, {}});
        if (part.cheap > 0 && outside[k].size() > 2) {
            ControlWeight control = control_weight(h, outside[k], n, static_cast<double>(cheap.size()));
            part.alpha = control.alpha;
            part.decision = std::move(control.decision);
        }
        e.used = e.used || part.alpha > 0.0;
        for (const DearSample* s : inside[k]) {
            f.push_back(s->f);
            g.push_back(h(s->cheap));
            residuals.push_back(s->f - part.alpha * g.back());
        }
        if (part.alpha == 0.0 || part.n == 0) continue;
        std::vector<double> g_cheap;
        for (const CheapSample* s : further[k]) g_cheap.push_back(h(s->cheap));
        of_cheap += share * part.alpha * mean_of(g_cheap);
        variance_of_cheap += std::pow(share * part.alpha, 2) * variance_of(g_cheap) / static_cast<double>(part.cheap);
    }
    e.p = mean_of(residuals) + of_cheap;
    const double of_residuals = variance_of(residuals) / n;
    e.se = std::sqrt(of_residuals + variance_of_cheap);
    e.degrees = of_residuals > 0.0 ? degrees_of_variance(residuals) * std::pow(e.se * e.se / of_residuals, 2) : n - 1.0;
    e.plain_se = std::sqrt(variance_of(f) / n);
    e.rho = correlation(f, g);
    if (!e.used) e.sentence = why_off(e.folds);
    e.printed = std::clamp(e.p, 0.0, 1.0);
    e.clipped = e.printed != e.p;
    e.interval = wilson_of_estimate(e.p, e.se, n, e.degrees, confidence, &e.n_eff);
    return e;
}

} // namespace damslip::probability
