#include "core/text.hpp"
#include "records/read/agency_samples.hpp"
#include "records/read/read_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

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

namespace {

constexpr std::size_t text_lines = 11, integer_count = 48, real_count = 50;
constexpr FieldFormat integer_format{8, 10}, real_format{5, 15}, sample_format{8, 10};
constexpr std::size_t integer_line = text_lines + 1, real_line = integer_line + 6, comment_line = real_line + 10;

struct SmcHeader {
    std::vector<double> integers, reals;

    /// Nothing where the file has its code for "missing".
    std::optional<double> integer(std::size_t k) const
    {
        return integers[k] == integers[0] && k > 0 ? std::nullopt : std::optional(integers[k]);
    }
};

SmcHeader read_header(const RecordText& text)
{
    SmcHeader header;
    header.integers = read_fields(text, integer_line, integer_count, integer_format);
    check_count(text, {integer_count, std::min(integer_line, text.lines.size())}, header.integers.size(),
                "number of integers in the header");
    header.reals = read_fields(text, real_line, real_count, real_format);
    check_count(text, {real_count, std::min(real_line, text.lines.size())}, header.reals.size(),
                "number of reals in the header");
    return header;
}

/// Line 1 names the volume: 1 and 2 hold acceleration.
void demand_acceleration(const RecordText& text)
{
    const std::string first = lower(trimmed(text.lines.front()));
    if (first == "*")
        refuse(text, {1, 0}, "the file does not say what it holds (line 1 is \"*\").",
               "\"1 UNCORRECTED ACCELEROGRAM\" or \"2 CORRECTED ACCELEROGRAM\"",
               "write the line in if you know that these are accelerations in cm/s2");
    if (!contains(first, "accelerogram"))
        refuse(text, {1, 0}, fmt::format("{}: this file holds no acceleration.", in_quotes(trimmed(text.lines[0]))),
               "\"1 UNCORRECTED ACCELEROGRAM\" or \"2 CORRECTED ACCELEROGRAM\"",
               "take the acceleration file of the record");
}

/// "component=    360" of text line 6, else the orientation of the integer header.
std::string component_of(const RecordText& text, const SmcHeader& header)
{
    const std::string_view line = text.lines[5];
    const std::size_t at = lower(line).find("component=");
    if (at != std::string::npos && !trimmed(line.substr(at + 10)).empty())
        return std::string(trimmed(line.substr(at + 10)));
    const auto vertical = header.integer(12), horizontal = header.integer(13);
    if (vertical == 0.0) return "up";
    if (vertical == 180.0) return "down";
    return horizontal ? shortest(*horizontal) : "";
}

std::string title_of(const RecordText& text)
{
    const std::string_view event = text.lines[3], station = text.lines[5];
    std::string title(trimmed(event.substr(std::min<std::size_t>(event.size(), 25))));
    const std::size_t equals = station.find('=');
    if (equals != std::string_view::npos) {
        const std::size_t end = lower(station).find("component=");
        title +=
            ", " + std::string(trimmed(station.substr(equals + 1, end == std::string::npos ? end : end - equals - 1)));
    }
    std::erase(title, '\0');
    return title;
}

void warn_of_site(const SmcHeader& header, Record& record)
{
    if (header.integer(17) == 1.0)
        record.warnings.push_back("the file marks this record with a problem; see its comments");
    if (header.integer(18) == 3.0) {
        static constexpr std::array<const char*, 4> places{"in the free field upstream or downstream", "at the base",
                                                           "on the crest", "on the abutment"};
        const double place = header.integer(27).value_or(-1.0);
        const bool known = place >= 0.0 && place <= 3.0;
        const char* where = known ? places[static_cast<std::size_t>(place)] : "at an unknown place";
        if (place != 0.0)
            record.warnings.push_back(fmt::format("recorded {} of a dam: not the motion of the free field", where));
    } else if (header.integer(18) == 1.0) {
        record.warnings.push_back("recorded in a building: perhaps not the motion of the free field");
    } else if (header.integer(18) == 2.0 && header.integer(26).value_or(0.0) != 0.0) {
        record.warnings.push_back("recorded on a bridge: not the motion of the free field");
    }
}

/// Real header values 30 and 32: the largest and the smallest sample, in cm/s2.
void check_peak(const RecordText& text, const SmcHeader& header, const AccelerationUnit& unit, Record& record)
{
    const double missing = header.reals[0], largest = header.reals[29], smallest = header.reals[31];
    if (largest == missing || smallest == missing || (largest == 0.0 && smallest == 0.0)) return;
    const double peak = std::max(std::abs(largest), std::abs(smallest));
    check_stated_peak(text, record, {peak * unit.factor, 0.001 * peak * unit.factor, real_line + 29 / 5});
}

} // namespace

/// Line 1 is "2 CORRECTED ACCELEROGRAM" or another volume of the format, or a lone "*" with the header blocks below.
bool looks_like_smc(const RecordText& text)
{
    const std::string first = lower(trimmed(text.lines.front().substr(0, 80)));
    const bool volume = first.size() > 2 && first[0] >= '0' && first[0] <= '9' && first[1] == ' ';
    if (volume && (contains(first, "accelerogram") || first.ends_with(" velocity") ||
                   first.ends_with(" displacement") || contains(first, "spectr")))
        return true;
    return first == "*" && text.lines.size() > comment_line && trimmed(text.lines[text_lines - 1]) == "*";
}

/// SMC format of the U.S. Geological Survey: 11 text lines, 48 integers (8I10), 50 reals (5E15.7), as many comment lines
/// as the integer header says, samples in cm/s^2 (8 fields of 10). Header values from 0, row by row: integer 0 code of
/// missing integers, 12 and 13 vertical and horizontal orientation, 15 comment lines, 16 samples
/// (values, where the rate is missing: pairs of time and acceleration), 17 problem flag,
/// 18 kind of structure (3: dam), 27 place on a dam; real 0 code of missing reals, 1 samples per second.
/// USGS Open-File Report 92-296-A (Converse 1992: BAP), appendix.
/// @throws InputError: velocity, displacement, spectra, no volume stated, an impossible sampling rate, gaps.
std::vector<Record> read_smc(const RecordText& text, const ReadOptions& options)
{
    demand_acceleration(text);
    if (text.lines.size() <= comment_line)
        refuse(text, {text.lines.size(), 0}, "the file ends within its header.",
               fmt::format("{} lines of header, then comments and samples", comment_line - 1),
               "the file looks cut: get it anew from its source");
    const SmcHeader header = read_header(text);
    const AccelerationUnit unit = settle_unit(text, Stated<std::string>{"cm/s2", 1}, options);

    // Film that was digitised has no rate: its header says "missing", and times stand beside the samples.
    const double rate = header.reals[1];
    const bool pairs = rate == header.reals[0];
    if (!pairs && !(rate >= 1.0 && rate <= 1e6))
        refuse(text, {real_line, 16}, fmt::format("{} samples per second are not possible.", shortest(rate)),
               "1 to 1e6, or the file's code for \"missing\" where times stand beside the samples",
               "correct the second value of the real header");
    double dt = pairs ? 0.0 : *settle_dt(text, Stated<double>{1.0 / rate, real_line}, options);

    const double comments = header.integer(15).value_or(0.0);
    if (!(comments >= 0.0 && comments <= static_cast<double>(text.lines.size() - comment_line)))
        refuse(text, {integer_line + 1, 71}, fmt::format("the number of comment lines is {}.", shortest(comments)),
               "a number that fits the file", "correct the last value of this line");
    std::size_t first = comment_line + static_cast<std::size_t>(comments);
    // Comment lines beyond the stated number are passed over all the same: they start with "|".
    while (first <= text.lines.size() && text.lines[first - 1].starts_with('|')) ++first;
    for (std::size_t line = comment_line; line < first; ++line)
        if (!trimmed(text.lines[line - 1]).starts_with('|'))
            refuse(text, {line, 0}, fmt::format("this is no comment, but {} are stated.", shortest(comments)),
                   "lines that start with |", "correct the number of comment lines (integer header, value 16)");

    const Stated<std::size_t> count{
        checked_sample_count(text, header.integers[16], {integer_line + 2, 1}, "number of samples"), integer_line + 2};
    const std::vector<double> values = read_fields(text, first, count.value, sample_format);
    check_count(text, count, values.size(), "number of samples");
    demand_end_of_block(text, line_after(sample_format, first, count.value), count, "number of samples");

    std::vector<double> accel;
    std::vector<std::string> resampled;
    if (pairs) {
        if (count.value % 2)
            refuse(text, {count.line, 0}, fmt::format("{} values are no pairs of time and acceleration.", count.value),
                   "an even number: the header says no samples per second", "get the file anew from its source");
        std::vector<double> time;
        for (std::size_t k = 0; k < values.size(); k += 2) {
            time.push_back(values[k]);
            accel.push_back(checked_sample(text, values[k + 1], unit, place_of(sample_format, first, k + 1)));
        }
        accel = at_even_times(text, times_of_pairs(text, sample_format, first, time), std::move(accel), options.dt,
                              options, dt, resampled);
    } else {
        accel = samples_of(text, values, unit, sample_format, first, header.reals[0]);
    }

    RecordSource source;
    source.format = lower(text.lines[0]).find("uncorrected") != std::string::npos ? "SMC volume 1" : "SMC volume 2";
    source.unit = unit.name;
    source.component = component_of(text, header);
    source.title = title_of(text);
    source.first_line = first;
    source.last_line = line_after(sample_format, first, count.value) - 1;
    Record record = finished_record(text, std::move(accel), dt, std::move(source));
    record.warnings.insert(record.warnings.end(), resampled.begin(), resampled.end());
    check_peak(text, header, unit, record);
    warn_of_site(header, record);
    std::vector<Record> records;
    records.push_back(std::move(record));
    return chosen_channels(text, std::move(records), options);
}

RecordFormat smc_format()
{
    return {"SMC (USGS)", looks_like_smc, read_smc};
}

} // namespace damslip::records
