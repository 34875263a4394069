#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// Which variable the spread of an answer Y comes from.
namespace damslip::probability {

class GaussianCopula;

struct Estimated {
    double value = 0.0;
    double lower = 0.0, upper = 0.0; ///< 95 % by bootstrap of the samples
};

struct SobolIndex {
    Estimated first; ///< S_i: share of the variance that goes if variable i is known
    Estimated total; ///< T_i: share that is left if all others are known
};

struct SobolIndices {
    double mean = 0.0, variance = 0.0; ///< of Y, inner noise taken off
    std::vector<SobolIndex> variables;
};

/// Independent variables (Saltelli et al. 2010; Jansen 1999): S_i = E[f_B (f_ABi - f_A)] / V, T_i = E[(f_A - f_ABi)^2] / (2 V).
/// f_A, f_B: answers at the N rows of two independent samples A and B; f_AB[i]: at the rows of A with column i from B. N (k + 2) runs.
/// @param noise  variance that inner sampling adds to each answer, independent from run to run; taken off V and the numerator of T
SobolIndices sobol_indices(std::span<const double> f_a, std::span<const double> f_b,
                           std::span<const std::vector<double>> f_ab, double noise = 0.0, std::uint64_t seed = 1,
                           std::uint32_t bootstrap = 1000);

/// Shapley effects from a value function c(u) = Var E[Y | X_u], u a mask of variables, c(none) = 0:
///     Sh_i = (1/k) sum over u without i of C(k - 1, |u|)^-1 [c(u and i) - c(u)]     Owen (2014); not divided by V. They sum up to c(all).
/// @throws ParameterError for k = 0 or k > 20
std::vector<double> shapley(std::size_t k, const std::function<double(std::uint32_t)>& c);

struct ShapleyEffects {
    double mean = 0.0, variance = 0.0; ///< of Y
    std::vector<Estimated> shares;     ///< Sh_i / V, intervals by bootstrap of the outer samples
    std::size_t runs = 0;
};

/// Shapley effects of correlated variables (Song, Nelson & Staum 2016), all subsets: E Var[Y | X_-u] from `outer` draws of X_-u with `inner` of X_u
/// each; unbiased for each subset. k <= 12.
/// @param answer    Y of dependent uniform numbers of the variables
/// @param noise     variance that inner sampling adds to each answer; taken off
ShapleyEffects shapley_effects(const GaussianCopula& copula,
                               const std::function<double(std::span<const double>)>& answer, std::uint32_t outer,
                               std::uint32_t inner = 3, double noise = 0.0, std::uint64_t seed = 1,
                               std::uint32_t bootstrap = 500);

/// One bar of a tornado: Y with the variable at its 5 and 95 % (of a choice: at each value), all others at their medians.
struct TornadoBar {
    std::string variable;
    std::vector<std::string> at; ///< "5 %", "95 %", or the choice's words
    std::vector<double> y;
    double swing() const; ///< largest minus smallest y
};

/// Longest bar first; equal ones by name.
void order_tornado(std::vector<TornadoBar>& bars);

} // namespace damslip::probability
