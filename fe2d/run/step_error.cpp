#include "fe2d/run/step_error.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

namespace {

constexpr double believable_order = 2.5; ///< differences that fall faster than that do so by accident

/// (s_i - s_j) / (s_j - s_k) of an error of order p.
double ratio_of_differences(double p, int first, int second)
{
    return (std::exp2(p * first) - 1.0) / (1.0 - std::exp2(-p * second));
}

} // namespace

double observed_order(std::span<const SlipAtStep> slips)
{
    if (slips.size() < 3) return 1.0;
    const auto last = slips.last(3);
    const int first = last[1].halvings - last[0].halvings, second = last[2].halvings - last[1].halvings;
    const double before = std::abs(last[1].slip - last[0].slip), now = std::abs(last[2].slip - last[1].slip);
    double low = 1.0, high = largest_order;
    for (int k = 0; k < 40; ++k) {
        const double p = 0.5 * (low + high);
        (before > now * ratio_of_differences(p, first, second) ? low : high) = p;
    }
    return low;
}

double step_error(std::span<const SlipAtStep> slips)
{
    const auto last = slips.last(2);
    const int halvings = last[1].halvings - last[0].halvings;
    double difference = std::abs(last[1].slip - last[0].slip);
    if (slips.size() >= 3) { // a sudden agreement is an accident
        const SlipAtStep& first = slips[slips.size() - 3];
        const double before = std::abs(last[0].slip - first.slip);
        difference = std::max(
            difference, before / ratio_of_differences(believable_order, last[0].halvings - first.halvings, halvings));
    }
    return difference / (std::exp2(observed_order(slips) * halvings) - 1.0);
}

int next_halvings(std::span<const SlipAtStep> slips, double excess)
{
    const double by_second_order = excess / 3.0; // from two slips it rests on first order
    return slips.back().halvings + (slips.size() == 2 && by_second_order > 4.0 ? 2 : 1);
}

} // namespace damslip::fe2d
