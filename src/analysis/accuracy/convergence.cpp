#include "analysis/accuracy/convergence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip {

std::optional<double> observed_order(std::span<const double> values, double ratio)
{
    if (values.size() < 3) return std::nullopt;
    const auto last = values.last(3);
    const double differences[] = {last[1] - last[0], last[2] - last[1]};
    return order_of_errors(differences, ratio);
}

std::optional<double> order_of_errors(std::span<const double> errors, double ratio)
{
    assert(ratio > 1.0);
    if (errors.size() < 2) return std::nullopt;
    const double before = std::abs(errors[errors.size() - 2]), now = std::abs(errors.back());
    if (!(before > 0.0 && now > 0.0)) return std::nullopt;
    return std::log(before / now) / std::log(ratio);
}

std::optional<Limit> extrapolated(std::span<const double> values, double ratio, const std::optional<double>& elsewhere)
{
    if (values.size() < 2) return std::nullopt;
    const double difference = values.back() - values[values.size() - 2];
    Limit limit;
    limit.order = observed_order(values, ratio);
    const std::optional<double> shown = values.size() > 2 ? limit.order : elsewhere;
    const double order = std::clamp(shown.value_or(least_order), least_order, largest_order);
    limit.correction = difference / (std::pow(ratio, order) - 1.0);
    limit.value = values.back() + limit.correction;
    return limit;
}

} // namespace damslip
