#pragma once

#include <array>
#include <cstdint>
#include <string_view>

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

} // namespace damslip::probability
