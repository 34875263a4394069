#include "records/read/agency_samples.hpp"

#include "core/text.hpp"
#include "core/units.hpp"
#include "records/read/header.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
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

namespace {

bool digit(char c)
{
    return c >= '0' && c <= '9';
}

/// Whole number of at most 3 digits at `at`, which moves behind it.
std::optional<std::size_t> small_number(std::string_view s, std::size_t& at)
{
    std::size_t value = 0, begin = at;
    for (; at < s.size() && digit(s[at]) && at < begin + 3; ++at)
        value = 10 * value + static_cast<std::size_t>(s[at] - '0');
    if (at == begin) return std::nullopt;
    return value;
}

/// A format that starts behind the bracket at `at`.
std::optional<FieldFormat> format_at(std::string_view s, std::size_t at)
{
    const auto count = small_number(s, at);
    if (!count) return std::nullopt;
    if (at < s.size() && s[at] == '(') ++at;
    if (s.substr(at).starts_with("1p")) at += 2; // a scale factor for printing
    if (at >= s.size() || std::string_view("ifeg").find(s[at]) == std::string_view::npos) return std::nullopt;
    const auto width = small_number(s, ++at);
    if (!width || *count < 1 || *count > 100 || *width < 1 || *width > 60) return std::nullopt;
    return FieldFormat{*count, *width};
}

} // namespace

std::optional<FieldFormat> field_format(std::string_view line)
{
    std::optional<FieldFormat> found;
    const std::string s = lower(line.substr(0, 200));
    for (std::size_t at = 0; (at = s.find('(', at)) != std::string::npos;)
        if (const auto format = format_at(s, ++at)) found = format;
    return found;
}

std::optional<FieldFormat> format_of_length(std::string_view line, std::size_t per_line)
{
    while (!line.empty() && (line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
    if (line.size() % per_line != 0 || line.size() / per_line < 5 || line.size() / per_line > 25) return std::nullopt;
    return FieldFormat{per_line, line.size() / per_line};
}

Place place_of(const FieldFormat& format, std::size_t first, std::size_t k)
{
    return {first + k / format.per_line, 1 + k % format.per_line * format.width};
}

bool has_words(std::string_view line)
{
    return std::any_of(line.begin(), line.end(), [](char c) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        return letter && std::string_view("eEdD").find(c) == std::string_view::npos;
    });
}

std::vector<double> read_fields(const RecordText& text, std::size_t first, std::size_t count, const FieldFormat& format)
{
    std::vector<double> values;
    values.reserve(std::min(count, 20 * text.lines.size()));
    for (std::size_t line = first; line <= text.lines.size() && values.size() < count; ++line) {
        const std::string_view s = text.lines[line - 1];
        const std::string word = lower(trimmed(s).substr(0, 4));
        if (word.starts_with('/')) break; // "/&" ends a channel
        if (has_words(s) && !contains(word, "nan") && !contains(word, "inf")) break;
        for (std::size_t k = 0; k < format.per_line && values.size() < count; ++k) {
            const std::size_t at = std::min(k * format.width, s.size());
            const std::string_view field = s.substr(at, format.width);
            if (trimmed(field).empty() && trimmed(s.substr(at)).empty()) {
                if (k == 0 || line == text.lines.size() || values.size() + format.per_line > count) return values;
                // A line that ends early in the middle of the block: the next one must not follow unnoticed.
                const std::string_view next = text.lines[line];
                if (has_words(next) || trimmed(next).empty()) return values;
            }
            std::size_t used = 0;
            const Place place{line, at + 1};
            const double value = number_at(text, field, place, used);
            if (!trimmed(field.substr(used)).empty())
                refuse(text, place, in_quotes(field) + " is not one number.",
                       std::to_string(format.per_line) + " fields of " + std::to_string(format.width) +
                           " characters a line",
                       "check that the line was not changed: these fields are read by their columns");
            const bool ends_file = line == text.lines.size() && at + field.size() == s.size();
            if (ends_file && !text.last_line_ended && field.size() < format.width)
                refuse(text, place,
                       fmt::format("the last number, {}, ends in the middle of its field.", in_quotes(trimmed(field))),
                       std::to_string(format.width) + " characters", "the file looks cut: get it anew from its source");
            values.push_back(value);
        }
    }
    return values;
}

std::size_t line_after(const FieldFormat& format, std::size_t first, std::size_t count)
{
    return first + (count + format.per_line - 1) / format.per_line;
}

namespace {

constexpr double shortest_dt = 1e-6, longest_dt = 1.0; // [s]
constexpr std::string_view give_unit =
    "give it as motion.record.unit in the scene, --units on the command line, or a line \"# units: g\" in the file";

void check_dt(const RecordText& text, double dt, Place place, std::string_view origin)
{
    if (!(dt >= shortest_dt && dt <= longest_dt))
        refuse(text, place, fmt::format("the time step {} s {} is not allowed.", dt, origin),
               fmt::format("{} to {} s", shortest_dt, longest_dt), "correct it; steps are in seconds");
}

} // namespace

AccelerationUnit settle_unit(const RecordText& text, const std::optional<Stated<std::string>>& in_file,
                             const ReadOptions& options)
{
    std::optional<AccelerationUnit> given, stated;
    if (!options.unit.empty()) {
        given = acceleration_unit(options.unit);
        if (!given)
            refuse(text, {}, fmt::format("the unit {} given for this file is not known.", in_quotes(options.unit)),
                   std::string(known_units), "correct motion.record.unit or --units");
    }
    if (in_file) {
        stated = acceleration_unit(in_file->value);
        if (!stated)
            refuse(text, {in_file->line, 0}, fmt::format("the unit {} is not known.", in_quotes(in_file->value)),
                   std::string(known_units), "correct the line; velocity and displacement are not read");
    }
    if (given && stated && given->factor != stated->factor)
        refuse(text, {in_file->line, 0},
               fmt::format("the file says its unit is {}, but {} was given.", stated->name, given->name), "one unit",
               "leave the given unit out (motion.record.unit, --units) or correct the file");
    if (!given && !stated && options.survey) return *acceleration_unit("m/s2");
    if (!given && !stated)
        refuse(text, {}, "the file does not say the unit of its accelerations, and none was given.",
               std::string(known_units), std::string(give_unit));
    return stated ? *stated : *given;
}

std::optional<double> settle_dt(const RecordText& text, const std::optional<Stated<double>>& in_file,
                                const ReadOptions& options)
{
    constexpr double same = 1e-6; // relative: headers carry about 4 digits
    if (in_file) check_dt(text, in_file->value, {in_file->line, 0}, "in the file");
    if (options.dt) check_dt(text, *options.dt, {}, "given for this file");
    if (in_file && options.dt && std::abs(in_file->value - *options.dt) > same * *options.dt)
        refuse(text, {in_file->line, 0},
               fmt::format("the file says dt = {} s, but dt = {} s was given.", in_file->value, *options.dt),
               "one time step", "leave the given one out (motion.record.dt_s, --dt) or correct the file");
    if (in_file) return in_file->value;
    return options.survey && !options.dt ? 0.01 : options.dt;
}

double number_at(const RecordText& text, std::string_view rest, Place place, std::size_t& used)
{
    if (const auto value = parse_number(rest, &used)) return *value;
    const std::string_view token = trimmed(rest).substr(0, trimmed(rest).find_first_of(" \t,;"));
    const std::string word = lower(token.substr(std::min(token.size(), token.find_first_not_of("+-"))));
    std::string problem = fmt::format("{} is not a number.", in_quotes(token));
    std::string fix = "correct it, or start the line with # if it is a remark";
    if (token.empty())
        problem = "a value is missing here.", fix = "fill it in, or cut the record before it";
    else if (word.starts_with("nan") || word.starts_with("inf"))
        problem = fmt::format("the sample is {}.", in_quotes(token)),
        fix = "a gap in the record has to be closed by hand: nothing is filled in here";
    else if (token.find('*') != std::string_view::npos)
        problem =
            fmt::format("{} stands where a number did not fit its field when the file was written.", in_quotes(token)),
        fix = "get the record anew from its source";
    else if (!word.empty() && (word.front() == '.' || (word.front() >= '0' && word.front() <= '9')))
        problem = fmt::format("{} is too large to be read as a number.", in_quotes(token)), fix = "correct it";
    refuse(text, place, problem, "a finite decimal number", fix);
}

double checked_sample(const RecordText& text, double value, const AccelerationUnit& unit, Place place)
{
    const double accel = value * unit.factor;
    if (!(std::abs(accel) <= largest_sample))
        refuse(
            text, place,
            fmt::format("the sample {} {} = {:.4g} m/s2 is no ground acceleration.", shortest(value), unit.name, accel),
            fmt::format("at most {} m/s2 either way", largest_sample),
            "check the unit, and that the header is complete");
    return accel;
}

void check_count(const RecordText& text, const Stated<std::size_t>& stated, std::size_t found, std::string_view key)
{
    if (stated.value == found) return;
    refuse(text, {stated.line, 0}, fmt::format("{} = {}, but {} values follow.", key, stated.value, found),
           "as many values as stated",
           found < stated.value ? fmt::format("the file looks cut: get it anew, or correct {}", key)
                                : fmt::format("correct {}, or remove what does not belong to the record", key));
}

Record finished_record(const RecordText& text, std::vector<double> accel, double dt, RecordSource source)
{
    const Place place{source.first_line, 0};
    if (accel.size() < 2)
        refuse(text, place, fmt::format("the record has {} sample{}.", accel.size(), accel.size() == 1 ? "" : "s"),
               "at least 2 samples", "check that the file is complete");
    if (accel.size() > max_samples)
        refuse(text, place, fmt::format("the record has {} samples.", accel.size()),
               fmt::format("at most {}", max_samples), "cut it");
    check_dt(text, dt, {}, "of this file");

    double pga = 0.0, sum = 0.0;
    for (const double a : accel) pga = std::max(pga, std::abs(a)), sum += a;
    const double mean = sum / static_cast<double>(accel.size());
    source.file = text.file_name;
    source.title = printable(source.title);
    source.component = printable(source.component);
    Record record{std::filesystem::path(text.file_name).stem().string(), dt, std::move(accel), std::move(source), {}};
    if (pga > 3.0 * units::standard_gravity)
        record.warnings.push_back(fmt::format("PGA is {:.3g} g, more than any record known: check the unit ({})",
                                              pga / units::standard_gravity, record.source.unit));
    if (is_downwards(record.source.component))
        record.warnings.push_back("the component is positive downwards; as a vertical motion it has to be positive up: "
                                  "`record scale --factor -1`");
    if (pga == 0.0) record.warnings.push_back("all samples are zero");
    if (std::abs(mean) > 0.01 * pga)
        record.warnings.push_back(
            fmt::format("constant offset: the mean is {:.3g} m/s2, {:.2g} % of the PGA; `record baseline` removes it",
                        mean, 100.0 * std::abs(mean) / pga));
    return record;
}

} // namespace damslip::records
