#pragma once

#include "sliding/block/fixed_yield.hpp"

/// Many sliding runs in parallel; the results do not depend on the number of threads. `jobs` 0: all cores.
namespace damslip::sliding {

/// Every motion x yield x polarity, one after the other in that order: result[(m n_yields + y) n_polarities + p].
/// `options.polarity` is not used.
std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const FixedYield> yields,
                                     std::span<const int> polarities, const FixedYieldOptions& options = {},
                                     int jobs = 0);

/// The same for blocks in general, motion x block x polarity: by fixed yields where the block does not change with slip
/// and its base never opens, else by slide(). `options.polarity` and `options.history` are not used.
std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const SlipStages> blocks,
                                     std::span<const int> polarities, const SlideOptions& options = {}, int jobs = 0);

} // namespace damslip::sliding
