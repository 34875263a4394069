#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>

/// Scenes drawn at random.
namespace damslip::random {

/// Choices from a source of 32 random bits: a generator with a seed, or the bytes of a fuzzer.
class Draw {
public:
    explicit Draw(std::function<std::uint32_t()> bits) : bits_(std::move(bits)) {}

    double unit() { return static_cast<double>(bits_()) / 4294967296.0; } ///< in [0, 1)
    bool chance(double probability) { return unit() < probability; }
    int whole(int first, int last); ///< first ... last
    /// Four significant digits of a number in [low, high], evenly or evenly in its logarithm.
    double between(double low, double high);
    double log_between(double low, double high);
    std::string word(std::initializer_list<const char*> words);

private:
    std::function<std::uint32_t()> bits_;
};

/// The generator of a seed: the same draws on every machine.
Draw seeded(std::uint32_t seed);

} // namespace damslip::random
