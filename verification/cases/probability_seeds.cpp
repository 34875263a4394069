#include "verification/cases/probability_seeds.hpp"

#include "core/parallel.hpp"
#include "probability/estimate/multi_fidelity.hpp"
#include "probability/estimate/two_level.hpp"
#include "probability/laws/normal.hpp"
#include "probability/sampling/draws.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace damslip::verification {

namespace {

using namespace damslip::probability;

/// Sums over seeds.
class SeedSums {
public:
    explicit SeedSums(double exact) { study_.exact = exact; }

    void add(double estimate, double se, const Interval& interval)
    {
        ++study_.seeds;
        sum_ += estimate;
        squares_ += estimate * estimate;
        errors_ += se * se;
        const bool covers = interval.contains(study_.exact);
        study_.covered += covers;
        if (study_.seeds <= SeedStudy::few) study_.covered_of_few += covers;
    }

    SeedStudy study()
    {
        const double n = study_.seeds;
        study_.mean = sum_ / n;
        study_.sd = std::sqrt((squares_ - n * study_.mean * study_.mean) / (n - 1.0));
        study_.mean_se = std::sqrt(errors_ / n);
        return study_;
    }

private:
    SeedStudy study_;
    double sum_ = 0.0, squares_ = 0.0, errors_ = 0.0;
};

constexpr double record_share = 0.5, model_scatter = 0.3, mean_log_slip = -1.2;

/// Effects of the ten records: quantiles of the normal distribution at the middles of tenths.
double record_effect(std::size_t record)
{
    return normal_quantile((static_cast<double>(record) + 0.5) / 10.0);
}

/// Draws of one sample.
class SlipDraws {
public:
    SlipDraws(std::uint64_t seed, SuiteOf suite, CheapModel cheap)
        : suite_(suite), cheap_(cheap), own_(seed, "own"), record_(seed, "record"), scatter_(seed, "scatter"),
          draw_(RecordOrder::balanced, seed, 10)
    {
    }

    std::size_t cluster(std::uint32_t i) const { return suite_ == SuiteOf::ten_records ? draw_(i) : i; }

    double log_slip(std::uint32_t i) const
    {
        const double record =
            suite_ == SuiteOf::ten_records ? record_effect(draw_(i)) : normal_quantile(record_.uniform(i));
        return mean_log_slip + std::sqrt(1.0 - record_share) * normal_quantile(own_.uniform(i)) +
               std::sqrt(record_share) * record;
    }

    std::vector<double> cheap(std::uint32_t i) const
    {
        const double scatter = normal_quantile(scatter_.uniform(i));
        return {cheap_ == CheapModel::good ? log_slip(i) + model_scatter * scatter : scatter};
    }

private:
    SuiteOf suite_;
    CheapModel cheap_;
    Stream own_, record_, scatter_;
    RecordDraw draw_;
};

double exact_p(SuiteOf suite)
{
    if (suite == SuiteOf::all_records) return normal_cdf(mean_log_slip);
    double p = 0.0;
    for (std::size_t r = 0; r < 10; ++r)
        p += normal_cdf((mean_log_slip + std::sqrt(record_share) * record_effect(r)) / std::sqrt(1.0 - record_share)) /
             10.0;
    return p;
}

} // namespace

double SeedStudy::bound() const
{
    return 4.0 * sd / std::sqrt(static_cast<double>(seeds));
}

SeedStudy study_two_level(int seeds, int n, CheapModel cheap, SuiteOf suite)
{
    std::vector<TwoLevelEstimate> estimates(static_cast<std::size_t>(seeds));
    parallel_for(estimates.size(), 0, [&](std::size_t seed) {
        const SlipDraws draws(seed + 1000, suite, cheap);
        std::vector<DearSample> dear;
        std::vector<CheapSample> further;
        const std::uint32_t size = static_cast<std::uint32_t>(n);
        for (std::uint32_t i = 0; i < size; ++i)
            dear.push_back({draws.cluster(i), draws.log_slip(i) > 0.0 ? 1.0 : 0.0, draws.cheap(i)});
        for (std::uint32_t i = size; i < 11 * size; ++i) further.push_back({draws.cluster(i), draws.cheap(i)});
        estimates[seed] = two_level(dear, further, seed);
    });
    SeedSums sums(exact_p(suite));
    for (const TwoLevelEstimate& e : estimates) sums.add(e.p, e.se, e.interval);
    return sums.study();
}

SeedStudy study_mfmc(int seeds, double* variance_by_formula)
{
    const std::array<ModelStatistics, 3> models{{{1.0, 1.0, 1.0}, {0.05, 2.0, 0.95}, {0.002, 0.5, 0.8}}};
    const MfmcPlan plan = plan_mfmc(models, 40.0);
    if (variance_by_formula) *variance_by_formula = mfmc_variance(models, plan);
    SeedSums sums(0.0);
    for (int seed = 0; seed < seeds; ++seed) {
        const Stream x(static_cast<std::uint64_t>(seed), "x"), e1(static_cast<std::uint64_t>(seed), "e1"),
            e2(static_cast<std::uint64_t>(seed), "e2");
        std::vector<std::vector<double>> answers(plan.models.size());
        for (std::size_t j = 0; j < plan.models.size(); ++j)
            for (std::uint32_t i = 0; i < plan.sizes[j]; ++i) {
                const ModelStatistics& m = models[plan.models[j]];
                const double z = normal_quantile(x.uniform(i));
                const double other = plan.models[j] == 0   ? 0.0
                                     : plan.models[j] == 1 ? normal_quantile(e1.uniform(i))
                                                           : normal_quantile(e2.uniform(i));
                answers[j].push_back(m.sigma * (m.rho * z + std::sqrt(1.0 - m.rho * m.rho) * other));
            }
        sums.add(mfmc_estimate(plan, answers), std::sqrt(mfmc_variance(models, plan)), {0.0, 0.0});
    }
    return sums.study();
}

} // namespace damslip::verification
