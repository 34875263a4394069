#pragma once

#include <cstdint>
#include <random>

namespace damslip::records {

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
