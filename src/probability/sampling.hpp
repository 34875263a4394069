#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace damslip::probability {

/// Philox4x32-10 (Salmon, Moraes, Dror & Shaw 2011): 128 random bits as a function of counter and key alone.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// 32-bit FNV-1a hash of a variable's name. Two names of one scene with the same hash are refused by the reader.
std::uint32_t stream_hash(std::string_view name);

/// Random numbers of one variable: sample i always has the same ones, whatever was drawn before, by whom and in which order.
/// Key = seed; counter = (sample, hash of the name, replicate, block).
class Stream {
public:
    Stream(std::uint64_t seed, std::string_view name, std::uint32_t replicate = 0);

    std::array<std::uint32_t, 4> block(std::uint32_t sample, std::uint32_t block = 0) const;
    std::uint64_t bits(std::uint32_t sample, std::uint32_t block = 0) const; ///< the first 64 of the block

    /// u = (k + 1/2) 2^-52 with 52 random bits k, 0 < u < 1: every one is a double, and 1 - u is one of them, too.
    /// (With 53 bits k + 1/2 would be rounded where u > 1/2, and the last one to u = 1.)
    double uniform(std::uint32_t sample, std::uint32_t block = 0) const;

    /// A whole number 0 ... n - 1, each with the same probability up to n 2^-64.
    std::uint32_t below(std::uint32_t n, std::uint32_t sample, std::uint32_t block = 0) const;

private:
    std::array<std::uint32_t, 2> key_;
    std::uint32_t hash_, replicate_;
};

enum class RecordOrder {
    balanced,        ///< each block of R samples has every record once, in random order
    with_replacement ///< each sample a record of its own
};

/// Which record a sample meets. Unequal weights, balanced: u = (pi(j) + v) / R with one v a block, through the distribution
/// of the weights, so that a record of weight w is met R w times a block, rounded up or down.
class RecordDraw {
public:
    /// @param weights  of the records, > 0, of any sum
    RecordDraw(RecordOrder order, std::uint64_t seed, std::span<const double> weights, std::uint32_t replicate = 0);
    RecordDraw(RecordOrder order, std::uint64_t seed, std::size_t records, std::uint32_t replicate = 0);

    std::size_t operator()(std::uint32_t sample) const; ///< 0 ... R - 1

private:
    RecordOrder order_;
    Stream stream_;
    std::vector<double> below_; ///< below_[r] = share of the records 0 ... r
    bool equal_;
};

/// A permutation of 0 ... n - 1, all n! equally likely (Fisher-Yates), fixed by stream and block alone.
std::vector<std::uint32_t> permutation(const Stream& stream, std::uint32_t n, std::uint32_t block = 0);

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

/// One rank correlation of two variables, by their place in the list.
struct RankCorrelation {
    std::size_t first = 0, second = 0;
    double spearman = 0.0; ///< rho_S [-], -1 < rho_S < 1
};

/// The correlations contradict one another.
class NotPositiveDefinite : public std::invalid_argument {
public:
    explicit NotPositiveDefinite(double smallest_eigenvalue);
    double smallest_eigenvalue() const { return smallest_; } ///< of the matrix of r; <= 1e-10

private:
    double smallest_;
};

/// Gaussian copula: z = Phi^-1(u) of independent u, y = L z with L L^T = R, then Phi(y). R has r = 2 sin(pi rho_S / 6), which gives
/// continuous variables the Spearman correlation rho_S (Kruskal 1958).
///
/// Variable k depends on the u of variables 0 ... k alone. One that is drawn in batches goes last: its u then moves no other variable.
class GaussianCopula {
public:
    /// @throws ParameterError for |rho_S| >= 1, a pair of one variable with itself, a pair named twice; NotPositiveDefinite
    GaussianCopula(std::size_t dimension, std::span<const RankCorrelation> correlations);

    std::size_t dimension() const { return dimension_; }
    double correlation(std::size_t i, std::size_t j) const
    {
        return r_[i * dimension_ + j];
    } ///< r_ij of the normal variables

    /// Dependent uniform numbers from independent ones. Without any correlation they come back bit for bit.
    std::vector<double> dependent(std::span<const double> u) const;

    /// The variables not in `given` (a mask of bits) drawn anew from independent u, those in it kept as they are in `fixed` (dependent uniforms).
    std::vector<double> conditional(std::uint32_t given, std::span<const double> fixed,
                                    std::span<const double> u) const;

private:
    std::size_t dimension_;
    bool independent_;
    std::vector<double> r_, factor_; ///< R and L, row by row
};

// Which variable the spread of an answer Y comes from.

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
