#include "fe2d/run/step_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace damslip::fe2d {

namespace {

/// (s_i - s_j) / (s_j - s_k) of an error of order p.
double ratio_of_differences(double p, int first, int second)
{
    return (std::exp2(p * first) - 1.0) / (1.0 - std::exp2(-p * second));
}

} // namespace

double observed_order(std::span<const SlipAtStep> slips, double largest)
{
    if (slips.size() < 3) return 1.0;
    const auto last = slips.last(3);
    const int first = last[1].halvings - last[0].halvings, second = last[2].halvings - last[1].halvings;
    const double before = last[1].change, now = last[2].change;
    double low = 1.0, high = largest;
    for (int k = 0; k < 40; ++k) {
        const double p = 0.5 * (low + high);
        (before > now * ratio_of_differences(p, first, second) ? low : high) = p;
    }
    return low;
}

double step_error(std::span<const SlipAtStep> slips, double largest)
{
    const auto last = slips.last(2);
    const int halvings = last[1].halvings - last[0].halvings;
    double change = last[1].change, safety = safety_factor.of_two;
    if (slips.size() >= 3) {
        const int before = last[0].halvings - slips[slips.size() - 3].halvings;
        change = std::max(change, last[0].change / ratio_of_differences(largest, before, halvings));
        safety = safety_factor.of_three;
    }
    return safety * change / (std::exp2(observed_order(slips, largest) * halvings) - 1.0);
}

int next_halvings(std::span<const SlipAtStep> slips, double excess, double largest)
{
    const int last = slips.back().halvings;
    if (slips.size() != 2) return last + 1;
    const SlipAtStep still{last + 1, slips.back().slip, 0.0}; // as small a change as there can be
    const double best = step_error(std::array{slips[0], slips[1], still}, largest);
    return last + (excess * best > step_error(slips, largest) ? 2 : 1);
}

double largest_difference(std::span<const double> a, std::span<const double> b)
{
    double largest = std::abs(a.back() - b.back());
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

double largest_difference(std::span<const double> a, std::span<const std::size_t> a_starts, std::span<const double> b,
                          std::span<const std::size_t> b_starts)
{
    const auto event = [](std::span<const double> all, std::span<const std::size_t> starts, std::size_t i) {
        const std::size_t end = i + 1 < starts.size() ? starts[i + 1] : all.size();
        return all.subspan(starts[i], end - starts[i]);
    };
    double largest = std::abs(a.back() - b.back());
    for (std::size_t i = 0; i < std::min(a_starts.size(), b_starts.size()); ++i)
        largest = std::max(largest, largest_difference(event(a, a_starts, i), event(b, b_starts, i)));
    return largest;
}

} // namespace damslip::fe2d
