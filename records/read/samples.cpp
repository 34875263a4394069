#include "records/read/samples.hpp"

#include "core/number.hpp"
#include "core/units.hpp"
#include "records/read/component.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace damslip::records {

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
