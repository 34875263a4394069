#pragma once

#include "sliding/block/slide_batch.hpp"

#include <array>
#include <cstddef>

/// Four blocks of one motion side by side, for batches: the samples are gone through once for all four.
namespace damslip::sliding {

inline constexpr std::size_t yield_lanes = 4;

/// True where slide_in_lanes() knows the case: horizontal motion, one-way, at rest without an earthquake and at the
/// first sample.
bool fits_lanes(const SkippingMotion& motion, const FixedYield& yield, int polarity);

/// slide_fixed_yield() of four yields, with the same bits. All of them fit the lanes; the first is the least one, for it
/// is the one that decides what can be skipped. Where the processor has no AVX2 they run one after the other.
/// @param yields  constants ascending
/// @param options  polarity for all of them
std::array<SlipSummary, yield_lanes> slide_in_lanes(const SkippingMotion& motion,
                                                    const std::array<FixedYield, yield_lanes>& yields,
                                                    const FixedYieldOptions& options);

} // namespace damslip::sliding
