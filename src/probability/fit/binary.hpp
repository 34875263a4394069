#pragma once

#include <span>
#include <string>
#include <vector>

namespace damslip::probability {

enum class Link {
    probit, ///< p = Phi(eta)
    logit   ///< p = 1 / (1 + e^-eta)
};
enum class Penalty {
    none, ///< maximum likelihood; the caller knows that it exists
    firth ///< likelihood times sqrt(det information) (Firth 1993): exists for any counts
};

/// eta = b_0 + b_1 x_1 + ... + b_k x_k and its likelihood sum z ln p + (n - z) ln(1 - p), 0 <= z <= n, real numbers allowed.
struct BinaryFit {
    Link link = Link::probit;
    std::vector<double> coefficients; ///< b_0 ... b_k
    std::vector<double> covariance;   ///< inverse of the expected information, row by row
    double log_likelihood = 0.0;      ///< without the penalty
    int iterations = 0;
    bool converged =
        false; ///< Newton decrement below 1e-20 of the log-likelihood, or 1e-12 where no step rises any more

    double eta(std::span<const double> x) const;
    double probability(std::span<const double> x) const;
};

/// Newton's method with halved steps; a covariate that does not vary, or is a linear combination of those before it, has the coefficient 0.
/// @param x  k covariates a row, row by row; k = x.size() / n.size()
BinaryFit fit_binary(Link link, Penalty penalty, std::span<const double> x, std::span<const double> n,
                     std::span<const double> z);

/// One covariate: whether the likelihood has a maximum. It has where successes and survivals overlap: the lowest x with a success lies below the
/// highest with a survival, and the lowest with a survival below the highest with a success (Albert & Anderson 1984).
bool likelihood_has_maximum(std::span<const double> x, std::span<const double> n, std::span<const double> z);

} // namespace damslip::probability
