#pragma once

#include "probability/sampling/philox.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace damslip::probability {

enum class Sampling {
    random, ///< independent points
    lhs,    ///< Latin hypercube: each variable has one point in each of N equal strata
    sobol   ///< Sobol' points, shifted at random
};

/// Dimensions the Sobol' points have; beyond, points are random.
inline constexpr std::size_t sobol_dimensions = 40;

/// The N points of one replicate in the open unit cube, one coordinate a variable. The mean over them is an unbiased estimate; its error is
/// taken from replicates, as the points of one are dependent (lhs, sobol).
///
/// lhs: u = (pi(i) + v) / N, permutation pi and v of the variable's stream.
/// sobol: N a power of two, N = 2^m. The first N points of gsl_qrng_sobol with the origin put back, their m bits xor-ed with a random shift of the
/// replicate, the bits below 2^-m drawn anew for each point (the plain shift leaves 1/(12 N^2) as the variance of the mean of u, fresh bits
/// 1/(12 N^3)). Its coordinate is the variable's place in the list: a variable added at the end changes no other.
class UnitPoints {
public:
    /// @throws ParameterError for n = 0; sobol: n no power of two or above 2^30
    UnitPoints(Sampling sampling, std::uint64_t seed, const std::vector<std::string>& names, std::uint32_t n,
               std::uint32_t replicate = 0);

    double operator()(std::uint32_t sample, std::size_t variable) const;
    std::vector<double> point(std::uint32_t sample) const;
    std::uint32_t size() const { return n_; }
    std::size_t dimension() const { return streams_.size(); }
    Sampling used() const { return sampling_; } ///< random where sobol was asked for in more than 40 dimensions

private:
    Sampling sampling_;
    std::uint32_t n_;
    int bits_ = 0; ///< m
    std::vector<Stream> streams_;
    std::vector<std::uint32_t> strata_; ///< lhs, sobol: stratum 0 ... N - 1 of sample i in variable k at [k N + i]
};

} // namespace damslip::probability
