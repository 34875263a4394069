#include "records/read/format.hpp"

#include "core/text.hpp"
#include "records/read/agency_samples.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

/// Integer and real header of one channel, with the line of their first values.
struct Block {
    std::vector<double> values;
    FieldFormat format;
    std::size_t first = 0, after = 0; ///< lines

    double at(std::size_t k) const { return k < values.size() ? values[k] : -999.0; }
    Place place(std::size_t k) const { return place_of(format, first, k); }
};

struct CosmosChannel {
    std::size_t first = 0; ///< its line 1
    Block integers, reals;
    double unknown_integer = -999.0, unknown_real = -999.0;
    std::size_t data_line = 0; ///< the line "7000 acceleration pts, ..., Format=(8F10.5)"
};

bool starts_channel(std::string_view line)
{
    return contains(lower(line.substr(0, 200)), "(format v");
}

/// First line from `from` on that contains `words`, at most `within` lines away.
std::size_t line_with(const RecordText& text, std::size_t from, std::size_t within, std::string_view words)
{
    for (std::size_t line = from; line <= text.lines.size() && line < from + within; ++line)
        if (contains(lower(text.lines[line - 1].substr(0, 200)), words)) return line;
    refuse(text, {std::min(from, text.lines.size()), 0}, fmt::format("no line with \"{}\" follows.", words),
           fmt::format("it within {} lines", within), "the file looks cut or changed: get it anew from its source");
}

/// The block under its line "100 Integer-header values follow on 10 lines, Format= (10I8)".
Block read_block(const RecordText& text, std::size_t line, std::string_view what)
{
    const std::string_view s = text.lines[line - 1];
    const auto count = parse_number(s);
    const auto format = field_format(s);
    if (!count || !(*count >= 1.0 && *count <= 1000.0) || *count != std::floor(*count) || !format)
        refuse(text, {line, 0}, fmt::format("{} is not understood.", in_quotes(trimmed(s))),
               "\"100 Integer-header values follow on 10 lines, Format= (10I8)\"", "get the file anew from its source");
    Block block;
    block.format = *format;
    block.first = line + 1;
    block.values = read_fields(text, block.first, static_cast<std::size_t>(*count), *format);
    check_count(text, {static_cast<std::size_t>(*count), line}, block.values.size(), what);
    block.after = line_after(*format, block.first, block.values.size());
    return block;
}

/// "Values used when parameter or data value is unknown/unspecified:   -999, -999.0"
void read_unknowns(const RecordText& text, std::size_t line, CosmosChannel& channel)
{
    const std::string_view s = text.lines[line - 1];
    const std::size_t colon = s.find(':');
    if (!contains(lower(s), "unknown") || colon == std::string_view::npos) return;
    std::size_t used = 0;
    const auto integer = parse_number(s.substr(colon + 1), &used);
    if (!integer) return;
    channel.unknown_integer = channel.unknown_real = *integer;
    const std::size_t comma = s.find(',', colon + 1 + used);
    if (comma == std::string_view::npos) return;
    if (const auto real = parse_number(s.substr(comma + 1))) channel.unknown_real = *real;
}

CosmosChannel read_channel_header(const RecordText& text, std::size_t first)
{
    CosmosChannel channel;
    channel.first = first;
    const std::size_t integers = line_with(text, first + 1, 40, "integer-header values");
    read_unknowns(text, integers - 1, channel);
    channel.integers = read_block(text, integers, "number of integers");
    const std::size_t reals = line_with(text, channel.integers.after, 3, "real-header values");
    channel.reals = read_block(text, reals, "number of reals");
    const std::size_t comments = line_with(text, channel.reals.after, 3, "comment");
    const auto count = parse_number(text.lines[comments - 1]).value_or(0.0);
    if (!(count >= 0.0 && count <= static_cast<double>(text.lines.size())))
        refuse(text, {comments, 0}, "the number of comment lines is not understood.", "\"2 Comment line(s) follow\"",
               "correct the line");
    channel.data_line = line_with(text, comments + 1 + static_cast<std::size_t>(count), 3, "pts");
    return channel;
}

std::string unit_of_code(double code)
{
    const int whole = std::abs(code) < 1000.0 ? static_cast<int>(code) : 0;
    switch (whole) {
    case 2:
        return "g";
    case 4:
        return "cm/s2";
    case 7:
        return "in/s2";
    case 10:
        return "gal";
    case 11:
        return "mg";
    case 12:
        return "micro-g";
    default:
        return "";
    }
}

/// The unit by its code in the integer header and in "units=cm/sec2(04)" of the data line.
AccelerationUnit unit_of(const RecordText& text, const CosmosChannel& channel, const ReadOptions& options)
{
    const std::string_view line = text.lines[channel.data_line - 1];
    double code = channel.integers.at(2);
    Place place = channel.integers.place(2);
    const std::size_t units = lower(line).find("units=");
    const std::size_t bracket = units == std::string::npos ? units : line.find('(', units);
    if (bracket != std::string_view::npos) {
        const auto in_line = parse_number(line.substr(bracket + 1));
        if (in_line && code != channel.unknown_integer && *in_line != code)
            refuse(text, {channel.data_line, 0},
                   fmt::format("unit code {} here, but {} in the integer header (line {}).", shortest(*in_line),
                               shortest(code), place.line),
                   "one unit", "correct one of them");
        if (in_line) code = *in_line, place = {channel.data_line, bracket + 2};
    }
    if (code == 50.0 || code == 51.0 || code == 22.0)
        refuse(text, place, "the samples are counts or volts of the recorder (volume 0).",
               "an acceleration: unit code 2 (g), 4 (cm/s2), 7 (in/s2), 10 (gal), 11 (mg) or 12 (micro-g)",
               "take the volume 1 or 2 file of the record");
    const std::string name = unit_of_code(code);
    if (name.empty())
        refuse(text, place, fmt::format("unit code {} is no unit of acceleration.", shortest(code)),
               "2 (g), 4 (cm/s2), 7 (in/s2), 10 (gal), 11 (mg) or 12 (micro-g)",
               "take the acceleration file of the record");
    return settle_unit(text, Stated<std::string>{name, place.line}, options);
}

/// Azimuth to true north, else to the structure, else the words of text line 9.
std::string component_of(const RecordText& text, const CosmosChannel& channel)
{
    for (const std::size_t k : {std::size_t{53}, std::size_t{54}}) {
        const double angle = channel.integers.at(k);
        const std::string_view to = k == 54 ? " to the structure" : "";
        if (angle >= 1.0 && angle <= 360.0) return fmt::format("{} deg{}", static_cast<int>(angle), to);
        if (angle == 400.0) return "up";
        if (angle == 401.0) return "down";
        if (angle == 402.0) return "vertical, sense unknown";
        if (angle == 500.0) return "radial, inward";
        if (angle == 501.0) return "transverse";
        if (angle == 600.0) return "longitudinal";
        if (angle == 601.0) return "tangential";
        if (angle == 700.0) return "H1, azimuth unknown";
        if (angle == 701.0) return "H2, azimuth unknown";
    }
    const std::size_t line = channel.first + 8;
    if (line <= text.lines.size() && contains(lower(text.lines[line - 1]), "cha")) {
        const std::string_view s = text.lines[line - 1].substr(0, 40);
        const std::size_t colon = s.rfind(':', 20);
        if (colon != std::string_view::npos)
            return std::string(trimmed(s.substr(colon + 1, s.find('(', colon) - colon - 1)));
    }
    return "";
}

void warn_of_site(const CosmosChannel& channel, Record& record)
{
    static constexpr struct {
        int code;
        const char* name;
    } structures[] = {{10, "a building"}, {11, "a bridge"},         {12, "a dam"},
                      {13, "a wharf"},    {14, "a tunnel or adit"}, {15, "a lifeline structure"},
                      {20, "a structure"}};
    for (const auto& structure : structures)
        if (channel.integers.at(18) == structure.code)
            record.warnings.push_back(
                fmt::format("recorded on {} (station type {}): perhaps not the motion of the free "
                            "field",
                            structure.name, structure.code));
    if (channel.integers.at(75) == 2.0)
        record.warnings.push_back("the file marks this record with an unfixed problem; see its comments");
}

/// Length is npts dt by the format's definition and (npts - 1) dt in many files; anything else is a warning.
void warn_of_length(const CosmosChannel& channel, double dt, Record& record)
{
    const double length = channel.reals.at(62);
    if (length == channel.unknown_real) return;
    const double n = static_cast<double>(record.acceleration.size());
    if (std::abs(length - n * dt) > 1.5 * dt && std::abs(length - (n - 1.0) * dt) > 1.5 * dt)
        record.warnings.push_back(fmt::format("the header says {} s, but {} samples of {} s are there", length, n, dt));
}

/// Real header value 64: the largest of the samples, in their unit; of either sign. Zero and "unknown" say nothing.
void check_peak(const RecordText& text, const CosmosChannel& channel, const AccelerationUnit& unit, Record& record)
{
    const double peak = channel.reals.at(63);
    if (peak == channel.unknown_real || peak == 0.0) return;
    check_stated_peak(text, record,
                      {peak * unit.factor, 0.001 * std::abs(peak) * unit.factor, channel.reals.place(63).line});
}

Record read_channel(const RecordText& text, const CosmosChannel& channel, const ReadOptions& options)
{
    const AccelerationUnit unit = unit_of(text, channel, options);
    const Place dt_place = channel.reals.place(61);
    const double dt_ms = channel.reals.at(61);
    if (dt_ms == channel.unknown_real)
        refuse(text, dt_place, "the time step of the samples (real header value 62) is not stated.", "milliseconds",
               "fill it in; it may differ from the recorder's (value 34)");
    const double dt = *settle_dt(text, Stated<double>{0.001 * dt_ms, dt_place.line}, options);

    const std::string_view line = text.lines[channel.data_line - 1];
    const auto format = field_format(line);
    const auto stated = parse_number(line);
    if (!format || !stated)
        refuse(text, {channel.data_line, 0}, fmt::format("{} is not understood.", in_quotes(trimmed(line))),
               "\"7000 acceleration pts, approx 70 secs, units=cm/sec2(04),Format=(8F10.5)\"",
               "get the file anew from its source");
    const Stated<std::size_t> count{checked_sample_count(text, *stated, {channel.data_line, 0}, "number of samples"),
                                    channel.data_line};
    const std::size_t first = channel.data_line + 1;
    const std::vector<double> values = read_fields(text, first, count.value, *format);
    check_count(text, count, values.size(), "number of samples");
    demand_end_of_block(text, line_after(*format, first, count.value), count, "number of samples");

    RecordSource source;
    source.format = channel.integers.at(0) == 1.0 ? "COSMOS volume 1" : "COSMOS volume 2";
    source.unit = unit.name;
    source.component = component_of(text, channel);
    source.title = trimmed(text.lines[channel.first]);
    if (channel.first + 4 <= text.lines.size())
        source.title += ", " + std::string(trimmed(text.lines[channel.first + 3]));
    source.first_line = first;
    source.last_line = line_after(*format, first, count.value) - 1;
    Record record = finished_record(text, samples_of(text, values, unit, *format, first, channel.unknown_real), dt,
                                    std::move(source));
    check_peak(text, channel, unit, record);
    warn_of_length(channel, dt, record);
    warn_of_site(channel, record);
    return record;
}

} // namespace

/// Line 1 has "(Format v".
bool looks_like_cosmos(const RecordText& text)
{
    return starts_channel(text.lines.front());
}

/// COSMOS strong-motion format 1.20, volumes 1 and 2: for each channel text lines, integer and real header and comments
/// with their counts and Fortran formats, then acceleration (volume 2: and velocity, displacement, which are passed over).
/// Read by the widths of the formats, not by blanks. Numbering of header values from 0, as in the sources:
/// integer 0 volume, 1 quantity (1: acceleration), 2 unit, 18 kind of structure, 53 azimuth, 75 problem; real 61 time
/// step of the samples in ms (33, in s, is the recorder's), 62 length in s. "COSMOS Strong Motion Data Format" (2001);
/// Consortium of Organizations for Strong-Motion Observation Systems, tables.
/// @throws InputError: raw counts (volume 0), no channel of acceleration, unknown unit, unit code of header and data
/// line that differ, gaps ("unknown" of text line 13), a number of samples that is not the stated one.
std::vector<Record> read_cosmos(const RecordText& text, const ReadOptions& options)
{
    std::vector<Record> records;
    std::vector<std::string> skipped;
    for (std::size_t line = 1; line <= text.lines.size(); ++line) {
        if (!starts_channel(text.lines[line - 1])) continue;
        const CosmosChannel channel = read_channel_header(text, line);
        const double quantity = channel.integers.at(1);
        const bool acceleration = quantity == 1.0 || (quantity == channel.unknown_integer &&
                                                      contains(lower(text.lines[line - 1]), "acceleration"));
        if (acceleration)
            records.push_back(read_channel(text, channel, options));
        else
            skipped.push_back(fmt::format("the channel of line {} passed over: it holds no acceleration (quantity {})",
                                          line, shortest(quantity)));
        line = channel.data_line;
    }
    if (records.empty())
        refuse(text, {1, 0}, "the file holds no acceleration.", "quantity 1 in the second value of the integer header",
               "take the acceleration file of the record");
    for (const std::string& note : skipped) records.front().warnings.push_back(note);
    return chosen_channels(text, std::move(records), options);
}

RecordFormat cosmos_format()
{
    return {"COSMOS", looks_like_cosmos, read_cosmos};
}

} // namespace damslip::records
