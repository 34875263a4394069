#pragma once

#include "sliding/block/fixed_yield.hpp"

#include <functional>

/// Many sliding runs in parallel; the results do not depend on the number of threads.
namespace damslip::sliding {

/// Calls work(0) ... work(count - 1), each once, on `jobs` threads (0: all cores). The calls must not touch each
/// other's data; the first exception, lowest index first, is thrown again once all threads have ended.
void for_each_index(std::size_t count, unsigned jobs, const std::function<void(std::size_t)>& work);

/// Every motion x yield x polarity, one after the other in that order: result[(m n_yields + y) n_polarities + p].
/// `options.polarity` is not used.
std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const FixedYield> yields,
                                     std::span<const int> polarities, const FixedYieldOptions& options = {},
                                     unsigned jobs = 0);

/// The same for blocks in general, motion x block x polarity: by fixed yields where the block does not change with slip
/// and its base never opens, else by slide(). `options.polarity` and `options.history` are not used.
std::vector<SlipSummary> slide_batch(std::span<const SkippingMotion> motions, std::span<const SlipStages> blocks,
                                     std::span<const int> polarities, const SlideOptions& options = {},
                                     unsigned jobs = 0);

} // namespace damslip::sliding
