#include "core/text.hpp"
#include "records/read/agency_samples.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"

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

namespace {

constexpr std::size_t header_lines = 10; // keywords are looked for in so many

bool names_npts_and_dt(std::string_view line)
{
    const std::string s = lower(line);
    return !is_comment(line) && contains(s, "npts") && contains(s, "dt");
}

struct PeerHeader {
    Stated<std::size_t> samples;
    Stated<double> dt;
    std::optional<Stated<std::string>> unit;
    std::string title;
};

/// Number after "key =" in the line, or nothing; `rest`: what follows it.
std::optional<double> assigned(std::string_view line, std::string_view key, std::string_view& rest)
{
    const std::size_t at = lower(line).find(key);
    const std::size_t equals = line.find_first_not_of(" \t", at + key.size());
    if (equals == std::string_view::npos || line[equals] != '=') return std::nullopt;
    std::size_t used = 0;
    const auto value = parse_number(line.substr(equals + 1), &used);
    if (value) rest = line.substr(equals + 1 + used);
    return value;
}

void read_npts_and_dt(const RecordText& text, std::size_t line, PeerHeader& header)
{
    const std::string_view s = text.lines[line - 1];
    std::string_view rest;
    std::optional<double> npts = assigned(s, "npts", rest), dt = assigned(s, "dt", rest);
    if (!npts && !dt) { // "3930 0.00500 NPTS, DT"
        std::size_t used = 0;
        if ((npts = parse_number(s, &used))) {
            rest = s.substr(used);
            rest.remove_prefix(std::min(rest.size(), std::min(rest.find_first_not_of(" \t,"), rest.size())));
            dt = parse_number(rest, &used);
        }
        rest = {};
    }
    const auto fail = [&](std::string problem) {
        refuse(text, {line, 0}, std::move(problem), "\"NPTS=  3930, DT= .00500 SEC\" or \"3930 0.00500 NPTS, DT\"",
               "correct the line");
    };
    if (!npts || !dt) fail(fmt::format("no number for {} in {}.", npts ? "DT" : "NPTS", in_quotes(trimmed(s))));
    if (!(*npts >= 2.0 && *npts <= static_cast<double>(max_samples)) || *npts != std::floor(*npts))
        fail(fmt::format("NPTS = {} is not allowed: a whole number from 2 to {} is.", shortest(*npts), max_samples));
    const std::string unit = lower(trimmed(rest)).substr(0, 4);
    if (!unit.empty() && unit.front() != 's' && unit.front() != ',' && unit.front() != '.')
        fail(fmt::format("DT is followed by {}, not by SEC.", in_quotes(trimmed(rest))));
    header.samples = {static_cast<std::size_t>(*npts), line};
    header.dt = {*dt, line};
}

/// The line "ACCELERATION TIME HISTORY IN UNITS OF G", last one above the samples.
void read_quantity(const RecordText& text, std::size_t last, PeerHeader& header)
{
    for (std::size_t line = last; line >= 1; --line) {
        const std::string s = lower(text.lines[line - 1]);
        const bool other = contains(s, "velocity") || contains(s, "displacement");
        const bool accel = contains(s, "acceleration");
        if (!accel && !other) continue;
        const std::size_t units = s.find("units of");
        if (other && !accel && (units != std::string::npos || contains(s, "time")))
            refuse(text, {line, 0},
                   fmt::format("{}: this file holds no acceleration.", in_quotes(trimmed(text.lines[line - 1]))),
                   "an acceleration file (.AT2); .VT2 and .DT2 are its integrals",
                   "download the .AT2 file of the same record");
        if (!accel) continue;
        if (units != std::string::npos)
            header.unit = Stated<std::string>{std::string(trimmed(text.lines[line - 1].substr(units + 8))), line};
        return;
    }
}

/// All numbers from `first` on, stuck negatives ("1.2-5.6") split.
std::vector<double> read_values(const RecordText& text, std::size_t first, const AccelerationUnit& unit,
                                std::size_t expected)
{
    std::vector<double> accel;
    accel.reserve(expected);
    for (std::size_t line = first; line <= text.lines.size(); ++line) {
        const std::string_view s = text.lines[line - 1];
        for (std::size_t at = 0; (at = s.find_first_not_of(" \t", at)) != std::string_view::npos;) {
            std::size_t used = 0;
            const Place place{line, at + 1};
            const double value = number_at(text, s.substr(at), place, used);
            const std::size_t end = at + used;
            if (end < s.size() && std::string_view(" \t-+").find(s[end]) == std::string_view::npos)
                refuse(text, place,
                       fmt::format("{} is not a number.", in_quotes(s.substr(at, s.find_first_of(" \t", at) - at))),
                       "numbers separated by blanks", "correct it");
            accel.push_back(checked_sample(text, value, unit, place));
            at = end;
        }
        if (accel.size() > max_samples) break; // check_count names the number so far
    }
    return accel;
}

} // namespace

/// One of the first ten lines (not a # comment) names NPTS and DT.
bool looks_like_peer_at2(const RecordText& text)
{
    const auto end = text.lines.begin() + static_cast<std::ptrdiff_t>(std::min(header_lines, text.lines.size()));
    return std::any_of(text.lines.begin(), end, names_npts_and_dt);
}

/// PEER strong-motion text file: some lines of title, one naming quantity and unit, one with the number of samples and
/// the time step as "NPTS=  3930, DT= .00500 SEC" or "3930 0.00500 NPTS, DT", then samples, any number to a line,
/// negatives possibly stuck together. An older header repeated on top holds another DT: the last such line of the first
/// ten counts.
/// @throws InputError: velocity or displacement, NPTS that is not the number of values, anything that is no number.
std::vector<Record> read_peer_at2(const RecordText& text, const ReadOptions& options)
{
    std::size_t last = std::min(header_lines, text.lines.size());
    while (last > 1 && !names_npts_and_dt(text.lines[last - 1])) --last;
    PeerHeader header;
    read_npts_and_dt(text, last, header);
    read_quantity(text, last, header);
    if (last >= 3) header.title = trimmed(text.lines[last - 3]);

    const AccelerationUnit unit = settle_unit(text, header.unit, options);
    const double dt = *settle_dt(text, header.dt, options);
    std::vector<double> accel = read_values(text, last + 1, unit, header.samples.value);
    check_count(text, header.samples, accel.size(), "NPTS");
    const std::string open_end = refuse_cut_end(text, last + 1);

    RecordSource source;
    source.format = "PEER AT2";
    source.unit = unit.name;
    source.title = header.title;
    const std::size_t comma = header.title.rfind(',');
    if (comma != std::string::npos && header.title.size() - comma <= 12)
        source.component = trimmed(std::string_view(header.title).substr(comma + 1));
    source.first_line = last + 1;
    source.last_line = text.lines.size();
    std::vector<Record> records{finished_record(text, std::move(accel), dt, std::move(source))};
    if (!open_end.empty()) records.front().warnings.push_back(open_end);
    return chosen_channels(text, std::move(records), options);
}

RecordFormat peer_at2_format()
{
    return {"PEER AT2", looks_like_peer_at2, read_peer_at2};
}

namespace {

/// Lines with a colon at the start of the file.
std::size_t esm_header_size(const RecordText& text)
{
    std::size_t k = 0;
    while (k < text.lines.size() && k < 200 && contains(text.lines[k], ":")) ++k;
    return k;
}

/// The value of a key, perhaps empty, with its line; nothing where there is no such key.
std::optional<Stated<std::string_view>> find(const RecordText& text, std::size_t header, std::string_view key)
{
    for (std::size_t k = 0; k < header; ++k) {
        const std::string_view s = text.lines[k];
        const std::size_t colon = s.find(':');
        if (lower(trimmed(s.substr(0, colon))) == key)
            return Stated<std::string_view>{trimmed(s.substr(colon + 1)), k + 1};
    }
    return std::nullopt;
}

double number_of(const RecordText& text, std::size_t header, std::string_view key)
{
    const auto value = find(text, header, key);
    const auto number = value ? parse_whole_number_text(value->value) : std::nullopt;
    std::string name(key);
    for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (!number)
        refuse(text, {value ? value->line : 1, 0},
               value ? fmt::format("{} is {}, no number.", name, in_quotes(value->value))
                     : fmt::format("the header has no line {}.", name),
               fmt::format("\"{}: <number>\"", name), "get the file anew from its source");
    return *number;
}

void demand_acceleration(const RecordText& text, std::size_t header)
{
    const auto type = find(text, header, "data_type");
    if (!type || type->value.empty()) return; // the unit decides
    const std::string s = lower(type->value);
    if (s != "acceleration" && s != "acc")
        refuse(text, {type->line, 0}, fmt::format("the file holds {}.", in_quotes(type->value)),
               "DATA_TYPE: ACCELERATION", "take the acceleration file of the record (.ACC.MP.ASC and the like)");
}

/// The unit that the key of the peak names itself, whatever the line UNITS says: "PGA_CM/S^2".
std::optional<AccelerationUnit> unit_of_key(std::string_view line)
{
    return acceleration_unit(trimmed(line.substr(4, line.find(':') - 4)));
}

std::vector<double> read_values(const RecordText& text, std::size_t first, const AccelerationUnit& unit)
{
    std::vector<double> accel;
    for (std::size_t line = first; line <= text.lines.size(); ++line) {
        const std::string_view s = text.lines[line - 1];
        if (trimmed(s).empty()) continue;
        const Place place{line, s.find_first_not_of(" \t") + 1};
        std::size_t used = 0;
        const double value = number_at(text, s, place, used);
        if (!trimmed(s.substr(used)).empty())
            refuse(text, place, fmt::format("{} is not one number.", in_quotes(trimmed(s))), "one value a line",
                   "correct it");
        accel.push_back(checked_sample(text, value, unit, place));
    }
    return accel;
}

} // namespace

/// Line 1 starts with "EVENT_NAME:".
bool looks_like_esm(const RecordText& text)
{
    return trimmed(text.lines.front()).starts_with("EVENT_NAME:");
}

/// ESM and ITACA ASCII (header format DYNA): lines "KEY: value", split at the first colon, many of them empty; then one
/// sample a line. NDATA, SAMPLING_INTERVAL_S, UNITS and DATA_TYPE count; STREAM is the component.
/// Luzi et al. (2016), Engineering Strong Motion Database.
/// @throws InputError: velocity, displacement, spectra (the same header), a missing key, NDATA that is not the number of
/// values.
std::vector<Record> read_esm(const RecordText& text, const ReadOptions& options)
{
    const std::size_t header = esm_header_size(text);
    demand_acceleration(text, header);
    std::optional<Stated<std::string>> stated_unit;
    if (const auto unit = find(text, header, "units"); unit && !unit->value.empty())
        stated_unit = Stated<std::string>{std::string(unit->value), unit->line};
    const AccelerationUnit unit = settle_unit(text, stated_unit, options);
    const auto dt_line = find(text, header, "sampling_interval_s");
    const double dt = *settle_dt(
        text, Stated<double>{number_of(text, header, "sampling_interval_s"), dt_line ? dt_line->line : 1}, options);
    const auto count_line = find(text, header, "ndata");
    const Place count_place{count_line ? count_line->line : 1, 0};
    const Stated<std::size_t> count{checked_sample_count(text, number_of(text, header, "ndata"), count_place, "NDATA"),
                                    count_place.line};
    std::vector<double> accel = read_values(text, header + 1, unit);
    const std::string open_end = refuse_cut_end(text, header + 1);
    check_count(text, count, accel.size(), "NDATA");

    const auto words = [&](std::string_view key) {
        const auto value = find(text, header, key);
        return value ? std::string(value->value) : std::string();
    };
    RecordSource source;
    source.format = "ESM/ITACA";
    source.unit = unit.name;
    source.component = words("stream");
    source.title = words("event_name");
    if (!words("station_code").empty())
        source.title += (source.title.empty() ? "station " : ", station ") + words("station_code");
    source.first_line = header + 1;
    source.last_line = text.lines.size();
    Record record = finished_record(text, std::move(accel), dt, std::move(source));
    if (!open_end.empty()) record.warnings.push_back(open_end);
    for (std::size_t k = 0; k < header; ++k) // "PGA_CM/S^2: -46.4"
        if (lower(text.lines[k]).starts_with("pga_")) {
            const AccelerationUnit peak_unit = unit_of_key(text.lines[k]).value_or(unit);
            if (const auto stated = parse_whole_number_text(text.lines[k].substr(text.lines[k].find(':') + 1)))
                check_stated_peak(text, record, {*stated * peak_unit.factor, 0.001 * peak_unit.factor, k + 1});
        }
    std::vector<Record> records;
    records.push_back(std::move(record));
    return chosen_channels(text, std::move(records), options);
}

RecordFormat esm_format()
{
    return {"ESM/ITACA ASCII", looks_like_esm, read_esm};
}

} // namespace damslip::records
