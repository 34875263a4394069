#include "records/read/header.hpp"

#include "core/number.hpp"

#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

/// Keeps a value; a second, different one is an error that names both lines.
template <class T>
void keep(const RecordText& text, std::optional<Stated<T>>& slot, T value, std::size_t line, std::string_view key)
{
    if (slot && slot->value != value)
        refuse(text, {line, 0}, fmt::format("{} = {} here, but {} in line {}.", key, value, slot->value, slot->line),
               "one value for the whole file", "remove the wrong line");
    if (!slot) slot = Stated<T>{value, line};
}

double read_dt(const RecordText& text, std::string_view value, std::size_t line)
{
    std::size_t used = 0;
    const auto number = parse_number(value, &used);
    const std::string unit = number ? lower(trimmed(value.substr(used))) : "";
    const bool seconds = unit.empty() || unit == "s" || unit == "sec" || unit == "second" || unit == "seconds";
    if (!number || (!seconds && unit != "ms"))
        refuse(text, {line, 0}, fmt::format("the time step {} is not understood.", in_quotes(value)),
               "a number of seconds: \"dt: 0.01 s\"", "correct the line");
    return seconds ? *number : 0.001 * *number;
}

std::size_t read_count(const RecordText& text, std::string_view value, std::size_t line)
{
    const auto number = parse_whole_number_text(value);
    if (!number || *number < 0.0 || *number > 1e9 || *number != std::floor(*number))
        refuse(text, {line, 0}, fmt::format("the number of samples {} is not understood.", in_quotes(value)),
               "a whole number: \"n: 2000\"", "correct the line");
    return static_cast<std::size_t>(*number);
}

} // namespace

bool is_comment(std::string_view line)
{
    const std::string_view s = trimmed(line);
    return !s.empty() && (s.front() == '#' || s.front() == '%');
}

TextHeader read_text_header(const RecordText& text)
{
    TextHeader header;
    for (std::size_t k = 0; k < text.lines.size(); ++k) {
        if (!is_comment(text.lines[k])) continue;
        const std::string_view body = trimmed(trimmed(text.lines[k]).substr(1));
        const std::size_t colon = body.find(':'), line = k + 1;
        const std::string key = colon == std::string_view::npos ? "" : lower(trimmed(body.substr(0, colon)));
        const std::string_view value =
            colon == std::string_view::npos ? std::string_view{} : trimmed(body.substr(colon + 1));
        if (key == "units" || key == "unit")
            keep(text, header.unit, std::string(value), line, "unit");
        else if (key == "dt" || key == "time step")
            keep(text, header.dt, read_dt(text, value, line), line, "dt");
        else if (key == "n" || key == "npts" || key == "samples")
            keep(text, header.samples, read_count(text, value, line), line, "n");
        else if (key == "component" || key == "channel")
            header.component = value;
        else if (key == "name")
            header.name = value;
        else if (key == "title" || key == "event")
            header.title = value;
        else if (header.title.empty() && colon == std::string_view::npos)
            header.title = body;
    }
    return header;
}

} // namespace damslip::records
