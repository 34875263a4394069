#pragma once

#include "records/record.hpp"

#include <cstddef>
#include <vector>

namespace damslip::sliding {

/// Range of the ground acceleration over some intervals, end samples included [m/s^2].
struct AccelRange {
    double h_min = 0.0, h_max = 0.0, v_min = 0.0, v_max = 0.0;
};

/// A ground motion with the ranges of its blocks of samples, made once and used for many yields: a block at rest skips
/// every stretch whose range cannot start it. Two levels: blocks of 32 intervals, and 32 of those.
class SkippingMotion {
public:
    /// @throws InputError for what check_motion refuses.
    explicit SkippingMotion(GroundMotion motion);

    static constexpr std::size_t block = 32;            ///< intervals of a block
    static constexpr std::size_t large = block * block; ///< intervals of a large block

    const GroundMotion& motion() const { return motion_; }
    bool has_vertical() const { return !motion_.accel_v.empty(); }
    std::size_t intervals() const { return motion_.accel_h.size() - 1; }
    const AccelRange& whole() const { return whole_; }
    const AccelRange& block_range(std::size_t k) const { return blocks_[k]; } ///< intervals 32 k ... 32 k + 31
    const AccelRange& large_range(std::size_t k) const
    {
        return large_blocks_[k];
    } ///< intervals 1024 k ... 1024 k + 1023

    /// First interval at or after k which does not lie in a whole block that `rests(range)` says cannot move;
    /// intervals() when there is none.
    template <typename Rests>
    std::size_t skip(std::size_t k, Rests&& rests) const
    {
        while (k < intervals()) {
            if (k % large == 0 && rests(large_blocks_[k / large]))
                k += large;
            else if (k % block == 0 && rests(blocks_[k / block]))
                k += block;
            else
                return k;
        }
        return intervals();
    }

private:
    GroundMotion motion_;
    std::vector<AccelRange> blocks_, large_blocks_;
    AccelRange whole_;
};

/// @throws InputError for dt <= 0, fewer than 2 samples, components of unequal length, non-finite samples.
void check_motion(const GroundMotion& motion);

} // namespace damslip::sliding
