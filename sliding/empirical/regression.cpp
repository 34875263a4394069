#include "sliding/empirical/regression.hpp"

#include "core/number.hpp"

#include <cmath>

namespace damslip::sliding {
namespace {

/// Inputs that are needed and not there, or not positive (their logarithm is taken; the magnitude's is not).
std::vector<std::string> missing_inputs(const Regression& regression, const RegressionInputs& inputs)
{
    std::vector<std::string> missing;
    for (const RegressionInput input : regression.inputs) {
        const std::optional<double> value = value_of(inputs, input);
        const bool usable = value && std::isfinite(*value) && (*value > 0.0 || input == RegressionInput::magnitude);
        if (!usable) missing.push_back(std::string(regression.name) + " needs " + std::string(name_of(input)) + ".");
    }
    return missing;
}

void warn_outside_validity(const Regression& regression, const RegressionInputs& inputs, RegressionResult& result)
{
    for (const ValidityRange& range : regression.validity) {
        const std::optional<double> given = value_of(inputs, range.input);
        if (!given) continue; // an input the formula does without
        const double value = *given;
        if (value >= range.low && value <= range.high) continue;
        result.within_range = false;
        result.warnings.push_back(std::string(regression.name) + ": " + std::string(name_of(range.input)) + " = " +
                                  shortest(value) + " is outside the range of its data, " + shortest(range.low) +
                                  " to " + shortest(range.high) + ".");
    }
}

RegressionResult no_slip(RegressionResult result, std::string_view demand)
{
    result.status = RegressionStatus::no_slip;
    result.median_cm = result.minus_sd_cm = result.plus_sd_cm = 0.0;
    result.warnings.push_back("Yield acceleration at or above the " + std::string(demand) +
                              ": D = 0, the regression is undefined there.");
    return result;
}

} // namespace

double peak_of_ground(const RegressionInputs& inputs)
{
    return inputs.pga_g;
}

std::string_view name_of(RegressionInput input)
{
    switch (input) {
    case RegressionInput::yield_coefficient:
        return "yield acceleration [g]";
    case RegressionInput::pga:
        return "peak ground acceleration [g]";
    case RegressionInput::arias_intensity:
        return "Arias intensity [m/s]";
    case RegressionInput::pgv:
        return "peak ground velocity [cm/s]";
    case RegressionInput::mean_period:
        return "mean period [s]";
    case RegressionInput::magnitude:
        return "moment magnitude";
    case RegressionInput::period:
        return "period of the sliding mass [s]";
    case RegressionInput::spectral_13:
        return "spectral acceleration at 1.3 T_s [g]";
    case RegressionInput::spectral_15:
        return "spectral acceleration at 1.5 T_s [g]";
    case RegressionInput::cycles:
        return "equivalent number of cycles";
    }
    return "";
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
    }
    return std::nullopt;
}

const Regression* find_regression(std::string_view id)
{
    for (const Regression& regression : regressions())
        if (regression.id == id) return &regression;
    return nullptr;
}

RegressionResult evaluate(const Regression& regression, const RegressionInputs& inputs)
{
    RegressionResult result;
    result.regression = &regression;
    if (!(inputs.yield_coefficient > 0.0)) {
        result.status = RegressionStatus::static_sliding;
        result.warnings.push_back(
            "The yield acceleration is not above zero: the block slides without an earthquake, no regression applies.");
        return result;
    }
    // Where a_c reaches the ground's peak a rigid block does not move, whether or not the other inputs are there.
    const bool rigid = regression.demand == peak_of_ground;
    if (rigid && inputs.yield_coefficient >= inputs.pga_g) return no_slip(result, "peak ground acceleration");
    result.warnings = missing_inputs(regression, inputs);
    if (!result.warnings.empty()) {
        result.status = RegressionStatus::missing_input;
        return result;
    }
    if (!rigid && regression.demand && inputs.yield_coefficient >= regression.demand(inputs))
        return no_slip(result, "peak average acceleration of the sliding mass");
    const double log_median = regression.log_median(inputs);
    const auto displacement = [&](double log_d) {
        return regression.logarithm == Logarithm::decimal ? std::pow(10.0, log_d) : std::exp(log_d);
    };
    result.median_cm = displacement(log_median);
    if (regression.sigma) {
        result.sigma = regression.sigma(inputs);
        result.minus_sd_cm = displacement(log_median - result.sigma);
        result.plus_sd_cm = displacement(log_median + result.sigma);
    }
    warn_outside_validity(regression, inputs, result);
    if (regression.zero_probability) {
        result.zero_probability = regression.zero_probability(inputs);
        result.warnings.push_back("P(D = 0) = " + shortest(std::round(1e3 * *result.zero_probability) / 1e3) +
                                  "; D is that of nonzero displacements.");
    }
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

} // namespace damslip::sliding
