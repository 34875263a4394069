#include "probability/estimate/calibration.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::probability {

namespace {

bool run_is_missing(const std::vector<double>& cheap)
{
    return std::any_of(cheap.begin(), cheap.end(), [](double v) { return !std::isfinite(v); });
}

} // namespace

double Calibration::operator()(const std::vector<double>& cheap) const
{
    return fitted && !run_is_missing(cheap) ? fit.probability(cheap) : constant;
}

Calibration calibrate(std::span<const std::vector<double>* const> cheap, std::span<const double> of_dear)
{
    Calibration h;
    std::vector<double> x, f, ones;
    double sum = 0.0;
    for (std::size_t i = 0; i < cheap.size(); ++i) {
        sum += of_dear[i];
        if (run_is_missing(*cheap[i])) continue;
        x.insert(x.end(), cheap[i]->begin(), cheap[i]->end());
        f.push_back(of_dear[i]);
        ones.push_back(1.0);
    }
    if (!cheap.empty()) h.constant = sum / static_cast<double>(cheap.size());
    if (f.size() < 3) return h;
    h.fit = fit_binary(Link::logit, Penalty::firth, x, ones, f);
    h.fitted =
        std::all_of(h.fit.coefficients.begin(), h.fit.coefficients.end(), [](double c) { return std::isfinite(c); });
    return h;
}

double mean_of(std::span<const double> values)
{
    double sum = 0.0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

double variance_of(std::span<const double> values)
{
    if (values.size() < 2) return 0.0;
    const double mean = mean_of(values);
    double sum = 0.0;
    for (const double v : values) sum += (v - mean) * (v - mean);
    return sum / static_cast<double>(values.size() - 1);
}

double degrees_of_variance(std::span<const double> values)
{
    const double n = static_cast<double>(values.size()), mean = mean_of(values);
    double second = 0.0, fourth = 0.0;
    for (const double v : values) {
        const double square = (v - mean) * (v - mean);
        second += square / n;
        fourth += square * square / n;
    }
    const double excess = fourth / (second * second) - 1.0;
    return excess > 0.0 ? std::clamp(2.0 * n / excess, 3.0, std::max(3.0, n - 1.0)) : std::max(3.0, n - 1.0);
}

} // namespace damslip::probability
