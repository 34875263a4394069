#include "records/read/format.hpp"

#include "core/text.hpp"
#include "records/read/agency_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

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
