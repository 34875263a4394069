#pragma once

#include "probability/estimate/allocation.hpp"
#include "probability/fit/interval.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace damslip::probability {

/// A sample of the dear model with the cheap model's answer to the same draws.
struct DearSample {
    std::size_t cluster = 0; ///< what it shares with others: the event of its record; else a number of its own
    double f = 0.0;          ///< 1[D > d], or a weighted share of a batch, 0 ... 1
    std::vector<double>
        cheap; ///< what predicts f: asinh(D_cheap / d), a_y / PGA, ...; one NaN: the cheap run is missing
};

/// A sample of the cheap model alone. Draws of its own: none is also a dear sample.
struct CheapSample {
    std::size_t cluster = 0;
    std::vector<double> cheap;
};

struct TwoLevelFold {
    std::size_t n = 0, cheap = 0; ///< dear samples n_k, cheap ones N_k
    double alpha = 0.0;           ///< weight of the cheap model, fitted without the fold; 0: not used there
    PilotDecision decision;       ///< of the samples outside the fold, less_chance(); gain: that of the variance
};

struct TwoLevelEstimate {
    double p = 0.0;       ///< as it is: may lie outside 0 ... 1
    double printed = 0.0; ///< clipped to 0 ... 1
    bool clipped = false;
    double se = 0.0;       ///< standard error
    double degrees = 0.0;  ///< of freedom of `se`
    double n_eff = 0.0;    ///< p (1 - p) / se^2, at most 20 n
    Interval interval;     ///< Wilson with n_eff
    double rho = 0.0;      ///< correlation of f and g on the samples g was not trained on
    double plain_se = 0.0; ///< of the mean of the n dear samples alone
    bool used = false;     ///< by one fold at least; else `p` is the mean of the n dear samples alone
    std::string
        sentence; ///< where not used, that of the fold nearest to paying: "off: ρ 0.31 (0.05…0.53), would gain 1.1, 1.0 at least"
    std::vector<TwoLevelFold> folds;
};

/// P by two models, cross-fitted: g = h(cheap) is a logit of P(f = 1 | cheap) with Firth's penalty; for each of K folds of clusters h_k and
/// alpha_k are fitted without the fold, and
///     p = (1/n) sum_k sum_(i in k) [f_i - alpha_k g_k(i)] + sum_k (n_k/n) alpha_k mean of g_k over the N_k cheap samples of the fold,
///     alpha = clip(cov(f, g) / var(g) N / (n + N), 0, 1),   se^2 = s^2(f - alpha g) / n + sum_k (n_k/n)^2 alpha_k^2 s^2(g_k) / N_k.
/// The residuals f - alpha g are few surprises among many zeros: where by chance few were met, se is too small. The interval therefore takes the
/// quantile of Student's t with 2 n / (kurtosis - 1) degrees of freedom of their variance (Satterthwaite 1946), combined with the exact rest.
///
/// Unbiased for any h: no g_k meets a sample it was trained on. A fold without cheap samples has alpha = 0. So has one whose pilot, the samples
/// outside it, does not show that the cheap model pays (decide_on_pilot(), variance_gain()): that does not see the fold either, and adds no bias.
/// A cluster's share of the dear and of the cheap samples has to be the same on average, as with RecordDraw.
/// @throws ParameterError for n < 2, f outside 0 ... 1, features of unequal number
TwoLevelEstimate two_level(std::span<const DearSample> dear, std::span<const CheapSample> cheap, std::uint64_t seed,
                           std::size_t folds = 5, double confidence = 0.95);

/// Wilson's interval of n_eff = p (1 - p) / se^2 trials, at most 20 n, with the quantile of Student's t. At p <= 0 or >= 1, where that is no number
/// of trials, p is taken at 1 / (2 n) from the end.
/// @param degrees  of freedom of se, n - 1 of independent samples with normal errors
Interval wilson_of_estimate(double p, double se, double n, double degrees, double confidence = 0.95,
                            double* n_eff = nullptr);

} // namespace damslip::probability
