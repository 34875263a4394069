#include "sliding/block/pressed_lanes.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/slip_motion.hpp"

#include <algorithm>

namespace damslip::sliding {
namespace {

using FourStages = std::array<const SlipStages*, pressed_lanes>;

/// What all blocks have in common lets them go together. Without lanes none is made ready in vain.
bool may_go_together(const SkippingMotion& motion, const SlideOptions& options)
{
    return has_pressed_lanes() && !motion.has_vertical() && !motion.motion().is_sequence() &&
           options.sliding.scheme == SlidingScheme::exact && options.anchors.empty();
}

/// @returns false where they have to go one by one
bool slide_four(const SkippingMotion& motion, const FourStages& stages, const SlideOptions& options,
                std::span<SlideResult> results)
{
    const auto of = [&](std::size_t i) { return SlipMotion(*stages[i], options); };
    std::array<SlipMotion, pressed_lanes> blocks{of(0), of(1), of(2), of(3)};
    if (!SlipMotion::pass_together(motion, options.polarity, {&blocks[0], &blocks[1], &blocks[2], &blocks[3]}))
        return false;
    const double dt = motion.motion().dt, end = static_cast<double>(motion.intervals()) * dt;
    for (std::size_t i = 0; i < results.size(); ++i) {
        SlipMotion& block = blocks[i];
        run_out(block, *stages[i], end, dt, options.sliding.run_out_max, nullptr);
        conclude(block, *stages[i], options, end, results[i]);
    }
    return true;
}

} // namespace

std::vector<SlideResult> slide_together(const SkippingMotion& motion, std::span<const SlipStages* const> blocks,
                                        const SlideOptions& options)
{
    std::vector<SlideResult> results(blocks.size());
    SlideOptions plain = options;
    plain.history = HistoryOutput::none;
    const bool together = may_go_together(motion, options);
    for (std::size_t first = 0; first < blocks.size(); first += pressed_lanes) {
        const std::size_t count = std::min(pressed_lanes, blocks.size() - first);
        const auto here = blocks.subspan(first, count);
        const auto fits = [](const SlipStages* stages) { return stages->size() == 1; };
        if (together && count > 1 && std::ranges::all_of(here, fits)) {
            FourStages four;
            for (std::size_t i = 0; i < pressed_lanes; ++i) four[i] = here[std::min(i, count - 1)];
            for (const SlipStages* stages : here) check_stages(*stages);
            if (slide_four(motion, four, plain, std::span(results).subspan(first, count))) continue;
        }
        for (std::size_t i = 0; i < count; ++i) results[first + i] = slide(motion, *here[i], plain);
    }
    return results;
}

} // namespace damslip::sliding
