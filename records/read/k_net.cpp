#include "records/read/format.hpp"

#include "core/number.hpp"
#include "records/read/agency_samples.hpp"
#include "records/read/cut_end.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

constexpr std::size_t label_width = 18, most_header_lines = 25;
constexpr double offset_seconds = 10.0, shortest_with_quiet_start = 20.0; // [s]

/// The value beside a label, with its line. @throws InputError: no such label.
Stated<std::string_view> value_of(const RecordText& text, std::size_t header_lines, std::string_view label)
{
    for (std::size_t k = 0; k < header_lines; ++k)
        if (lower(text.lines[k]).starts_with(label))
            return {trimmed(text.lines[k].substr(std::min(text.lines[k].size(), label_width))), k + 1};
    refuse(text, {1, 0}, fmt::format("the header has no line \"{}\".", label), "the 17 lines of a K-NET header",
           "get the file anew from its source");
}

/// Lines up to the one of the memo, below which the samples start.
std::size_t k_net_header_size(const RecordText& text)
{
    for (std::size_t k = 0; k < std::min(most_header_lines, text.lines.size()); ++k)
        if (lower(text.lines[k]).starts_with("memo")) return k + 1;
    refuse(text, {std::min(most_header_lines, text.lines.size()), 0}, "the header does not end: no line \"Memo.\".",
           "the 17 lines of a K-NET header", "get the file anew from its source");
}

double number_of(const RecordText& text, const Stated<std::string_view>& value, std::string_view what)
{
    const auto number = parse_number(value.value); // "100Hz": what follows is glued to it
    if (!number || !(*number > 0.0))
        refuse(text, {value.line, label_width + 1},
               fmt::format("{} {} is not understood.", what, in_quotes(value.value)), "a number above zero",
               "get the file anew from its source");
    return *number;
}

/// gal per count of "3920(gal)/6182761".
double scale_factor(const RecordText& text, const Stated<std::string_view>& value)
{
    const std::string s = lower(value.value);
    std::size_t used = 0;
    const auto numerator = parse_number(s, &used);
    const std::size_t slash = s.find('/');
    const double denominator = slash == std::string::npos ? 0.0 : parse_number(s.substr(slash + 1)).value_or(0.0);
    const bool gal = numerator && trimmed(std::string_view(s).substr(used)).starts_with("(gal)");
    if (!gal || !(*numerator > 0.0 && denominator > 0.0))
        refuse(text, {value.line, label_width + 1}, fmt::format("the scale factor {} is not understood.", in_quotes(s)),
               "\"3920(gal)/6182761\"", "get the file anew from its source");
    return *numerator / denominator;
}

struct Direction {
    std::string name;
    bool borehole;
};

Direction direction_of(const RecordText& text, const Stated<std::string_view>& value)
{
    static constexpr const char* names[] = {"N-S", "E-W", "U-D"};
    const std::string s = lower(value.value);
    if (s == "n-s" || s == "e-w" || s == "u-d") return {names[s == "n-s" ? 0 : s == "e-w" ? 1 : 2], false};
    const auto number = parse_whole_number_text(s);
    for (int k = 1; k <= 6; ++k)
        if (number == k) return {fmt::format("{} {}", names[(k - 1) % 3], k <= 3 ? "borehole" : "surface"), k <= 3};
    refuse(text, {value.line, label_width + 1}, fmt::format("the direction {} is not known.", in_quotes(value.value)),
           "N-S, E-W, U-D, or 1 to 6", "get the file anew from its source");
}

/// Blanks separate the counts.
std::vector<double> read_counts(const RecordText& text, std::size_t first, const Stated<std::size_t>& count)
{
    std::vector<double> counts;
    counts.reserve(std::min(count.value, 20 * text.lines.size()));
    for (std::size_t line = first; line <= text.lines.size(); ++line) {
        const std::string_view s = text.lines[line - 1];
        for (std::size_t at = 0; (at = s.find_first_not_of(" \t", at)) != std::string_view::npos;) {
            std::size_t used = 0;
            const Place place{line, at + 1};
            counts.push_back(number_at(text, s.substr(at), place, used));
            at += used;
            if (at < s.size() && s[at] != ' ' && s[at] != '\t' && s[at] != '-')
                refuse(text, place, fmt::format("{} is not a number.", in_quotes(s.substr(place.column - 1, 20))),
                       "counts separated by blanks", "correct it");
            if (counts.size() > count.value) return counts; // check_count names the number so far
        }
    }
    return counts;
}

/// Takes the mean of the quiet start off. @returns it
double remove_offset(std::vector<double>& accel, double dt)
{
    std::size_t quiet = accel.size();
    if (static_cast<double>(accel.size()) * dt >= shortest_with_quiet_start)
        quiet = std::min(quiet, static_cast<std::size_t>(offset_seconds / dt));
    double sum = 0.0;
    for (std::size_t k = 0; k < quiet; ++k) sum += accel[k];
    const double offset = sum / static_cast<double>(quiet);
    for (double& a : accel) a -= offset;
    return offset;
}

} // namespace

/// Line 1 starts with "Origin Time".
bool looks_like_k_net(const RecordText& text)
{
    return text.lines.front().starts_with("Origin Time");
}

/// K-NET and KiK-net ASCII of NIED, Japan: 17 lines with labels in their first 18 columns, then counts of the recorder.
/// Acceleration [gal] = count * "Scale Factor 3920(gal)/6182761" minus the offset of the sensor, which is the mean of
/// the first 10 s: the recorder keeps 15 s from before the trigger. Records under 20 s: the mean of all.
/// Directions: N-S, E-W, U-D positive north, east, up; 1 to 3 the same in the borehole, 4 to 6 at the surface.
/// @throws InputError: a missing line, a factor that is not understood, a number of samples that is not frequency times
/// duration.
std::vector<Record> read_k_net(const RecordText& text, const ReadOptions& options)
{
    const std::size_t header = k_net_header_size(text);
    const auto value = [&](std::string_view label) { return value_of(text, header, label); };
    const AccelerationUnit unit = settle_unit(text, Stated<std::string>{"gal", value("scale factor").line}, options);
    const double gal = scale_factor(text, value("scale factor"));
    const auto frequency = value("sampling freq"), duration = value("duration time");
    const double hertz = number_of(text, frequency, "the sampling frequency");
    const double dt = *settle_dt(text, Stated<double>{1.0 / hertz, frequency.line}, options);
    const double samples = hertz * number_of(text, duration, "the duration");
    const Stated<std::size_t> count{checked_sample_count(text, std::round(samples), {duration.line, 0},
                                                         "number of samples (frequency times duration)"),
                                    duration.line};
    const Direction direction = direction_of(text, value("dir."));

    std::vector<double> accel = read_counts(text, header + 1, count);
    const std::string open_end = refuse_cut_end(text, header + 1);
    check_count(text, count, accel.size(), "number of samples (frequency times duration)");
    for (double& a : accel) a = checked_sample(text, a * gal, unit, {header + 1, 0});
    const double offset = remove_offset(accel, dt);

    RecordSource source;
    source.format = "K-NET/KiK-net";
    source.unit = unit.name;
    source.component = direction.name;
    source.title = fmt::format("{}, station {}", value("origin time").value, value("station code").value);
    source.first_line = header + 1;
    source.last_line = text.lines.size();
    Record record = finished_record(text, std::move(accel), dt, std::move(source));
    if (!open_end.empty()) record.warnings.push_back(open_end);
    record.warnings.push_back(fmt::format(
        "sensor offset of {:.4g} m/s2 taken off: the mean of {}", offset,
        record.duration() + dt >= shortest_with_quiet_start ? "the first 10 s" : "the record (under 20 s)"));
    if (direction.borehole) record.warnings.push_back("recorded in a borehole, not at the surface");
    const auto peak = value("max. acc");
    if (const auto stated = parse_number(peak.value))
        check_stated_peak(text, record, {*stated * unit.factor, 0.001 * unit.factor, peak.line});
    std::vector<Record> records;
    records.push_back(std::move(record));
    return chosen_channels(text, std::move(records), options);
}

RecordFormat k_net_format()
{
    return {"K-NET/KiK-net", looks_like_k_net, read_k_net};
}

} // namespace damslip::records
