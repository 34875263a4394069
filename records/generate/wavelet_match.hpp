#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace damslip::records {

/// Linear equations, more or fewer than unknowns, solved in the least-squares sense with small unknowns preferred.
class RegularisedLeastSquares {
public:
    explicit RegularisedLeastSquares(std::size_t unknowns)
        : unknowns_(unknowns), normal_(unknowns * unknowns, 0.0), right_(unknowns, 0.0)
    {
    }

    /// One equation: sum coefficients[j] x[j] = value.
    void add(std::span<const double> coefficients, double value);

    /// x that minimises |C x - r|^2 + lambda |x|^2, lambda = regularisation * mean diagonal of C^T C. @param
    /// regularisation  > 0
    std::vector<double> solve(double regularisation) const;

private:
    std::size_t unknowns_;
    std::vector<double> normal_; ///< C^T C, lower triangle by rows
    std::vector<double> right_;  ///< C^T r
};

/// Uniform numbers in [0, 1), the same on every machine: the standard fixes the sequence of mt19937_64 but not its
/// distributions, so the upper 53 bits are mapped here. `stream` tells independent uses of one seed apart.
class UniformRandom {
public:
    UniformRandom(std::uint64_t seed, std::uint64_t stream) : engine_(mixed(mixed(seed) + stream)) {}
    double next() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

private:
    /// SplitMix64 (Steele, Lea & Flood 2014): neighbouring seeds give unrelated engines.
    static std::uint64_t mixed(std::uint64_t x)
    {
        x += 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }
    std::mt19937_64 engine_;
};

} // namespace damslip::records
