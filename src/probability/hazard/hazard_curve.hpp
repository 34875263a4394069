#pragma once

#include <vector>

namespace damslip::probability {

/// Annual rate H(x) of earthquakes with more than the intensity x, log-log between its points.
class HazardCurve {
public:
    /// @throws ParameterError for fewer than 2 points, intensities not > 0 and rising, rates not > 0 or rising
    HazardCurve(std::vector<double> x, std::vector<double> rate);

    const std::vector<double>& x() const { return x_; }
    const std::vector<double>& rate() const { return rate_; }
    double rate_at(double x) const; ///< NaN outside the points
    /// -d ln H / d ln x of the segment between points i and i + 1; >= 0.
    double slope(std::size_t i) const;

private:
    std::vector<double> x_, rate_;
};

} // namespace damslip::probability
