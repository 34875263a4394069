#include "records/read/time_column.hpp"

#include "core/number.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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

void refuse_falling(const RecordText& text, const TimeColumn& column)
{
    const auto time = column.time;
    for (std::size_t k = 1; k < time.size(); ++k)
        if (!(time[k] > time[k - 1]))
            refuse(text, column.place(k), fmt::format("the time {} s does not follow {} s.", time[k], time[k - 1]),
                   "times that rise from line to line; two numbers a line are time and acceleration",
                   "correct the times; if all numbers are samples, state the time step (\"# dt: 0.01 s\" or --dt)");
}

/// 0.0199999999999 -> 0.02: the division of printed times leaves round-off that the file does not mean.
double tidy(double dt)
{
    const double round = parse_number(fmt::format("{:.9e}", dt)).value_or(dt);
    return std::abs(round - dt) <= 1e-10 * dt ? round : dt;
}

/// Half of the last printed digit of the largest time, or what single precision leaves of it [s].
double rounding_of(const TimeColumn& column)
{
    constexpr double single_precision = 1.2e-7;
    constexpr std::size_t digits_of_single = 7;
    const double largest = std::max(std::abs(column.time.front()), std::abs(column.time.back()));
    const double before_point = std::floor(std::log10(largest)) + 1.0;
    const double printed = 0.5 * std::pow(10.0, before_point - static_cast<double>(column.digits));
    return column.digits >= digits_of_single ? std::max(printed, single_precision * largest) : printed;
}

/// All times are t_0 + k dt within the rounding, t_0 being the first one or, of many times, any near it.
bool fits(std::span<const double> time, double dt, double rounding)
{
    constexpr std::size_t many = 20;
    double low = 0.0, high = 0.0;
    for (std::size_t k = 0; k < time.size(); ++k) {
        const double off = time[k] - time.front() - static_cast<double>(k) * dt;
        low = std::min(low, off), high = std::max(high, off);
    }
    const double slack = 1e-6 * rounding + 1e-12 * std::abs(time.back());
    return std::max(-low, high) <= rounding + slack || (time.size() >= many && high - low < 1.999 * rounding);
}

/// The step of times that are rounded: the stated one; else the one with a whole number of samples a second, or the roundest.
/// @throws InputError where the rounding leaves it open
std::optional<double> rounded_step(const RecordText& text, const TimeColumn& column, std::optional<double> stated)
{
    constexpr double open = 0.05; // relative: beyond it the times are uneven rather than rounded
    const double dt = mean_step(column.time), rounding = rounding_of(column);
    const double half_width = 2.0 * rounding / static_cast<double>(column.time.size() - 1);
    if (!(dt > 0.0) || half_width > open * dt) return std::nullopt;
    if (stated) return fits(column.time, *stated, rounding) ? stated : std::nullopt;
    std::vector<double> candidates{1.0 / std::round(1.0 / dt)};
    for (int digits = 2; digits <= 8; ++digits)
        candidates.push_back(parse_number(fmt::format("{:.{}e}", dt, digits - 1)).value_or(dt));
    for (const double candidate : candidates)
        if (fits(column.time, candidate, rounding)) {
            if (half_width > even_tolerance * dt)
                refuse(text, column.place(0),
                       fmt::format("the times are rounded: their step lies between {:.6g} and {:.6g} s.",
                                   dt - half_width, dt + half_width),
                       fmt::format("a step that is known within {:.1f} %", 100.0 * even_tolerance),
                       fmt::format("state it (motion.record.dt_s, or  --dt {:.8g}  if that is the step)", candidate));
            return candidate;
        }
    return std::nullopt;
}

/// Per cent, never rounded down to the tolerance that it is beyond.
std::string per_cent_off(double relative)
{
    const double per_cent = 100.0 * relative, unit = std::pow(10.0, std::floor(std::log10(per_cent)) - 1.0);
    return fmt::format("{:.3g} % off", std::ceil(per_cent / unit * (1.0 - 1e-12)) * unit);
}

} // namespace

bool is_rising(std::span<const double> values)
{
    return values.size() >= 3 &&
           std::adjacent_find(values.begin(), values.end(), std::greater_equal<>{}) == values.end();
}

std::size_t significant_digits(std::string_view number)
{
    number = number.substr(0, number.find_first_of("eEdD"));
    const std::size_t first = number.find_first_of("123456789");
    if (first == std::string_view::npos) return 0;
    return static_cast<std::size_t>(std::count_if(number.begin() + static_cast<std::ptrdiff_t>(first), number.end(),
                                                  [](char c) { return c >= '0' && c <= '9'; }));
}

std::optional<double> step_of(const RecordText& text, const TimeColumn& column, std::optional<double> stated,
                              const ReadOptions& options)
{
    const auto time = column.time;
    if (time.size() < 2)
        refuse(text, {column.place(0).line, 0}, "there is one line of numbers only.", "at least 2 samples",
               "check that the file is complete");
    const bool rises = std::adjacent_find(time.begin(), time.end(), std::greater_equal<>{}) == time.end();
    const bool falls = std::adjacent_find(time.begin(), time.end(), std::greater<>{}) != time.end();
    const double dt = mean_step(time);
    const auto [row, deviation] = worst_step(time);
    const bool even = rises && deviation <= even_tolerance * (1.0 + 1e-9), // the round-off of printed times aside
        as_stated = !stated || std::abs(*stated - dt) <= 1e-4 * dt;
    if (!falls && !(even && as_stated))
        if (const auto rounded = rounded_step(text, column, stated)) return rounded;
    refuse_falling(text, column);
    if (!even) {
        if (options.uneven == UnevenTime::resample) return std::nullopt;
        refuse(text, column.place(row),
               fmt::format("the time step is uneven: {:.6g} s here, {:.6g} s on average ({}).",
                           time[row] - time[row - 1], dt, per_cent_off(deviation)),
               fmt::format("steps equal within {:.1f} % or rounded to the printed digits (digitised film is uneven)",
                           100.0 * even_tolerance),
               "correct the times, or have the record resampled (`damslip record convert --resample --dt 0.005`)");
    }
    if (!as_stated)
        refuse(text, {column.place(0).line, 0},
               fmt::format("the time column steps by {:.6g} s, but dt = {} s is stated.", dt, *stated), "one time step",
               "leave the stated one out (\"# dt:\", motion.record.dt_s, --dt) or correct the times");
    return stated ? *stated : tidy(dt);
}

std::vector<double> at_even_times(const RecordText& text, const TimeColumn& column, std::vector<double> accel,
                                  std::optional<double> stated, const ReadOptions& options, double& dt,
                                  std::vector<std::string>& warnings)
{
    const auto time = column.time;
    if (const auto step = step_of(text, column, stated, options)) {
        dt = *step;
        return accel;
    }
    dt = stated.value_or(0.0);
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
    warnings.push_back(
        fmt::format("uneven times resampled: {} samples became {} at {} s", accel.size(), even.size(), dt));
    return even;
}

} // namespace damslip::records
