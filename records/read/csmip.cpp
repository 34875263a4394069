#include "records/read/format.hpp"

#include "core/number.hpp"
#include "records/read/agency_samples.hpp"
#include "records/read/time_column.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

enum class Volume { uncorrected, corrected };

/// Lines of the fixed part: text, 7 of integers, 7 (volume 1) or 13 (volume 2) of reals.
struct Layout {
    std::size_t text_lines, integer_lines, real_lines;
    std::size_t size() const { return text_lines + integer_lines + real_lines; }
};
constexpr Layout layout_of(Volume volume)
{
    return volume == Volume::uncorrected ? Layout{13, 7, 7} : Layout{25, 7, 13};
}

struct CsmipChannel {
    Volume volume;
    std::size_t first, last; ///< its lines
};

bool starts_with_marker(std::string_view line, std::string_view marker)
{
    return lower(trimmed(line).substr(0, 40)).starts_with(marker);
}

/// Channels start with "UNCORRECTED ACCELEROGRAM", or with "CORRECTED ACCELEROGRAM" and a second line of the former.
std::vector<CsmipChannel> find_channels(const RecordText& text)
{
    std::vector<CsmipChannel> channels;
    for (std::size_t line = 1; line <= text.lines.size(); ++line) {
        const std::string_view s = text.lines[line - 1];
        const bool corrected = starts_with_marker(s, "corrected accelerogram");
        if (!corrected && !starts_with_marker(s, "uncorrected accelerogram")) continue;
        if (!channels.empty()) channels.back().last = line - 1;
        channels.push_back({corrected ? Volume::corrected : Volume::uncorrected, line, text.lines.size()});
        if (corrected) ++line; // its second line names the uncorrected volume it was made from
    }
    return channels;
}

bool names_samples(std::string_view line)
{
    const std::string s = lower(line.substr(0, 160));
    return contains(s, "points of accel") && (contains(s, "spaced at") || contains(s, "unequally"));
}

/// The word after the first of the keys a line has: "UNITS OF UNCOR ACCEL IS G.", "(UNITS: CM/SEC/SEC)", "in cm/sec2."
std::optional<std::string> unit_in(std::string_view line)
{
    static constexpr std::array<std::string_view, 6> keys{
        "accel is ", "acceleration is ", "units:", "units=", "units of ", " in "};
    const std::string s = lower(line.substr(0, 160));
    for (const std::string_view key : keys) {
        const std::size_t at = s.find(key);
        if (at == std::string::npos) continue;
        const std::string_view rest = trimmed(std::string_view(s).substr(at + key.size()));
        std::string word(rest.substr(0, rest.find_first_of(" ,;()\t")));
        while (!word.empty() && word.back() == '.') word.pop_back();
        if (!word.empty()) return word;
    }
    return std::nullopt;
}

/// "90 DEG" of the line "CHAN  1:  90 DEG" among the text lines.
std::string component_of(const RecordText& text, const CsmipChannel& channel)
{
    const std::size_t end = std::min(channel.last, channel.first + layout_of(channel.volume).text_lines - 1);
    for (std::size_t line = channel.first; line <= end; ++line) {
        const std::string_view s = text.lines[line - 1];
        const std::size_t at = lower(s).find("chan");
        const std::size_t colon = at == std::string::npos ? at : s.find(':', at);
        if (colon == std::string_view::npos || colon > at + 14) continue;
        std::string_view rest = trimmed(s.substr(colon + 1));
        rest = rest.substr(0, rest.find("   "));
        if (!trimmed(rest).empty()) return std::string(trimmed(rest));
    }
    return "";
}

std::string title_of(const RecordText& text, const CsmipChannel& channel)
{
    const std::size_t event = channel.first + (channel.volume == Volume::corrected ? 2 : 1), station = event + 4;
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
    source.format = channel.volume == Volume::corrected ? "CSMIP volume 2" : "CSMIP volume 1";
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
    const Layout layout = layout_of(channel.volume);
    if (channel.first + layout.size() > channel.last)
        refuse(text, {channel.last, 0}, "the file ends within its header.",
               fmt::format("{} lines of text, {} of integers and {} of reals", layout.text_lines, layout.integer_lines,
                           layout.real_lines),
               "the file looks cut: get it anew from its source");
    const std::size_t first = channel.first + layout.text_lines;
    return {read_fields(text, first, 16 * layout.integer_lines, {16, 5}),
            read_fields(text, first + layout.integer_lines, 8 * layout.real_lines, {8, 10})};
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
    const std::size_t default_width = channel.volume == Volume::corrected ? 10 : 9;
    FieldFormat format{8, default_width};
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
    const auto count = parse_number(s);
    const std::size_t at = lower(s).find("spaced at");
    const auto dt = at == std::string::npos ? std::nullopt : parse_number(s.substr(at + 9));
    if (!count || !dt)
        refuse(text, {line, 0}, fmt::format("{} is not understood.", in_quotes(trimmed(s))),
               "\"3251 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC. (UNITS: CM/SEC/SEC)\"", "correct the line");
    std::optional<Stated<std::string>> unit;
    if (const auto word = unit_in(s.substr(at + 9))) unit = Stated<std::string>{*word, line};
    return read_even(text, channel, line, {checked_sample_count(text, *count, {line, 0}, "number of points"), line},
                     {*dt, line}, unit, options);
}

/// The unit that one of the text lines names ("UNITS OF UNCOR ACCEL IS G/10.").
std::optional<Stated<std::string>> unit_in_text(const RecordText& text, const CsmipChannel& channel)
{
    for (std::size_t line = channel.first; line < channel.first + layout_of(channel.volume).text_lines; ++line)
        if (contains(lower(text.lines[line - 1]), "units"))
            if (const auto word = unit_in(text.lines[line - 1])) return Stated<std::string>{*word, line};
    return std::nullopt;
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
        if (k > 0 && !(numbers[k] > time.back()))
            refuse(text, place_of(format, first, k),
                   fmt::format("the time {} s does not follow {} s.", numbers[k], time.back()),
                   "pairs of a rising time and an acceleration", "correct the times");
        time.push_back(numbers[k]);
        accel.push_back(checked_sample(text, numbers[k + 1], unit, place_of(format, first, k + 1)));
    }
    const double mean = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
    std::size_t worst = 1;
    for (std::size_t k = 1; k < time.size(); ++k)
        if (std::abs(time[k] - time[k - 1] - mean) > std::abs(time[worst] - time[worst - 1] - mean)) worst = k;
    const bool even = std::abs(time[worst] - time[worst - 1] - mean) <= even_tolerance * mean;
    if (!even && options.uneven == UnevenTime::refuse)
        refuse(text, place_of(format, first, 2 * worst),
               fmt::format("the time step is uneven: {:.6g} s here, {:.6g} s on average (digitised film).",
                           time[worst] - time[worst - 1], mean),
               fmt::format("steps equal within {:.1f} %", 100.0 * even_tolerance),
               "have the record resampled (`damslip record convert --resample --dt 0.005`)");
    const std::size_t before = accel.size();
    double dt = even ? *settle_dt(text, Stated<double>{mean, first}, options) : options.dt.value_or(0.0);
    if (!even) accel = at_even_times(text, time, accel, dt);
    Record record =
        finished_record(text, std::move(accel), dt,
                        source_of(text, channel, unit, first, line_after(format, first, numbers.size()) - 1));
    if (!even)
        record.warnings.push_back(fmt::format("uneven times resampled: {} samples became {} at {} s", before,
                                              record.acceleration.size(), dt));
    record.warnings.insert(record.warnings.end(), warnings.begin(), warnings.end());
    return record;
}

/// No line that names the samples: number and length from the header, times beside the samples or (below another line
/// of words) none.
Record read_unnamed_samples(const RecordText& text, const CsmipChannel& channel, const ReadOptions& options)
{
    const Layout layout = layout_of(channel.volume);
    const Numbers numbers = read_numbers(text, channel);
    const std::size_t place_line = channel.first + layout.text_lines + 1; // integers 17 to 32
    const double stated = numbers.integers.size() > 27 ? numbers.integers[27] : 0.0;
    const Stated<std::size_t> count{checked_sample_count(text, stated, {place_line, 56}, "number of points"),
                                    place_line};
    const std::size_t first = channel.first + layout.size();
    if (!has_words(text.lines[first - 1])) return read_pairs(text, channel, first, count, options);

    const double length = numbers.reals.size() > 2 ? numbers.reals[2] : 0.0;
    const double rate = std::round((stated - 1.0) / length);
    if (!(length > 0.0 && rate >= 1.0 && std::abs((stated - 1.0) / length - rate) < 0.02 * rate))
        refuse(text, {first, 0}, "this line does not say the time step, nor do number and length of the record.",
               "\"12001 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC. (UNITS: G)\"", "correct the line");
    return read_even(text, channel, first, count, {1.0 / rate, first}, unit_in_text(text, channel), options);
}

Record read_channel(const RecordText& text, const CsmipChannel& channel, const ReadOptions& options)
{
    for (std::size_t line = channel.first; line <= std::min(channel.last, channel.first + 80); ++line)
        if (names_samples(text.lines[line - 1])) return read_named_samples(text, channel, line, options);
    if (channel.volume == Volume::corrected)
        refuse(text, {channel.first, 0}, "no acceleration follows in this channel.",
               "\"3251 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC. (UNITS: CM/SEC/SEC)\"",
               "the file looks cut, or has another layout (that of USC shares the first line): get the record in "
               "another format");
    return read_unnamed_samples(text, channel, options);
}

/// "PEAK ACCELERATION =   -421.547 CM/SEC/SEC     AT   4.880 SEC" of a corrected channel.
void check_peak(const RecordText& text, const CsmipChannel& channel, Record& record)
{
    if (channel.volume != Volume::corrected) return;
    const std::size_t end = std::min(channel.last, channel.first + layout_of(channel.volume).text_lines - 1);
    for (std::size_t line = channel.first; line <= end; ++line) {
        const std::string_view s = text.lines[line - 1];
        const std::size_t at = lower(s).find("peak accel"), equals = at == std::string::npos ? at : s.find('=', at);
        if (equals == std::string_view::npos) continue;
        std::size_t used = 0;
        const auto peak = parse_number(s.substr(equals + 1), &used);
        const std::string_view rest = trimmed(s.substr(equals + 1 + used));
        const auto unit = acceleration_unit(rest.substr(0, rest.find_first_of(" \t")));
        if (peak && unit)
            check_stated_peak(text, record, {*peak * unit->factor, 0.001 * std::abs(*peak) * unit->factor, line});
        return;
    }
}

} // namespace

/// One of the first three lines names an (un)corrected accelerogram.
bool looks_like_csmip(const RecordText& text)
{
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
/// Shakal & Huang (1985), CDMG; Converse & Brady (1992), USGS Open-File Report 92-296-A.
/// @throws InputError: response spectra (volume 3), an unknown unit, uneven times unless options.uneven is resample.
std::vector<Record> read_csmip(const RecordText& text, const ReadOptions& options)
{
    if (contains(lower(text.lines.front()), "response"))
        refuse(text, {1, 0}, "these are response spectra (volume 3), no accelerogram.", "volume 1 or 2",
               "take the volume 2 file of the record");
    const std::vector<CsmipChannel> channels = find_channels(text);
    if (channels.empty())
        refuse(text, {1, 0}, "no channel of a CSMIP file is found.",
               "a line that starts with \"CORRECTED ACCELEROGRAM\" or \"UNCORRECTED ACCELEROGRAM\"",
               "get the file anew from its source");
    std::vector<Record> records;
    for (const CsmipChannel& channel : channels) {
        records.push_back(read_channel(text, channel, options));
        check_peak(text, channel, records.back());
        warn_if_down(records.back());
    }
    return chosen_channels(text, std::move(records), options);
}

RecordFormat csmip_format()
{
    return {"CSMIP/CDMG", looks_like_csmip, read_csmip};
}

} // namespace damslip::records
