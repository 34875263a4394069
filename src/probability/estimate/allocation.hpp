#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// What to spend on which samples, decided before they are run.
namespace damslip::probability {

/// Whether a pilot shows that the cheap model pays.
struct PilotDecision {
    bool use = false;
    double rho = 0.0;
    double rho_lower = 0.0,
           rho_upper = 0.0;      ///< 90 % interval by Fisher's z = atanh(rho), standard error 1 / sqrt(n - 3)
    double speed_up = 1.0;       ///< variance of plain Monte Carlo over that of both models, at rho
    double speed_up_lower = 1.0; ///< at the end of the interval with the smaller gain
    std::string sentence;        ///< "off: ρ 0.31 (0.05…0.53), would gain 1.1, 1.0 at least"
};

/// For the same seconds: 1 / [sqrt(1 - rho^2) + sqrt(rho^2 w)]^2, w = cheap / dear cost of a run, where the cheap model is admissible
/// (rho^2 > w (1 - rho^2)); else the best is no further cheap run at all, and what is lost its price beside the dear one: 1 / (1 + w).
double two_level_speed_up(double rho, double cost_dear, double cost_cheap);

/// Used if the gain at the lower end of the 90 % interval of rho exceeds 1.2. A pilot of n < 4 pairs, or of a rho that is no number: not used.
/// @param n  pairs of the pilot
/// @param gain  of a correlation 0 ... 1, growing with it. A negative one gains what 0 does: no weight is negative
PilotDecision decide_on_pilot(std::size_t n, double rho, const std::function<double(double)>& gain);

/// What the use of further cheap samples alone does to the variance, whatever they cost: 1 / (1 - rho^2 N / (n + N)).
/// @param share  N / (n + N), of the cheap samples
double variance_gain(double rho, double share);

/// A correlation found on the samples that a fit of `parameters` (its constant not counted) was made on, less what that fit owes to chance:
/// rho^2 -> 1 - (1 - rho^2) (n - 1) / (n - parameters - 1) (Ezekiel 1930), not below 0.
double less_chance(double rho, std::size_t n, std::size_t parameters);

/// Pearson's correlation; NaN where one of both does not vary.
double correlation(std::span<const double> a, std::span<const double> b);

/// Dear samples n (each with its cheap run) and further cheap ones N, of least variance for the budget [processor s]:
/// (n + N) / n = sqrt(rho^2 c_dear / (c_cheap (1 - rho^2))), at most 1000; n (c_dear + c_cheap) + N c_cheap <= budget.
struct TwoLevelSizes {
    std::uint64_t dear = 0, cheap = 0;
};
TwoLevelSizes two_level_sizes(double budget, double rho, double cost_dear, double cost_cheap);

/// One level of intensity as a stratum of an annual rate.
struct Stratum {
    double weight = 0.0; ///< rate of the earthquakes of this level, Delta H [1/a]
    double z = 0.0;      ///< failures of the pilot ...
    double n = 0.0;      ///< ... of so many runs; 0: none
    double rho = 0.0;    ///< correlation of the cheap model there; 0: none used
    double cost = 1.0;   ///< processor seconds a sample
};

/// Samples of each stratum, n_s proportional to w_s sqrt(p (1 - p) (1 - rho^2) / c_s), p = (z + 1/2) / (n + 1): no stratum gets 0, the costs sum up to
/// at most the budget, but for the `least` samples that every stratum has.
std::vector<std::uint64_t> allocate_strata(std::span<const Stratum> strata, double budget, std::uint64_t least = 1);

/// Size of a batch of variables that need no new set-up: sqrt((c_set / c_run) (1 - ICC) / ICC), at least 1, ICC the share of the variance between
/// set-ups (Cochran 1977, 10.6).
double batch_size(double cost_set_up, double cost_run, double icc);

} // namespace damslip::probability
