#include "records/read/agency_samples.hpp"

#include "core/number.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace damslip::records {

std::vector<double> samples_of(const RecordText& text, std::span<const double> values, const AccelerationUnit& unit,
                               const FieldFormat& format, std::size_t first_line, std::optional<double> gap)
{
    std::vector<double> accel(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (gap && std::abs(values[k] - *gap) <= 1e-6 * std::abs(*gap))
            refuse(
                text, place_of(format, first_line, k),
                fmt::format("the sample {} stands for \"unknown\" in this file: there is a gap.", shortest(values[k])),
                "a record without gaps", "a gap in the record has to be closed by hand: nothing is filled in here");
        accel[k] = checked_sample(text, values[k], unit, place_of(format, first_line, k));
    }
    return accel;
}

TimeColumn times_of_pairs(const RecordText& text, const FieldFormat& format, std::size_t first,
                          std::span<const double> time)
{
    TimeColumn times{time, 0, [format, first](std::size_t k) { return place_of(format, first, 2 * k); }};
    for (std::size_t k = 0; k < time.size(); ++k) {
        const Place place = times.place(k);
        const std::string_view line = text.lines[place.line - 1];
        times.digits = std::max(times.digits,
                                significant_digits(line.substr(std::min(line.size(), place.column - 1), format.width)));
    }
    return times;
}

void demand_end_of_block(const RecordText& text, std::size_t line, const Stated<std::size_t>& stated,
                         std::string_view key)
{
    while (line <= text.lines.size() && trimmed(text.lines[line - 1]).empty()) ++line;
    if (line > text.lines.size()) return;
    const std::string_view s = text.lines[line - 1];
    if (!has_words(s) && parse_number(s))
        refuse(text, {stated.line, 0},
               fmt::format("{} = {}, but more numbers follow in line {}.", key, stated.value, line),
               "as many values as stated",
               fmt::format("correct {}, or remove what does not belong to the record", key));
}

std::size_t checked_sample_count(const RecordText& text, double count, Place place, std::string_view key)
{
    if (!(count >= 2.0 && count <= static_cast<double>(max_samples)) || count != std::floor(count))
        refuse(text, place, fmt::format("{} = {} is not allowed.", key, shortest(count)),
               fmt::format("a whole number from 2 to {}", max_samples), "check that the file is complete");
    return static_cast<std::size_t>(count);
}

void check_stated_peak(const RecordText& text, Record& record, const StatedPeak& stated)
{
    constexpr double worth_a_word = 0.01, too_much = 0.10;
    double peak = 0.0;
    for (const double a : record.acceleration) peak = std::max(peak, std::abs(a));
    const double said = std::abs(stated.accel), off = std::abs(peak - said);
    if (off <= stated.resolution || off <= worth_a_word * said) return;
    const std::string both =
        fmt::format("the largest sample is {:.4g} m/s2, the file's header says {:.4g} m/s2", peak, said);
    if (off > too_much * said)
        refuse(text, {stated.line, 0}, both + fmt::format(" (samples in {}).", record.source.unit),
               fmt::format("the same peak within {:.0f} %", 100.0 * too_much),
               "the unit line, the peak or the samples are wrong: get the file anew from its source, or correct it");
    record.warnings.push_back(both);
}

std::vector<Record> chosen_channels(const RecordText& text, std::vector<Record> records, const ReadOptions& options)
{
    std::map<std::string, int> uses;
    for (const Record& record : records) ++uses[lower(record.source.component)];
    std::string list;
    for (std::size_t k = 0; k < records.size(); ++k) {
        std::string& name = records[k].source.component;
        if (uses[lower(name)] > 1) name = fmt::format("{}(channel {})", name.empty() ? "" : name + " ", k + 1);
        list += fmt::format("{}{} {}", k ? ", " : "", k + 1, in_quotes(name));
    }
    if (options.column.empty()) return records;

    const std::string wanted = lower(trimmed(options.column));
    const auto first_word = [](const std::string& name) { return name.substr(0, name.find_first_of(" ,")); };
    std::vector<std::size_t> same, alike;
    for (std::size_t k = 0; k < records.size(); ++k) {
        const std::string name = lower(records[k].source.component);
        if (name == wanted) same.push_back(k);
        if (first_word(name) == wanted) alike.push_back(k);
    }
    if (same.size() != 1) same = alike;
    const auto number = parse_whole_number_text(wanted);
    if (same.size() != 1 && number && *number >= 1.0 && *number <= static_cast<double>(records.size()) &&
        *number == std::floor(*number))
        same = {static_cast<std::size_t>(*number) - 1};
    if (same.size() != 1)
        refuse(text, {}, fmt::format("there is no one channel {}.", in_quotes(options.column)), list,
               "correct --column (in a scene: motion.record.column, vertical_column)");
    return {std::move(records[same.front()])};
}

} // namespace damslip::records
