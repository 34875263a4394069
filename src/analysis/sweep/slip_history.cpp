#include "analysis/sweep/slip_history.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

namespace {

constexpr double resolution = 1e7; ///< values per metre

double rounded(double slip)
{
    return std::round(slip * resolution) / resolution;
}

} // namespace

SlipHistory slip_history(const std::vector<double>& time, const std::vector<double>& slip)
{
    SlipHistory history;
    if (time.size() < 2) return history;
    const double step = time[1] - time[0];
    const auto every = static_cast<double>((time.size() + history_values - 1) / history_values);
    history.interval = every * step;
    std::size_t next = 1; // first sample at or after t
    for (std::size_t k = 0; k < history_values; ++k) {
        const double t = time.front() + static_cast<double>(k) * history.interval;
        if (t > time.back() + 1e-6 * step) break;
        while (next + 1 < time.size() && time[next] < t - 1e-6 * step) ++next;
        const double share = (t - time[next - 1]) / (time[next] - time[next - 1]);
        history.slip.push_back(rounded(slip[next - 1] + std::clamp(share, 0.0, 1.0) * (slip[next] - slip[next - 1])));
    }
    return history;
}

} // namespace damslip
