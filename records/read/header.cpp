#include "records/read/header.hpp"

#include "core/number.hpp"
#include "records/read/component.hpp"
#include "records/read/unit.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

enum class Says { unit, dt, rate, samples, peak, columns, component, name, title };

/// Labels of agencies and programs, without brackets and the list of channels behind a comma, in lower case.
constexpr struct {
    std::string_view label;
    Says says;
} labels[] = {{"units", Says::unit},
              {"unit", Says::unit},
              {"amplitudeunit", Says::unit}, // CWB
              {"acceleration unit", Says::unit},
              {"acceleration units", Says::unit},
              {"unidades de los datos", Says::unit}, // UNAM
              {"unidades", Says::unit},
              {"dt", Says::dt},
              {"delta t", Says::dt},
              {"time step", Says::dt},
              {"timestep", Says::dt},
              {"time increment", Says::dt}, // ITACA
              {"time interval", Says::dt},
              {"sampling interval", Says::dt}, // AFAD
              {"sampling interval s", Says::dt},
              {"sample interval", Says::dt},
              {"sampling period", Says::dt},
              {"intervalo de muestreo", Says::dt},
              {"sampling rate", Says::rate}, // PESMOS
              {"sample rate", Says::rate},
              {"samplerate", Says::rate},
              {"sampling freq", Says::rate},
              {"sampling frequency", Says::rate},
              {"samples per second", Says::rate},
              {"frecuencia de muestreo", Says::rate},
              {"tasa de muestreo", Says::rate},
              {"velocidad de muestreo", Says::rate},
              {"n", Says::samples},
              {"npts", Says::samples},
              {"ndata", Says::samples},
              {"samples", Says::samples},
              {"number of data", Says::samples},
              {"number of samples", Says::samples},
              {"number of points", Says::samples},
              {"no of points", Says::samples},
              {"no of samples", Says::samples},
              {"num total de muestras", Says::samples},
              {"numero de muestras", Says::samples},
              {"pga", Says::peak},
              {"peak acceleration", Says::peak},
              {"max acc", Says::peak},
              {"maximum acceleration", Says::peak},
              {"datasequence", Says::columns},
              {"data sequence", Says::columns},
              {"columns", Says::columns},
              {"component", Says::component},
              {"channel", Says::component},
              {"orientation", Says::component},
              {"stream", Says::component},
              {"direction", Says::component},
              {"componente", Says::component},
              {"orientacion c1-c6", Says::component}, // UNAM: of all columns, between slashes
              {"orientacion", Says::component},
              {"name", Says::name},
              {"title", Says::title},
              {"event", Says::title}};

/// Keeps a value; a second, different one is an error that names both lines.
template <class T>
void keep(const RecordText& text, std::optional<Stated<T>>& slot, T value, std::size_t line, std::string_view key)
{
    if (slot && slot->value != value)
        refuse(text, {line, 0}, fmt::format("{} = {} here, but {} in line {}.", key, value, slot->value, slot->line),
               "one value for the whole file", "remove the wrong line");
    if (!slot) slot = Stated<T>{value, line};
}

/// One line "label (unit): value".
struct Labelled {
    std::string label, in_brackets; ///< lower case
    std::string_view value;
};

std::string as_label(std::string_view words)
{
    std::string label = lower(trimmed(words.substr(0, words.find_first_of(",([{"))));
    std::erase(label, '.');
    std::replace(label.begin(), label.end(), '_', ' ');
    return std::string(trimmed(label));
}

std::optional<Labelled> labelled(std::string_view line)
{
    std::size_t end = line.find_first_of(":=");
    if (end == std::string_view::npos) { // "Sampling Rate   200 Hz"
        end = line.find_first_of("0123456789");
        if (end == std::string_view::npos) return std::nullopt;
        return Labelled{as_label(line.substr(0, end)), "", trimmed(line.substr(end))};
    }
    Labelled found{as_label(line.substr(0, end)), "", trimmed(line.substr(end + 1))};
    const std::string_view words = line.substr(0, end);
    if (const std::size_t open = words.find_first_of("(["); open != std::string_view::npos)
        found.in_brackets = lower(words.substr(open + 1, words.find_first_of(")]", open) - open - 1));
    return found;
}

const Says* meaning_of(std::string_view label)
{
    for (const auto& row : labels)
        if (row.label == label) return &row.says;
    return nullptr;
}

/// A number at the start, with a point or a comma, or the first of "/ .010/ .010/ .010"; `rest`: what follows it.
std::optional<double> number_of(std::string_view value, std::string& rest)
{
    std::string s(value);
    if (s.starts_with('/')) s.erase(0, 1);
    if (!contains(s, ".")) std::replace(s.begin(), s.end(), ',', '.');
    std::size_t used = 0;
    const auto number = parse_number(s, &used);
    rest = number ? lower(trimmed(std::string_view(s).substr(used))) : "";
    return number;
}

/// [s]; nothing where it is not understood.
std::optional<double> step_of(const Labelled& line, bool rate)
{
    std::string unit;
    const auto number = number_of(line.value, unit);
    if (!number) return std::nullopt;
    if (unit.empty() || unit.starts_with('/')) unit = line.in_brackets;
    if (rate) return *number > 0.0 ? std::optional(1.0 / *number) : std::nullopt;
    if (unit == "ms" || unit == "msec") return 0.001 * *number;
    const bool seconds = unit.empty() || unit.starts_with("sec") || unit == "s";
    return seconds ? number : std::nullopt;
}

std::optional<std::size_t> count_of(const Labelled& line)
{
    std::string rest;
    const auto number = number_of(line.value, rest);
    const bool alone = rest.empty() || rest.starts_with('/');
    if (!number || !alone || *number < 0.0 || *number > 1e9 || *number != std::floor(*number)) return std::nullopt;
    return static_cast<std::size_t>(*number);
}

/// "gal. DCoffset(corr)" is "gal".
std::string unit_of(std::string_view value)
{
    if (acceleration_unit(value)) return std::string(value);
    std::string word(value.substr(0, value.find_first_of(" ,;([")));
    while (!word.empty() && word.back() == '.') word.pop_back();
    return acceleration_unit(word) ? word : std::string(value);
}

/// @param comment  whose known keys must be readable
/// @returns whether the line says one of the values
bool take(const RecordText& text, TextHeader& header, Says says, const Labelled& line, std::size_t at, bool comment)
{
    const auto fail = [&](const std::string& problem, const char* expected) {
        if (comment && !line.value.empty()) refuse(text, {at, 0}, problem, expected, "correct the line");
        return false;
    };
    switch (says) {
    case Says::unit:
        if (!comment && !acceleration_unit(unit_of(line.value))) return false;
        keep(text, header.unit, unit_of(line.value), at, "unit");
        return true;
    case Says::dt:
    case Says::rate:
        if (const auto dt = step_of(line, says == Says::rate)) return keep(text, header.dt, *dt, at, "dt"), true;
        return fail(fmt::format("the time step {} is not understood.", in_quotes(line.value)),
                    "a number of seconds: \"dt: 0.01 s\"");
    case Says::samples:
        if (const auto count = count_of(line)) return keep(text, header.samples, *count, at, "n"), true;
        return fail(fmt::format("the number of samples {} is not understood.", in_quotes(line.value)),
                    "a whole number: \"n: 2000\"");
    case Says::peak: {
        std::string rest;
        const auto unit = acceleration_unit(line.in_brackets);
        const auto peak = number_of(line.value, rest);
        if (!unit || !peak || !rest.empty()) return false;
        header.peak = Stated<double>{*peak * unit->factor, at};
        return true;
    }
    case Says::columns:
        header.columns = Stated<std::string>{std::string(line.value), at};
        return true;
    case Says::component:
        if (line.value.starts_with('/')) { // one for each column, between slashes
            std::string names(line.value.substr(1));
            std::replace(names.begin(), names.end(), ' ', '_');
            std::replace(names.begin(), names.end(), ';', '_');
            std::replace(names.begin(), names.end(), '/', ';');
            header.columns = Stated<std::string>{names, at};
            return true;
        }
        if (!comment && component_in(line.value) == Component::none) return false;
        // The number of a channel is no azimuth.
        header.component = (line.label == "channel" && parse_whole_number_text(line.value) ? "channel " : "") +
                           std::string(line.value);
        return true;
    case Says::name:
        header.name = comment ? line.value : std::string_view(header.name);
        return comment;
    case Says::title:
        header.title = line.value;
        return true;
    }
    return false;
}

} // namespace

bool is_comment(std::string_view line)
{
    const std::string_view s = trimmed(line);
    return !s.empty() && (s.front() == '#' || s.front() == '%');
}

TextHeader read_text_header(const RecordText& text, std::size_t first_number_line)
{
    TextHeader header;
    for (std::size_t k = 0; k < text.lines.size(); ++k) {
        const bool comment = is_comment(text.lines[k]);
        const std::size_t at = k + 1;
        if (!comment && at >= first_number_line) continue;
        const std::string_view body = trimmed(trimmed(text.lines[k]).substr(comment ? 1 : 0));
        if (body.empty()) continue;
        const auto line = labelled(body);
        const Says* says = line ? meaning_of(line->label) : nullptr;
        // Without a colon a comment is a remark, whatever it begins with, and other words are known by a step or a count alone.
        const bool assigns = contains(body, ":") || (!comment && contains(body, "="));
        const bool number = says && (*says == Says::dt || *says == Says::rate || *says == Says::samples);
        const bool meant = comment ? assigns : (assigns || number) && line && line->label != "n";
        if (says && meant && take(text, header, *says, *line, at, comment))
            header.understood.push_back(at);
        else if (comment && header.title.empty() && !contains(body, ":"))
            header.title = body;
        else if (!comment && (contains(lower(body), "accel") || contains(lower(body), "unit")))
            if (const auto unit = unit_in_words(body); unit && acceleration_unit(*unit) && !header.unit) {
                header.unit = Stated<std::string>{*unit, at};
                header.understood.push_back(at);
            }
    }
    return header;
}

} // namespace damslip::records
