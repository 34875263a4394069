#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Empirical regressions of the sliding displacement of rigid and flexible blocks on a few measures of the ground motion,
/// kept as data: one row each.
namespace damslip::sliding {

/// What a regression may ask for, in the units of the publications. "g" is 9.80665 m/s^2.
struct RegressionInputs {
    double yield_coefficient = 0.0;      ///< a_c = k_y = a_y / g [-]
    double pga_g = 0.0;                  ///< a_max, largest |a_h| [g]
    std::optional<double> arias_m_s;     ///< I_A [m/s]
    std::optional<double> pgv_cm_s;      ///< [cm/s]
    std::optional<double> mean_period_s; ///< T_m of Rathje et al. (1998) [s]
    std::optional<double> magnitude;     ///< moment magnitude M [-]
    std::optional<double> period_s;      ///< T_s, initial fundamental period of the sliding mass [s]; none or 0: rigid
    std::optional<double> sa_13_g;       ///< 5 % pseudo-acceleration at 1.3 T_s [g]; rigid: a_max
    std::optional<double> sa_15_g;       ///< 5 % pseudo-acceleration at 1.5 T_s [g]; rigid: a_max
    std::optional<double> cycles;        ///< N_eq, sine cycles of a_max and T_m with the record's Arias intensity [-]

    double ratio() const { return yield_coefficient / pga_g; } ///< r = a_c / a_max [-]
};

enum class RegressionInput {
    yield_coefficient,
    pga,
    arias_intensity,
    pgv,
    mean_period,
    magnitude,
    period,
    spectral_13,
    spectral_15,
    cycles,
    ratio ///< r = a_c / a_max, never given by itself: for ranges
};

/// How people call it: name "Arias intensity", symbol "I_a", unit "m/s" (empty: none).
struct RegressionInputWords {
    std::string_view name, symbol, unit;
};
const RegressionInputWords& words_of(RegressionInput input);

/// The value; nothing where it was not given.
std::optional<double> value_of(const RegressionInputs& inputs, RegressionInput input);

enum class Logarithm { decimal, natural };

/// Where a range comes from (docs/regressions.md, "Ranges").
enum class RangeSource {
    publication, ///< stated by the authors, in the publication or in the spreadsheet they hand out with it
    data,        ///< the span of the data they name, as others describe it
    assumed      ///< ours, where neither could be had
};

/// Interval of an input outside which the authors' data do not reach.
struct ValidityRange {
    RegressionInput input;
    double low, high;
    RangeSource source = RangeSource::publication;
};

/// Whether a regression counts in an ensemble of equal weights.
enum class EnsembleUse {
    estimate, ///< yes
    on_request ///< only with a weight of its own: an upper bound, another tectonic setting, an input of our own definition
};

/// a_max, the peak demand of a rigid block [g].
double peak_of_ground(const RegressionInputs& inputs);

/// One published regression: log D = f(inputs) +- sigma, D in cm.
struct Regression {
    std::string_view id;      ///< for files: "jibson-1998"
    std::string_view name;    ///< for people: "Jibson et al. 1998"
    std::string_view formula; ///< as published, D in cm, I_a in m/s, a_c and a_max in g, r = a_c/a_max
    Logarithm logarithm;      ///< of D in formula and sigma
    double (*log_median)(const RegressionInputs&);
    double (*sigma)(const RegressionInputs&); ///< standard deviation of log D; null: the source states none
    std::vector<RegressionInput> inputs;
    std::vector<ValidityRange> validity; ///< of all inputs that are given, of those the formula does without too
    std::string_view data_set;
    std::string_view citation;
    EnsembleUse use = EnsembleUse::estimate;
    double (*demand)(const RegressionInputs&) =
        peak_of_ground; ///< [g]; D = 0 where a_c reaches it. null: no such limit
    double (*zero_probability)(const RegressionInputs&) =
        nullptr; ///< P(D = 0), D in log_median and sigma being nonzero D; null: none
};

/// All of them, in the order of tables.
std::span<const Regression> regressions();

/// The row of that id; null for none.
const Regression* find_regression(std::string_view id);

enum class RegressionStatus {
    ok,             ///< value given, all inputs within their ranges
    no_slip,        ///< r >= 1: D = 0; a rigid block does not move below its yield, and the formula is undefined there
    outside_range,  ///< value given, but an input lies outside its range: to be shown, never to be averaged
    static_sliding, ///< a_y <= 0: the block slides without an earthquake, no value
    missing_input   ///< see remark; no value
};

struct RegressionResult {
    const Regression* regression = nullptr;
    RegressionStatus status = RegressionStatus::ok;
    std::optional<double> median_cm;         ///< of D, P(D = 0) counted: 0 where that is a half or more [cm]
    std::optional<double> minus_sd_cm;       ///< 16 % of D, P(D = 0) counted [cm]; none where sigma is not published
    std::optional<double> plus_sd_cm;        ///< 84 %: one standard deviation above where D is never zero [cm]
    std::optional<double> nonzero_median_cm; ///< of D > 0, what the formula gives [cm]; none at no_slip
    double sigma = 0.0;                      ///< of log D > 0, in the regression's logarithm; 0 without a value
    std::optional<double> zero_probability;  ///< P(D = 0) [-], where the model has one
    std::string
        remark; ///< numbers of the status: "a_c 0.007 g, data 0.02 to 0.4 g"; what is missing; empty: nothing to say
};

/// Does it count: a value (D = 0 included) from inputs within their ranges?
bool valid(const RegressionResult& result);

/// reason() of a value to be shown but never averaged.
inline constexpr std::string_view outside_its_range = "outside its range";

/// The status in three words at most: "valid", "no slip expected", "outside its range", "static failure",
/// "needs magnitude".
std::string reason(const RegressionResult& result);

RegressionResult evaluate(const Regression& regression, const RegressionInputs& inputs);

/// Every regression, in table order.
std::vector<RegressionResult> evaluate_all(const RegressionInputs& inputs);

/// Share of landslides that failed at a computed displacement D [cm], Jibson, Harp & Michael (1998): P = 0.335 (1 - exp(-0.048 D^1.565)).
/// Shallow slides in southern California only; no statement on dams.
double failure_probability_jibson_1998(double displacement_cm);

// What the files of rows share (regression_list.cpp puts them together).

template <int per_mille>
double constant_sigma(const RegressionInputs&)
{
    return per_mille / 1000.0;
}

/// c0 + c1 x + c2 x^2 + c3 x^3 + c4 x^4
inline double quartic(double x, double c0, double c1, double c2, double c3, double c4)
{
    return c0 + x * (c1 + x * (c2 + x * (c3 + x * c4)));
}

/// Distribution of a slip D [cm]: D = 0 with a probability of its own, else log-normal. sigma = 0: a step at the median.
struct SlipDistribution {
    double weight; ///< in a mixture; the weights of one sum to 1
    double zero;   ///< P(D = 0)
    double median; ///< of D > 0 [cm]; 0: D = 0 surely
    double sigma;  ///< of ln D

    /// P(D <= d), d > 0 [cm].
    double below(double d) const;
};

/// Smallest D [cm] with P(D' <= D) >= q of the mixture, 0 < q < 1: of one member the (q - P0)/(1 - P0) quantile of its
/// log-normal part, and 0 for q <= P0.
double quantile(std::span<const SlipDistribution> mixture, double q);

/// Distribution function of the standard normal, to round-off in both tails.
double standard_normal_cdf(double z);

/// Weight of one regression, by its id.
struct RegressionWeight {
    std::string id;
    double weight = 1.0; ///< >= 0, relative to the others
};

/// Several regressions as one: each a distribution of D (log-normal with its sigma; a step where none is published; the
/// share P(D = 0) at zero), weighted.
struct Ensemble {
    std::vector<std::string_view> members; ///< ids of the valid ones, in table order
    std::vector<double> weights;           ///< of the members, sum 1
    std::optional<double> median_cm;       ///< of the weighted distribution [cm]; absent without members
    std::optional<double> low_cm, high_cm; ///< its 16 and 84 % [cm]; absent where the only member publishes no sigma
    double weight_left_out = 0.0;          ///< share of the given weights on regressions that are not valid here [-]
};

/// Members are the valid results, see valid(). Without weights: all of EnsembleUse::estimate, equally; with weights:
/// those named with a weight above zero. No valid one: no values.
/// @param results  evaluate_all of one record
/// Precondition: ids known (find_regression), weights finite and not negative.
Ensemble weighted_ensemble(std::span<const RegressionResult> results, std::span<const RegressionWeight> weights = {});

} // namespace damslip::sliding
