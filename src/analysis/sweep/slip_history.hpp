#pragma once

#include <cstddef>
#include <vector>

namespace damslip {

/// Slip of one row over time, as much of it as a chart shows.
struct SlipHistory {
    double interval = 0.0;    ///< between values, the first at t = 0 [s]; 0: no history
    std::vector<double> slip; ///< positive downstream, whole multiples of 0.1 µm [m]

    friend bool operator==(const SlipHistory&, const SlipHistory&) = default;
};

constexpr std::size_t history_values = 400;          ///< at most
constexpr std::size_t most_rows_with_history = 1000; ///< sweeps of more rows keep none

/// Every n-th value, n so that there are at most `history_values`; the last interval is cut where it does not fit.
/// @param time, slip  of equal length [s, m], time ascending; values between them are interpolated where the samples are
/// not evenly spaced
SlipHistory slip_history(const std::vector<double>& time, const std::vector<double>& slip);

} // namespace damslip
