#include "records/read/time_column.hpp"

#include "core/number.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace damslip::records {

namespace {

double mean_step(std::span<const double> time)
{
    return (time.back() - time.front()) / static_cast<double>(time.size() - 1);
}

/// Row whose step from the row before deviates most from the mean, and that deviation relative to the mean.
std::pair<std::size_t, double> worst_step(std::span<const double> time)
{
    const double mean = mean_step(time);
    std::size_t row = 1;
    double worst = 0.0;
    for (std::size_t k = 1; k < time.size(); ++k) {
        const double deviation = std::abs(time[k] - time[k - 1] - mean);
        if (deviation > worst) worst = deviation, row = k;
    }
    return {row, worst / mean};
}

void refuse_falling(const RecordText& text, const NumberTable& table, std::size_t column, std::span<const double> time)
{
    for (std::size_t k = 1; k < time.size(); ++k)
        if (!(time[k] > time[k - 1]))
            refuse(text, table.place(k, column, text),
                   fmt::format("the time {} s does not follow {} s.", time[k], time[k - 1]),
                   "times that rise from line to line; two numbers a line are time and acceleration",
                   "correct the times; if all numbers are samples, state the time step (\"# dt: 0.01 s\" or --dt)");
}

/// 0.0199999999999 -> 0.02: the division of printed times leaves round-off that the file does not mean.
double tidy(double dt)
{
    const double round = parse_number(fmt::format("{:.9e}", dt)).value_or(dt);
    return std::abs(round - dt) <= 1e-10 * dt ? round : dt;
}

} // namespace

bool is_rising(std::span<const double> values)
{
    return values.size() >= 3 &&
           std::adjacent_find(values.begin(), values.end(), std::greater_equal<>{}) == values.end();
}

std::optional<double> step_of(const RecordText& text, const NumberTable& table, std::size_t column,
                              std::span<const double> time, std::optional<double> stated, const ReadOptions& options)
{
    if (time.size() < 2)
        refuse(text, {table.row_line.front(), 0}, "there is one line of numbers only.", "at least 2 samples",
               "check that the file is complete");
    refuse_falling(text, table, column, time);
    const double dt = mean_step(time);
    const auto [row, deviation] = worst_step(time);
    if (deviation > even_tolerance) {
        if (options.uneven == UnevenTime::resample) return std::nullopt;
        refuse(text, table.place(row, column, text),
               fmt::format("the time step is uneven: {:.6g} s here, {:.6g} s on average ({:.2g} % off).",
                           time[row] - time[row - 1], dt, 100.0 * deviation),
               fmt::format("steps equal within {:.1f} %", 100.0 * even_tolerance),
               "correct the times, or have the record resampled (`damslip record convert --resample`)");
    }
    if (stated && std::abs(*stated - dt) > 1e-4 * dt)
        refuse(text, {table.row_line.front(), 0},
               fmt::format("the time column steps by {:.6g} s, but dt = {} s is stated.", dt, *stated), "one time step",
               "leave the stated one out (\"# dt:\", motion.record.dt_s, --dt) or correct the times");
    return stated ? *stated : tidy(dt);
}

std::vector<double> at_even_times(const RecordText& text, std::span<const double> time, std::span<const double> accel,
                                  double& dt)
{
    if (dt <= 0.0) {
        dt = time[1] - time[0];
        for (std::size_t k = 1; k < time.size(); ++k) dt = std::min(dt, time[k] - time[k - 1]);
        dt = tidy(dt);
    }
    const double count = std::floor((time.back() - time.front()) / dt * (1.0 + 1e-12)) + 1.0;
    if (!(count >= 2.0 && count <= static_cast<double>(max_samples)))
        refuse(text, {}, fmt::format("a time step of {:.3g} s makes {:.3g} samples of this file.", dt, count),
               fmt::format("2 to {} samples", max_samples), "give a time step (motion.record.dt_s, --dt)");
    std::vector<double> even(static_cast<std::size_t>(count));
    std::size_t left = 0;
    for (std::size_t k = 0; k < even.size(); ++k) {
        const double t = time.front() + static_cast<double>(k) * dt;
        while (left + 2 < time.size() && time[left + 1] <= t) ++left;
        const double x = std::clamp((t - time[left]) / (time[left + 1] - time[left]), 0.0, 1.0);
        even[k] = accel[left] + x * (accel[left + 1] - accel[left]);
    }
    return even;
}

} // namespace damslip::records
