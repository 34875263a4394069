#include "probability/sampling/philox.hpp"

namespace damslip::probability {

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> c, std::array<std::uint32_t, 2> key)
{
    constexpr std::uint64_t m0 = 0xD2511F53u, m1 = 0xCD9E8D57u; // multipliers and Weyl steps of Salmon et al. (2011)
    constexpr std::uint32_t w0 = 0x9E3779B9u, w1 = 0xBB67AE85u;
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = m0 * c[0], b = m1 * c[2];
        c = {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ key[0], static_cast<std::uint32_t>(b),
             static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ key[1], static_cast<std::uint32_t>(a)};
        key[0] += w0;
        key[1] += w1;
    }
    return c;
}

std::uint32_t stream_hash(std::string_view name)
{
    std::uint32_t hash = 2166136261u;
    for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
    return hash;
}

Stream::Stream(std::uint64_t seed, std::string_view name, std::uint32_t replicate)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}, hash_(stream_hash(name)),
      replicate_(replicate)
{
}

std::array<std::uint32_t, 4> Stream::block(std::uint32_t sample, std::uint32_t block) const
{
    return philox4x32({sample, hash_, replicate_, block}, key_);
}

std::uint64_t Stream::bits(std::uint32_t sample, std::uint32_t which) const
{
    const std::array<std::uint32_t, 4> b = block(sample, which);
    return static_cast<std::uint64_t>(b[0]) << 32 | b[1];
}

double Stream::uniform(std::uint32_t sample, std::uint32_t block) const
{
    return static_cast<double>(bits(sample, block) >> 12 << 1 | 1u) * 0x1p-53; // (2k + 1) 2^-53
}

std::uint32_t Stream::below(std::uint32_t n, std::uint32_t sample, std::uint32_t block) const
{
    // n bits / 2^64 without 128-bit numbers: high half first, then what the low half carries over.
    const std::uint64_t b = bits(sample, block);
    const std::uint64_t carry = (b & 0xFFFFFFFFu) * n >> 32;
    return static_cast<std::uint32_t>(((b >> 32) * n + carry) >> 32);
}

} // namespace damslip::probability
