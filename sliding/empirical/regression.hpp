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
    cycles
};

/// Name for people, with unit: "Arias intensity [m/s]".
std::string_view name_of(RegressionInput input);

/// The value; nothing where it was not given.
std::optional<double> value_of(const RegressionInputs& inputs, RegressionInput input);

enum class Logarithm { decimal, natural };

/// Interval of an input outside which the authors' data do not reach.
struct ValidityRange {
    RegressionInput input;
    double low, high;
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
    std::vector<ValidityRange> validity; ///< ranges the source states; empty: it states none
    std::string_view data_set;
    std::string_view citation;
    EnsembleUse use = EnsembleUse::estimate;
    double (*demand)(const RegressionInputs&) =
        peak_of_ground; ///< [g]; D = 0 where a_c reaches it. null: no such limit
    double (*zero_probability)(const RegressionInputs&) =
        nullptr; ///< P(D = 0), D above being that of nonzero D; null: none
};

/// All of them, in the order of tables.
std::span<const Regression> regressions();

/// The row of that id; null for none.
const Regression* find_regression(std::string_view id);

enum class RegressionStatus {
    ok,             ///< value and band are given
    no_slip,        ///< r >= 1: D = 0; a rigid block does not move below its yield, and the formula is undefined there
    static_sliding, ///< a_y <= 0: the block slides without an earthquake, no value
    missing_input   ///< see warnings; no value
};

struct RegressionResult {
    const Regression* regression = nullptr;
    RegressionStatus status = RegressionStatus::ok;
    std::optional<double> median_cm;   ///< D [cm]
    std::optional<double> minus_sd_cm; ///< 16 %: one standard deviation below [cm]; none where sigma is not published
    std::optional<double> plus_sd_cm;  ///< 84 %: one standard deviation above [cm]
    double sigma = 0.0;                ///< of log D, in the regression's logarithm; 0 without a value
    std::optional<double> zero_probability; ///< P(D = 0) [-], where the model has one; median and band are of nonzero D
    bool within_range = true;               ///< no input lies outside the validity range
    std::vector<std::string> warnings;      ///< inputs outside their range, missing inputs, D = 0 by definition
};

RegressionResult evaluate(const Regression& regression, const RegressionInputs& inputs);

/// Every regression, in table order.
std::vector<RegressionResult> evaluate_all(const RegressionInputs& inputs);

/// Share of landslides that failed at a computed displacement D [cm], Jibson, Harp & Michael (1998): P = 0.335 (1 - exp(-0.048 D^1.565)).
/// Shallow slides in southern California only; no statement on dams.
double failure_probability_jibson_1998(double displacement_cm);

} // namespace damslip::sliding
