#include "records/read/read_record.hpp"

#include "core/text.hpp"
#include "records/read/agency_samples.hpp"
#include "records/read/number_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

/// What the files of an agency have in common: for each channel lines of text, a block of integers, one of reals, then samples.
struct Layout {
    std::string_view name;
    std::size_t text_lines;
    FieldFormat integers;
    std::size_t integer_lines;
    FieldFormat reals;
    std::size_t real_lines;
    FieldFormat samples; ///< where neither a line above them nor their own length says
    bool own_count;      ///< the text lines say number and step, and no line stands above the samples
    std::size_t size() const { return text_lines + integer_lines + real_lines; }
};
constexpr Layout csmip_1{"CSMIP volume 1", 13, {16, 5}, 7, {8, 10}, 7, {8, 9}, false},
    csmip_2{"CSMIP volume 2", 25, {16, 5}, 7, {8, 10}, 13, {8, 10}, false},
    bhrc_1{"BHRC volume 1", 13, {14, 5}, 7, {6, 15}, 8, {10, 13}, true},
    geonet_1{"GeoNet volume 1", 16, {10, 8}, 4, {10, 8}, 6, {10, 8}, true},
    geonet_2{"GeoNet volume 2", 16, {10, 8}, 4, {10, 8}, 6, {10, 8}, true};

struct CsmipChannel {
    const Layout* layout;
    std::size_t first, last; ///< its lines

    std::size_t last_text_line() const { return std::min(last, first + layout->text_lines - 1); }
};

bool starts_with_marker(std::string_view line, std::string_view marker)
{
    return lower(trimmed(line).substr(0, 40)).starts_with(marker);
}

/// The layout of a channel that starts in this line; null: none does. GeoNet shares the first words of CSMIP.
const Layout* layout_at(const RecordText& text, std::size_t line)
{
    const std::string_view s = text.lines[line - 1];
    if (starts_with_marker(s, "* vol1ds")) return &bhrc_1;
    const bool corrected = starts_with_marker(s, "corrected accelerogram");
    if (!corrected && !starts_with_marker(s, "uncorrected accelerogram")) return nullptr;
    constexpr std::size_t to_component = 12;
    const bool geonet = line + to_component <= text.lines.size() && starts_with_marker(text.lines[line], "site ") &&
                        starts_with_marker(text.lines[line - 1 + to_component], "component ");
    if (geonet) return corrected ? &geonet_2 : &geonet_1;
    return corrected ? &csmip_2 : &csmip_1;
}

/// CSMIP: a corrected channel has a second line that begins with "UNCORRECTED ACCELEROGRAM".
std::vector<CsmipChannel> find_channels(const RecordText& text)
{
    std::vector<CsmipChannel> channels;
    for (std::size_t line = 1; line <= text.lines.size(); ++line) {
        const Layout* layout = layout_at(text, line);
        if (!layout) continue;
        if (!channels.empty()) channels.back().last = line - 1;
        channels.push_back({layout, line, text.lines.size()});
        if (layout == &csmip_2) ++line; // its second line names the uncorrected volume it was made from
    }
    return channels;
}

/// "3251 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC.", "400 Accelerogram points at 100 pts/sec in units of g."
bool names_samples(std::string_view line)
{
    const std::string s = lower(line.substr(0, 160));
    return (contains(s, "points of accel") && (contains(s, "spaced at") || contains(s, "unequally"))) ||
           (contains(s, "accel") && contains(s, "points at ") && contains(s, "/sec"));
}

/// The number behind one of the keys in a line.
std::optional<double> number_after(std::string_view line, std::initializer_list<std::string_view> keys)
{
    const std::string s = lower(line.substr(0, 160));
    for (const std::string_view key : keys)
        if (const std::size_t at = s.find(key); at != std::string::npos)
            if (const auto number = parse_number(s.substr(at + key.size()))) return number;
    return std::nullopt;
}

/// The step that a line says [s]: "spaced at .020 sec", "at intervals of 0.010 s", "at 0.010 sec intervals", "at 100 pts/sec".
std::optional<double> step_in(std::string_view line)
{
    const std::string s = lower(line.substr(0, 160));
    if (const auto step = number_after(s, {"spaced at", "intervals of"})) return step;
    const auto number = number_after(s, {" at "});
    if (!number) return std::nullopt;
    if (contains(s, "intervals")) return number;
    return contains(s, "/sec") && *number > 0.0 ? std::optional(1.0 / *number) : std::nullopt;
}

/// The first of the text lines for which `value` has an answer.
template <class Value>
auto in_text(const RecordText& text, const CsmipChannel& channel, Value value)
    -> std::optional<Stated<typename decltype(value(std::string_view()))::value_type>>
{
    for (std::size_t line = channel.first; line <= channel.last_text_line(); ++line)
        if (auto found = value(text.lines[line - 1]))
            return Stated<typename decltype(value(std::string_view()))::value_type>{std::move(*found), line};
    return std::nullopt;
}

/// "90 DEG" of the line "CHAN  1:  90 DEG" among the text lines; "N10E" of "Component N10E"; "L1" of "COMP L1".
std::string component_of(const RecordText& text, const CsmipChannel& channel)
{
    const auto named = in_text(text, channel, [](std::string_view s) -> std::optional<std::string> {
        const std::string low = lower(s);
        for (const std::string_view key : {"component ", "comp "})
            if (low.starts_with(key)) return std::string(trimmed(s.substr(key.size())));
        const std::size_t at = low.find("chan");
        const std::size_t colon = at == std::string::npos ? at : s.find(':', at);
        if (colon == std::string_view::npos || colon > at + 14) return std::nullopt;
        std::string_view rest = trimmed(s.substr(colon + 1));
        rest = trimmed(rest.substr(0, rest.find("   ")));
        return rest.empty() ? std::nullopt : std::optional(std::string(rest));
    });
    return named ? named->value : "";
}

/// The lines of event and station.
std::string title_of(const RecordText& text, const CsmipChannel& channel)
{
    std::size_t event = channel.first + 1, station = event + 4;
    if (channel.layout == &csmip_2) ++event, ++station;
    if (channel.layout == &bhrc_1) event = channel.first + 2, station = channel.first + 7;
    if (channel.layout->samples.width == 8) event = channel.first + 7, station = channel.first + 2; // GeoNet
    std::string title;
    for (const std::size_t line : {event, station})
        if (line <= channel.last && !trimmed(text.lines[line - 1]).empty())
            title += (title.empty() ? "" : ", ") + std::string(trimmed(text.lines[line - 1]));
    return title;
}

RecordSource source_of(const RecordText& text, const CsmipChannel& channel, const AccelerationUnit& unit,
                       std::size_t first, std::size_t last)
{
    RecordSource source;
    source.format = channel.layout->name;
    source.unit = unit.name;
    source.component = component_of(text, channel);
    source.title = title_of(text, channel);
    source.first_line = first;
    source.last_line = last;
    return source;
}

/// Integers and reals between the text lines and the samples.
struct Numbers {
    std::vector<double> integers, reals;
};

Numbers read_numbers(const RecordText& text, const CsmipChannel& channel)
{
    const Layout& layout = *channel.layout;
    if (channel.first + layout.size() > channel.last)
        refuse(text, {channel.last, 0}, "the file ends within its header.",
               fmt::format("{} lines of text, {} of integers and {} of reals", layout.text_lines, layout.integer_lines,
                           layout.real_lines),
               "the file looks cut: get it anew from its source");
    const std::size_t first = channel.first + layout.text_lines;
    return {read_fields(text, first, layout.integers.per_line * layout.integer_lines, layout.integers),
            read_fields(text, first + layout.integer_lines, layout.reals.per_line * layout.real_lines, layout.reals)};
}

/// Fewer samples than stated are tolerated only where the last line has a blank rest.
void check_number(const RecordText& text, const Stated<std::size_t>& count, std::size_t found,
                  const FieldFormat& format, std::vector<std::string>& warnings)
{
    if (found == count.value) return;
    if (found < 2 || found > count.value || count.value - found >= format.per_line)
        check_count(text, count, found, "number of points");
    warnings.push_back(
        fmt::format("{} points are stated, {} follow: the rest of the last line is blank", count.value, found));
}

/// Samples equally spaced, under a line that names number, step, unit and perhaps a format.
Record read_even(const RecordText& text, const CsmipChannel& channel, std::size_t line, Stated<std::size_t> count,
                 Stated<double> stated_dt, const std::optional<Stated<std::string>>& stated_unit,
                 const ReadOptions& options)
{
    const AccelerationUnit unit = settle_unit(text, stated_unit, options);
    const double dt = *settle_dt(text, stated_dt, options);
    const std::size_t first = line + 1;
    FieldFormat format = channel.layout->samples;
    if (const auto named = field_format(text.lines[line - 1]))
        format = *named;
    else if (first <= channel.last && count.value >= 8)
        format = format_of_length(text.lines[first - 1], 8).value_or(format);

    const std::vector<double> values = read_fields(text, first, count.value, format);
    std::vector<std::string> warnings;
    check_number(text, count, values.size(), format, warnings);
    demand_end_of_block(text, line_after(format, first, count.value), count, "number of points");
    Record record =
        finished_record(text, samples_of(text, values, unit, format, first), dt,
                        source_of(text, channel, unit, first, line_after(format, first, values.size()) - 1));
    record.warnings.insert(record.warnings.end(), warnings.begin(), warnings.end());
    return record;
}

/// " 3251 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)"
Record read_named_samples(const RecordText& text, const CsmipChannel& channel, std::size_t line,
                          const ReadOptions& options)
{
    const std::string_view s = text.lines[line - 1];
    const auto count = parse_number(s), dt = step_in(s);
    if (!count || !dt)
        refuse(text, {line, 0}, fmt::format("{} is not understood.", in_quotes(trimmed(s))),
               "\"3251 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC. (UNITS: CM/SEC/SEC)\"", "correct the line");
    std::optional<Stated<std::string>> unit;
    const std::size_t at = lower(s).find("spaced at");
    if (const auto word = unit_in_words(at == std::string::npos ? s : s.substr(at)))
        unit = Stated<std::string>{*word, line};
    return read_even(text, channel, line, {checked_sample_count(text, *count, {line, 0}, "number of points"), line},
                     {*dt, line}, unit, options);
}

/// The unit that one of the text lines names ("UNITS OF UNCOR ACCEL IS G/10.", "UNITS ARE SECONDS AND G/10").
std::optional<Stated<std::string>> unit_in_text(const RecordText& text, const CsmipChannel& channel)
{
    return in_text(text, channel, [](std::string_view s) -> std::optional<std::string> {
        return contains(lower(s), "units") ? unit_in_words(s) : std::nullopt;
    });
}

/// Pairs of time and acceleration, 5 a line in fields of 7.
Record read_pairs(const RecordText& text, const CsmipChannel& channel, std::size_t first,
                  const Stated<std::size_t>& count, const ReadOptions& options)
{
    const AccelerationUnit unit = settle_unit(text, unit_in_text(text, channel), options);
    const FieldFormat format = format_of_length(text.lines[first - 1], 10).value_or(FieldFormat{10, 7});
    std::vector<double> numbers = read_fields(text, first, 2 * count.value, format);
    std::vector<std::string> warnings;
    if (numbers.size() % 2) numbers.pop_back();
    check_number(text, count, numbers.size() / 2, {format.per_line / 2, format.width}, warnings);
    demand_end_of_block(text, line_after(format, first, 2 * count.value), count, "number of points");

    std::vector<double> time, accel;
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) {
        time.push_back(numbers[k]);
        accel.push_back(checked_sample(text, numbers[k + 1], unit, place_of(format, first, k + 1)));
    }
    double dt = 0.0;
    std::vector<std::string> resampled;
    accel = at_even_times(text, times_of_pairs(text, format, first, time), std::move(accel), options.dt, options, dt,
                          resampled);
    Record record =
        finished_record(text, std::move(accel), dt,
                        source_of(text, channel, unit, first, line_after(format, first, numbers.size()) - 1));
    record.warnings.insert(record.warnings.end(), resampled.begin(), resampled.end());
    record.warnings.insert(record.warnings.end(), warnings.begin(), warnings.end());
    return record;
}

/// Whole samples a second from number and length: files count n or n - 1 steps in it. Nothing where neither gives a whole number.
std::optional<double> step_of_length(double count, double length)
{
    for (const double steps : {count - 1.0, count}) {
        const double rate = steps / length, whole = std::round(rate);
        if (length > 0.0 && whole >= 1.0 && std::abs(rate - whole) < 1e-4 * whole) return 1.0 / whole;
    }
    const double rate = std::round((count - 1.0) / length); // a length of few digits
    if (length > 0.0 && rate >= 1.0 && std::abs((count - 1.0) / length - rate) < 0.02 * rate) return 1.0 / rate;
    return std::nullopt;
}

/// Number and step in the text lines, samples below the header: BHRC, GeoNet.
Record read_below_header(const RecordText& text, const CsmipChannel& channel, const ReadOptions& options)
{
    const Layout& layout = *channel.layout;
    const auto stated = in_text(text, channel, [](std::string_view s) {
        return number_after(s, {"of points =", "of points"});
    });
    if (!stated)
        refuse(text, {channel.first, 0}, "the header does not say the number of points.", "\"Number of points 400\"",
               "get the file anew from its source");
    const Stated<std::size_t> count{checked_sample_count(text, stated->value, {stated->line, 0}, "number of points"),
                                    stated->line};
    auto dt = in_text(text, channel, [](std::string_view s) { return step_in(s); });
    if (!dt) {
        const auto length = number_after(text.lines[stated->line - 1], {"duration =", "duration"});
        const auto step = length ? step_of_length(stated->value, *length) : std::nullopt;
        if (!step)
            refuse(text, {stated->line, 0},
                   "the header does not say the time step, nor do number and length of the record.",
                   "\"NO. OF POINTS = 400  DURATION = 4.000\"", "correct the line");
        dt = Stated<double>{*step, stated->line};
    }
    auto unit_line = unit_in_text(text, channel);
    if (!unit_line) // GeoNet volume 2: the unit of the peak is that of the samples
        unit_line = in_text(text, channel, [](std::string_view s) -> std::optional<std::string> {
            return starts_with_marker(s, "acceleration:") ? unit_in_words(s) : std::nullopt;
        });
    const auto in_units_of = in_text(text, channel, [](std::string_view s) { return number_after(s, {"units of "}); });
    if (in_units_of && in_units_of->value != 1.0)
        refuse(text, {in_units_of->line, 0}, fmt::format("the samples are in units of {}.", in_units_of->value),
               "units of 1.00 mm/s/s", "get the file anew from its source, or convert it");
    const AccelerationUnit unit = settle_unit(text, unit_line, options);

    // The blocks of numbers differ by a line from file to file: the samples begin with the first line of their width.
    std::size_t first = channel.first + layout.size();
    const auto is_full = [&](std::size_t line) {
        const auto format = format_of_length(text.lines[line - 1], layout.samples.per_line);
        return format && format->width == layout.samples.width;
    };
    if (&layout == &bhrc_1 && count.value >= layout.samples.per_line)
        for (first = channel.first + layout.text_lines + layout.integer_lines; first < channel.last && !is_full(first);)
            ++first;
    const std::vector<double> values =
        first > channel.last ? std::vector<double>{} : read_fields(text, first, count.value, layout.samples);
    check_count(text, count, values.size(), "number of points");
    const std::size_t end = line_after(layout.samples, first, count.value);
    if (&layout != &geonet_2) demand_end_of_block(text, end, count, "number of points"); // else velocities follow
    return finished_record(text, samples_of(text, values, unit, layout.samples, first), *settle_dt(text, dt, options),
                           source_of(text, channel, unit, first, end - 1));
}

/// No line that names the samples: number and length from the header, times beside the samples or (below another line
/// of words) none.
Record read_unnamed_samples(const RecordText& text, const CsmipChannel& channel, const ReadOptions& options)
{
    const Layout& layout = *channel.layout;
    const Numbers numbers = read_numbers(text, channel);
    const std::size_t place_line = channel.first + layout.text_lines + 1; // integers 17 to 32
    const double stated = numbers.integers.size() > 27 ? numbers.integers[27] : 0.0;
    const Stated<std::size_t> count{checked_sample_count(text, stated, {place_line, 56}, "number of points"),
                                    place_line};
    const std::size_t first = channel.first + layout.size();
    if (!has_words(text.lines[first - 1])) return read_pairs(text, channel, first, count, options);

    const double length = numbers.reals.size() > 2 ? numbers.reals[2] : 0.0;
    const auto dt = step_of_length(stated, length);
    if (!dt)
        refuse(text, {first, 0}, "this line does not say the time step, nor do number and length of the record.",
               "\"12001 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC. (UNITS: G)\"", "correct the line");
    return read_even(text, channel, first, count, {*dt, first}, unit_in_text(text, channel), options);
}

Record read_channel(const RecordText& text, const CsmipChannel& channel, const ReadOptions& options)
{
    if (channel.layout->own_count) return read_below_header(text, channel, options);
    for (std::size_t line = channel.first; line <= std::min(channel.last, channel.first + 80); ++line)
        if (names_samples(text.lines[line - 1])) return read_named_samples(text, channel, line, options);
    if (channel.layout == &csmip_2)
        refuse(text, {channel.first, 0}, "no acceleration follows in this channel.",
               "\"3251 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC. (UNITS: CM/SEC/SEC)\"",
               "the file looks cut, or has another layout (that of USC shares the first line): get the record in "
               "another format");
    return read_unnamed_samples(text, channel, options);
}

/// "PEAK ACCELERATION =   -421.547 CM/SEC/SEC     AT   4.880 SEC" of a corrected channel, "Acceleration: peak -2080.5 mm/s/s" of GeoNet.
void check_peak(const RecordText& text, const CsmipChannel& channel, Record& record)
{
    if (channel.layout == &csmip_1 || channel.layout == &bhrc_1) return;
    for (std::size_t line = channel.first; line <= channel.last_text_line(); ++line) {
        const std::string_view s = text.lines[line - 1];
        const std::string low = lower(s);
        const bool geonet = low.starts_with("acceleration:");
        const std::size_t at = low.find("peak accel");
        const std::size_t value = geonet ? low.find("peak") + 3 : at == std::string::npos ? at : s.find('=', at);
        if (value >= s.size()) continue;
        std::size_t used = 0;
        const auto peak = parse_number(s.substr(value + 1), &used);
        const std::string_view rest = trimmed(s.substr(value + 1 + used));
        const auto unit = acceleration_unit(rest.substr(0, rest.find_first_of(" \t")));
        if (peak && unit)
            check_stated_peak(text, record, {*peak * unit->factor, 0.001 * std::abs(*peak) * unit->factor, line});
        return;
    }
}

} // namespace

/// One of the first three lines names an (un)corrected accelerogram, or the first a volume of BHRC.
bool looks_like_csmip(const RecordText& text)
{
    if (starts_with_marker(text.lines.front(), "* vol")) return true;
    for (std::size_t k = 0; k < std::min<std::size_t>(3, text.lines.size()); ++k)
        if (contains(lower(text.lines[k].substr(0, 200)), "corrected accelerogram")) return true;
    return false;
}

/// CSMIP/CDMG volumes 1 (uncorrected) and 2 (corrected), any number of channels a file: for each text lines (13 or 25),
/// 100 integers (16I5), 50 or 100 reals (8F10), then "3251 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC. (UNITS:
/// CM/SEC/SEC)" and the samples; volume 2 goes on with velocity and displacement, which are passed over. Where no
/// format is named the field width follows from the length of a full line (9 or 10 characters).
/// Volume 1 of digitised film has no such line: pairs of time and acceleration (10 fields of 7), as a rule uneven in
/// time, in the unit that the text lines name ("G/10" is a tenth of g).
/// Up to 7 samples fewer than stated, with a blank rest of the last line, are a warning.
/// The same order of blocks have volume 1 of BHRC (Iran: "* VOL1DS", number and length in the text lines, 10 fields of 13) and volumes 1 and
/// 2 of GeoNet (New Zealand: V1A, V2A; number and step in the text lines, 10 fields of 8, mm/s^2): rows of Layout.
/// Cousins (2008), GNS accelerogram data files; Shakal & Huang (1985), CDMG; Converse & Brady (1992), USGS Open-File Report 92-296-A.
/// @throws InputError: response spectra (volume 3), an unknown unit, uneven times unless options.uneven is resample.
std::vector<Record> read_csmip(const RecordText& text, const ReadOptions& options)
{
    if (contains(lower(text.lines.front()), "response"))
        refuse(text, {1, 0}, "these are response spectra (volume 3), no accelerogram.", "volume 1 or 2",
               "take the volume 2 file of the record");
    if (starts_with_marker(text.lines.front(), "* vol") && !starts_with_marker(text.lines.front(), "* vol1ds"))
        refuse(text, {1, 0}, fmt::format("{}: of BHRC only volume 1 is read.", in_quotes(trimmed(text.lines.front()))),
               "\"* VOL1DS FILE\" (.V1)", "take the .V1 file of the record");
    const std::vector<CsmipChannel> channels = find_channels(text);
    if (channels.empty())
        refuse(text, {1, 0}, "no channel of a CSMIP file is found.",
               "a line that starts with \"CORRECTED ACCELEROGRAM\" or \"UNCORRECTED ACCELEROGRAM\"",
               "get the file anew from its source");
    std::vector<Record> records;
    for (const CsmipChannel& channel : channels) {
        records.push_back(read_channel(text, channel, options));
        check_peak(text, channel, records.back());
    }
    return chosen_channels(text, std::move(records), options);
}

RecordFormat csmip_format()
{
    return {"CSMIP/CDMG", looks_like_csmip, read_csmip};
}

} // namespace damslip::records
