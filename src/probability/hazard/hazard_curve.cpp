#include "probability/hazard/hazard_curve.hpp"

#include "core/number.hpp"
#include "probability/laws/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace damslip::probability {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

} // namespace

HazardCurve::HazardCurve(std::vector<double> x, std::vector<double> rate) : x_(std::move(x)), rate_(std::move(rate))
{
    if (x_.size() != rate_.size() || x_.size() < 2)
        throw ParameterError("points", fmt::format("{}, {}", x_.size(), rate_.size()), "two at least, a rate for each");
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (!(x_[i] > (i ? x_[i - 1] : 0.0)) || !std::isfinite(x_[i]))
            throw ParameterError("x", shortest(x_[i]), "intensities > 0 that rise");
        if (!(rate_[i] > 0.0) || !std::isfinite(rate_[i]) || (i && rate_[i] > rate_[i - 1]))
            throw ParameterError("rate", shortest(rate_[i]), "rates > 0 that never rise");
    }
}

double HazardCurve::slope(std::size_t i) const
{
    return -std::log(rate_[i + 1] / rate_[i]) / std::log(x_[i + 1] / x_[i]);
}

double HazardCurve::rate_at(double x) const
{
    if (!(x >= x_.front() && x <= x_.back())) return not_a_number;
    const std::size_t above = static_cast<std::size_t>(std::lower_bound(x_.begin(), x_.end(), x) - x_.begin());
    if (x_[above] == x) return rate_[above];
    return rate_[above - 1] * std::pow(x / x_[above - 1], -slope(above - 1));
}

} // namespace damslip::probability
