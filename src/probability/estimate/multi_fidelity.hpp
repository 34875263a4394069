#pragma once

#include "probability/fit/interval.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace damslip::probability {

/// One model of a hierarchy; the first is the one whose mean is wanted.
struct ModelStatistics {
    double cost = 1.0;  ///< w_i, processor seconds a run
    double sigma = 1.0; ///< standard deviation of its answer
    double rho = 1.0;   ///< correlation with the first model; of the first 1
};

/// Multifidelity Monte Carlo (Peherstorfer, Willcox & Gunzburger 2016).
struct MfmcPlan {
    std::vector<std::size_t> models;  ///< those used, the first model first, falling |rho|
    std::vector<std::uint64_t> sizes; ///< m_i >= m_(i-1), whole numbers within the budget
    std::vector<double> weights;      ///< alpha_i = rho_i sigma_1 / sigma_i; weights[0] = 1
    double variance = 0.0;            ///< of the estimate with these sizes
    double ratio = 1.0;               ///< variance over that of plain Monte Carlo at equal cost, sizes not rounded
};

/// The subset of models with the least variance for the budget [processor s]. A subset is admissible if
/// w_(i-1) / w_i > (rho_(i-1)^2 - rho_i^2) / (rho_i^2 - rho_(i+1)^2), its m_1 >= 1. Sizes m_1 = B / sum w_i r_i, m_i = r_i m_1,
///     r_i = sqrt[w_1 (rho_i^2 - rho_(i+1)^2) / (w_i (1 - rho_2^2))],  ratio = [sum sqrt((w_i / w_1) (rho_i^2 - rho_(i+1)^2))]^2.
/// @throws ParameterError for costs or sigmas not > 0, |rho| >= 1 of a model but the first, a budget below one run, more than 16 models
MfmcPlan plan_mfmc(std::span<const ModelStatistics> models, double budget);

/// Variance of the estimate with given nested sizes, weights of the plan: sigma_1^2 / m_1 + sum (1/m_(i-1) - 1/m_i) (alpha_i^2 sigma_i^2 - 2 alpha_i rho_i sigma_1 sigma_i).
double mfmc_variance(std::span<const ModelStatistics> models, const MfmcPlan& plan);

/// mean y^1 + sum alpha_i (mean of y^i over m_i - mean over the first m_(i-1)). answers[j][s]: model models[j], sample s; nested: sample s is the
/// same draw for all. @throws ParameterError where one has fewer answers than its size
double mfmc_estimate(const MfmcPlan& plan, std::span<const std::vector<double>> answers);

/// An estimate of P with its error.
struct MfmcEstimate {
    double p = 0.0;       ///< as it is: may lie outside 0 ... 1
    double printed = 0.0; ///< clipped to 0 ... 1
    double se = 0.0;      ///< standard error
    double degrees = 1.0; ///< of freedom of `se`
    Interval interval;    ///< Wilson's with n_eff = p (1 - p) / se^2, at most 20 m_1, and the quantile of Student's t
};

/// The same estimate with its standard error from the samples. Sample s adds, with m_0 = 0 and the answers y^i of the models it was run with,
///     c_s = sum over i with s <= m_i of (alpha_i y^i - alpha_(i+1) y^(i+1)) / m_i,   alpha_(K+1) = 0,   p = sum c_s,
/// and is independent of all others: se^2 = sum over i of (m_i - m_(i-1)) s^2(c_s; m_(i-1) < s <= m_i). Weights are fixed before: a pilot's.
/// @param answers  of f or of its predictions, 0 ... 1, as mfmc_estimate() takes them
MfmcEstimate mfmc_with_error(const MfmcPlan& plan, std::span<const std::vector<double>> answers,
                             double confidence = 0.95);

} // namespace damslip::probability
