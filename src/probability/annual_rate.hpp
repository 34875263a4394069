#pragma once

#include <optional>
#include <span>
#include <string>
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

/// A part of the rate: earthquakes with intensities from x_lower to x_upper.
struct RatePart {
    double x_lower = 0.0, x_upper = 0.0;
    double rate = 0.0; ///< [1/a]
};

/// lambda = integral of P |dH| [1/a], with bounds for what lies outside: P grows with the intensity, so that it is at most P_a below the lowest
/// intensity a of the integral (0 ... P_a), and at least P_b above the highest, b (P_b ... 1).
struct AnnualRate {
    double inside = 0.0; ///< from a to b: over the points of the curve (and the tested levels, of raw stripes)
    double above_lower = 0.0, above_upper = 0.0; ///< above b: P_b H_b ... H_b
    double below_upper =
        0.0;              ///< below a: 0 ... P_a (H_1 - H_a), H_1 the curve's first rate; nu for H_1 where it is known
    double p_first = 0.0; ///< P_a
    double x_first = 0.0; ///< first point of the curve
    bool all_events =
        true; ///< false: nu is not known and P_a > 0, earthquakes weaker than the curve's first point are not in the bounds
    double lower = 0.0;          ///< inside + above_lower
    double upper = 0.0;          ///< inside + above_upper + below_upper
    double outside_share = 0.0;  ///< of `upper` that stems from outside the tested levels [-]
    bool mostly_tested = true;   ///< outside_share <= 10 %
    std::vector<RatePart> parts; ///< of `inside`, segment by segment
};

/// Of a lognormal fragility, exact on each segment, k = -ln(H_(i+1) / H_i) / ln(x_(i+1) / x_i), z = ln(x / theta) / beta:
///     P_i H_i - P_(i+1) H_(i+1) + H_i (x_i / theta)^k e^(k^2 beta^2 / 2) [Phi(z_(i+1) + k beta) - Phi(z_i + k beta)].
/// beta = 0: H(theta).
/// @param tested_lower, tested_upper  lowest and highest intensity with runs; the part of the rate outside is reported
/// @param nu  annual rate of all earthquakes the curve is made of, if known; >= H_1
/// @throws ParameterError for median not > 0, beta < 0, nu < H_1
AnnualRate annual_rate(const HazardCurve& curve, double median, double beta, double tested_lower, double tested_upper,
                       std::optional<double> nu = {});

/// Of raw stripes: P linear in ln x between them, exact with the curve's segments; outside the stripes, or the curve, the bounds.
/// @param x, p  stripes, rising x; one at least within the curve
/// @param growing  false: P is not known to grow with x, and is 0 ... 1 outside the stripes
AnnualRate annual_rate(const HazardCurve& curve, std::span<const double> x, std::span<const double> p,
                       std::optional<double> nu = {}, bool growing = true);

/// 1 - e^(-rate years), accurate for small ones.
double probability_in(double rate, double years);

/// One limit state of a fragility model.
struct NrmlLimit {
    std::string name;                ///< "slip-50mm": letters, digits, "-" and "_"
    double median = 1.0, beta = 0.4; ///< of a lognormal curve
    std::vector<double> poes;        ///< P at the model's levels, for the discrete form
};

struct NrmlModel {
    std::string id, description;
    std::string imt;               ///< "PGA", "SA(0.3)"
    double no_damage = 0.0;        ///< P = 0 below, unit of the measure (g for PGA and SA)
    std::vector<double> levels;    ///< tested intensities, rising
    std::vector<NrmlLimit> limits; ///< mildest first
};

/// OpenQuake's fragility model, NRML 0.5. format="continuous" shape="logncdf" with mean and standard deviation of x (not of ln x),
/// mean = theta e^(beta^2/2), stddev = mean sqrt(e^(beta^2) - 1); format="discrete" with P at the levels where limits cross.
/// @throws ParameterError for levels that do not rise, a name that is no word, a discrete limit without its poes
std::string nrml_fragility(const NrmlModel& model);

/// One triangular distribution of the water level at failure.
struct StageTriangle {
    double probability = 0.0;                       ///< of failure [-]
    double min = 0.0, most_likely = 0.0, max = 0.0; ///< stage [m]
};
struct UsaceLocation {
    std::string location;
    std::vector<StageTriangle> stages; ///< rising probability
};

/// The file of the USACE library fragility-curves: probability over stage. A stage is a water level: for fragility over reservoir.level_m only.
/// @throws ParameterError for probabilities that do not rise, min > most_likely or most_likely > max
std::string usace_fragility(const std::string& name, const std::vector<UsaceLocation>& locations);

} // namespace damslip::probability
