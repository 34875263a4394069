#include "sliding/block/skipping_motion.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {
namespace {

/// Samples first ... last, both included.
AccelRange range_of(const GroundMotion& motion, std::size_t first, std::size_t last)
{
    AccelRange range;
    const auto [h_min, h_max] = std::minmax_element(motion.accel_h.begin() + first, motion.accel_h.begin() + last + 1);
    range.h_min = *h_min;
    range.h_max = *h_max;
    if (motion.accel_v.empty()) return range;
    const auto [v_min, v_max] = std::minmax_element(motion.accel_v.begin() + first, motion.accel_v.begin() + last + 1);
    range.v_min = *v_min;
    range.v_max = *v_max;
    return range;
}

std::vector<AccelRange> ranges_of(const GroundMotion& motion, std::size_t intervals_each)
{
    std::vector<AccelRange> ranges;
    const std::size_t intervals = motion.accel_h.size() - 1;
    for (std::size_t k = 0; k < intervals; k += intervals_each)
        ranges.push_back(range_of(motion, k, std::min(k + intervals_each, intervals)));
    return ranges;
}

} // namespace

SkippingMotion::SkippingMotion(GroundMotion motion) : motion_(std::move(motion))
{
    check_motion(motion_);
    blocks_ = ranges_of(motion_, block);
    large_blocks_ = ranges_of(motion_, large);
    whole_ = range_of(motion_, 0, intervals());
}

void check_motion(const GroundMotion& motion)
{
    Diagnostic wrong;
    wrong.file = motion.name;
    wrong.expected =
        "a time step > 0 s and at least 2 finite samples, the vertical component as long as the horizontal one";
    const auto finite = [](double a) { return std::isfinite(a); };
    if (!(motion.dt > 0.0) || !std::isfinite(motion.dt))
        wrong.problem = "ground motion: time step " + shortest(motion.dt) + " s is not allowed.";
    else if (motion.accel_h.size() < 2)
        wrong.problem = "ground motion: " + std::to_string(motion.accel_h.size()) + " samples are too few.";
    else if (!motion.accel_v.empty() && motion.accel_v.size() != motion.accel_h.size())
        wrong.problem = "ground motion: " + std::to_string(motion.accel_v.size()) + " vertical samples beside " +
                        std::to_string(motion.accel_h.size()) + " horizontal ones.";
    else if (!std::ranges::all_of(motion.accel_h, finite) || !std::ranges::all_of(motion.accel_v, finite))
        wrong.problem = "ground motion: a sample is not a finite number.";
    else
        return;
    throw InputError(wrong);
}

} // namespace damslip::sliding
