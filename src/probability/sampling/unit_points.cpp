#include "probability/sampling/unit_points.hpp"

#include "probability/laws/distribution.hpp"
#include "probability/sampling/permutation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <gsl/gsl_qrng.h>
#include <memory>

namespace damslip::probability {

namespace {

// Blocks of a variable's stream: 0 the number within the stratum; the permutation or the shift has one of its own.
constexpr std::uint32_t whole_block = 1;

/// Strata 0 ... N - 1 of the first N = 2^m points in each dimension. A point of gsl_qrng_sobol is k 2^-30, and its first N ones have zeros below
/// 2^-m; it leaves the origin out.
std::vector<std::uint32_t> sobol_strata(std::size_t dimension, std::uint32_t n, int bits)
{
    std::vector<std::uint32_t> strata(dimension * n, 0u);
    const std::unique_ptr<gsl_qrng, void (*)(gsl_qrng*)> sequence(
        gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(dimension)), gsl_qrng_free);
    std::vector<double> x(dimension);
    for (std::uint32_t i = 1; i < n; ++i) {
        gsl_qrng_get(sequence.get(), x.data());
        for (std::size_t k = 0; k < dimension; ++k)
            strata[k * n + i] = static_cast<std::uint32_t>(std::ldexp(x[k], bits));
    }
    return strata;
}

} // namespace

UnitPoints::UnitPoints(Sampling sampling, std::uint64_t seed, const std::vector<std::string>& names, std::uint32_t n,
                       std::uint32_t replicate)
    : sampling_(sampling), n_(n)
{
    if (n == 0) throw ParameterError("samples", "0", "a whole number > 0");
    for (const std::string& name : names) streams_.emplace_back(seed, name, replicate);
    if (sampling_ == Sampling::sobol && names.size() > sobol_dimensions) sampling_ = Sampling::random;
    if (sampling_ == Sampling::sobol) {
        if (!std::has_single_bit(n) || n > 1u << 30)
            throw ParameterError("samples", fmt::format("{}", n), "a power of two up to 2^30, for Sobol' points");
        bits_ = std::countr_zero(n);
        if (!names.empty()) strata_ = sobol_strata(names.size(), n, bits_);
        for (std::size_t k = 0; k < names.size(); ++k) {
            const std::uint32_t shift = streams_[k].below(n, 0, whole_block);
            for (std::uint32_t i = 0; i < n; ++i) strata_[k * n + i] ^= shift;
        }
    }
    if (sampling_ == Sampling::lhs)
        for (const Stream& stream : streams_) {
            const std::vector<std::uint32_t> order = permutation(stream, n, whole_block);
            strata_.insert(strata_.end(), order.begin(), order.end());
        }
}

double UnitPoints::operator()(std::uint32_t sample, std::size_t variable) const
{
    const double v = streams_[variable].uniform(sample);
    if (sampling_ == Sampling::random) return v;
    const double u = (strata_[variable * n_ + sample] + v) / n_;
    return std::min(u, 1.0 - 0x1p-53); // rounded to 1 in the last stratum, once in 2^52
}

std::vector<double> UnitPoints::point(std::uint32_t sample) const
{
    std::vector<double> u;
    for (std::size_t k = 0; k < dimension(); ++k) u.push_back((*this)(sample, k));
    return u;
}

} // namespace damslip::probability
