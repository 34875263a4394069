#include "records/read/format.hpp"

#include "core/number.hpp"
#include "records/read/agency_samples.hpp"
#include "records/read/cut_end.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip::records {

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
