#include "sliding/empirical/regression.hpp"

#include "core/status.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::sliding {

double SlipDistribution::below(double d) const
{
    if (median <= 0.0) return 1.0;
    const double z = std::log(d / median);
    const double share = sigma > 0.0 ? standard_normal_cdf(z / sigma) : (z >= 0.0 ? 1.0 : 0.0);
    return zero + (1.0 - zero) * share;
}

// Bisection on ln D between bounds outside of which no member has weight.
double quantile(std::span<const SlipDistribution> mixture, double q)
{
    const auto below = [&](double d) {
        double p = 0.0;
        for (const SlipDistribution& m : mixture) p += m.weight * m.below(d);
        return p;
    };
    double low = 1e300, high = 0.0;
    for (const SlipDistribution& m : mixture)
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

double standard_normal_cdf(double z)
{
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

namespace {

/// The first input that is needed and not there, or not positive (its logarithm is taken; the magnitude's is not).
std::optional<RegressionInput> missing_input(const Regression& regression, const RegressionInputs& inputs)
{
    for (const RegressionInput input : regression.inputs) {
        const std::optional<double> value = value_of(inputs, input);
        const bool usable = value && std::isfinite(*value) && (*value > 0.0 || input == RegressionInput::magnitude);
        if (!usable) return input;
    }
    return std::nullopt;
}

/// "0.05 to 0.3 g", "1 to 2", "0 s".
std::string interval(const ValidityRange& range)
{
    const std::string_view unit = words_of(range.input).unit;
    std::string text = fmt::format("{:.4g}", range.low);
    if (range.high > range.low) text += fmt::format(" to {:.4g}", range.high);
    return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

/// What lies outside its range: "a_c 0.007 g, data 0.02 to 0.4 g; M 8, data 5.3 to 7.6"; empty: nothing does.
std::string outside_ranges(const Regression& regression, const RegressionInputs& inputs)
{
    std::string text;
    for (const ValidityRange& range : regression.validity) {
        const std::optional<double> value = value_of(inputs, range.input);
        if (!value || (*value >= range.low && *value <= range.high)) continue; // not given: the formula does without it
        const RegressionInputWords& words = words_of(range.input);
        text += fmt::format("{}{} {:.4g}{}{}, data {}", text.empty() ? "" : "; ", words.symbol, *value,
                            words.unit.empty() ? "" : " ", words.unit, interval(range));
    }
    return text;
}

/// Median and band with P(D = 0) counted: quantiles of zero or log-normal.
void count_zero(const Regression& regression, RegressionResult& result)
{
    const double to_natural = regression.logarithm == Logarithm::decimal ? std::numbers::ln10 : 1.0;
    const SlipDistribution d[] = {
        {1.0, *result.zero_probability, *result.nonzero_median_cm, result.sigma * to_natural}};
    result.minus_sd_cm = quantile(d, standard_normal_cdf(-1.0));
    result.median_cm = quantile(d, 0.5);
    result.plus_sd_cm = quantile(d, standard_normal_cdf(1.0));
}

/// @param demand  [g], which the yield acceleration reaches
RegressionResult no_slip(RegressionResult result, const RegressionInputs& inputs, double demand,
                         std::string_view symbol)
{
    result.status = RegressionStatus::no_slip;
    result.median_cm = result.minus_sd_cm = result.plus_sd_cm = 0.0;
    result.remark = fmt::format("a_c {:.4g} g, {} {:.4g} g", inputs.yield_coefficient, symbol, demand);
    return result;
}

} // namespace

double peak_of_ground(const RegressionInputs& inputs)
{
    return inputs.pga_g;
}

const RegressionInputWords& words_of(RegressionInput input)
{
    static constexpr std::array words{RegressionInputWords{"yield acceleration", "a_c", "g"},
                                      RegressionInputWords{"PGA", "PGA", "g"},
                                      RegressionInputWords{"Arias intensity", "I_a", "m/s"},
                                      RegressionInputWords{"PGV", "PGV", "cm/s"},
                                      RegressionInputWords{"mean period", "T_m", "s"},
                                      RegressionInputWords{"magnitude", "M", ""},
                                      RegressionInputWords{"period", "T_s", "s"},
                                      RegressionInputWords{"response spectrum", "S_a(1.3 T_s)", "g"},
                                      RegressionInputWords{"response spectrum", "S_a(1.5 T_s)", "g"},
                                      RegressionInputWords{"cycle count", "N_eq", ""},
                                      RegressionInputWords{"ratio", "a_c/PGA", ""}};
    static_assert(words.size() == static_cast<std::size_t>(RegressionInput::ratio) + 1);
    return words[static_cast<std::size_t>(input)];
}

std::optional<double> value_of(const RegressionInputs& inputs, RegressionInput input)
{
    switch (input) {
    case RegressionInput::yield_coefficient:
        return inputs.yield_coefficient;
    case RegressionInput::pga:
        return inputs.pga_g;
    case RegressionInput::arias_intensity:
        return inputs.arias_m_s;
    case RegressionInput::pgv:
        return inputs.pgv_cm_s;
    case RegressionInput::mean_period:
        return inputs.mean_period_s;
    case RegressionInput::magnitude:
        return inputs.magnitude;
    case RegressionInput::period:
        return inputs.period_s;
    case RegressionInput::spectral_13:
        return inputs.sa_13_g;
    case RegressionInput::spectral_15:
        return inputs.sa_15_g;
    case RegressionInput::cycles:
        return inputs.cycles;
    case RegressionInput::ratio:
        return inputs.pga_g > 0.0 ? std::optional(inputs.ratio()) : std::nullopt;
    }
    return std::nullopt;
}

const Regression* find_regression(std::string_view id)
{
    for (const Regression& regression : regressions())
        if (regression.id == id) return &regression;
    return nullptr;
}

bool valid(const RegressionResult& result)
{
    return result.status == RegressionStatus::ok || result.status == RegressionStatus::no_slip;
}

std::string reason(const RegressionResult& result)
{
    switch (result.status) {
    case RegressionStatus::ok:
        return "valid";
    case RegressionStatus::no_slip:
        return "no slip expected";
    case RegressionStatus::outside_range:
        return std::string(outside_its_range);
    case RegressionStatus::static_sliding:
        return word(Status::static_failure);
    case RegressionStatus::missing_input:
        return "needs " + result.remark;
    }
    return "";
}

RegressionResult evaluate(const Regression& regression, const RegressionInputs& inputs)
{
    RegressionResult result;
    result.regression = &regression;
    if (!(inputs.yield_coefficient > 0.0)) {
        result.status = RegressionStatus::static_sliding;
        result.remark = "slides without an earthquake";
        return result;
    }
    // Where a_c reaches the ground's peak a rigid block does not move, whether or not the other inputs are there.
    const bool rigid = regression.demand == peak_of_ground;
    if (rigid && inputs.yield_coefficient >= inputs.pga_g) return no_slip(result, inputs, inputs.pga_g, "PGA");
    if (const auto missing = missing_input(regression, inputs)) {
        result.status = RegressionStatus::missing_input;
        result.remark = words_of(*missing).name;
        return result;
    }
    if (!rigid && regression.demand && inputs.yield_coefficient >= regression.demand(inputs))
        return no_slip(result, inputs, regression.demand(inputs), "k_max");
    const double log_median = regression.log_median(inputs);
    const auto displacement = [&](double log_d) {
        return regression.logarithm == Logarithm::decimal ? std::pow(10.0, log_d) : std::exp(log_d);
    };
    result.median_cm = result.nonzero_median_cm = displacement(log_median);
    if (regression.sigma) {
        result.sigma = regression.sigma(inputs);
        result.minus_sd_cm = displacement(log_median - result.sigma);
        result.plus_sd_cm = displacement(log_median + result.sigma);
    }
    if (regression.zero_probability) {
        result.zero_probability = regression.zero_probability(inputs);
        count_zero(regression, result);
    }
    result.remark = outside_ranges(regression, inputs);
    if (!result.remark.empty()) result.status = RegressionStatus::outside_range;
    return result;
}

std::vector<RegressionResult> evaluate_all(const RegressionInputs& inputs)
{
    std::vector<RegressionResult> results;
    for (const Regression& regression : regressions()) results.push_back(evaluate(regression, inputs));
    return results;
}

double failure_probability_jibson_1998(double displacement_cm)
{
    return displacement_cm > 0.0 ? 0.335 * -std::expm1(-0.048 * std::pow(displacement_cm, 1.565)) : 0.0;
}

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
    ensemble.low_cm = quantile(members, standard_normal_cdf(-1.0));
    ensemble.high_cm = quantile(members, standard_normal_cdf(1.0));
    return ensemble;
}

} // namespace damslip::sliding
