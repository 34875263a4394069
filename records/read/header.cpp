#include "records/read/header.hpp"

#include "core/text.hpp"
#include "core/units.hpp"
#include "records/read/read_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string>

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

namespace {

bool is_decimal(char c)
{
    return c >= '0' && c <= '9';
}

bool is_one_of(std::string_view word, std::string_view blank_separated)
{
    return !word.empty() && contains(" " + std::string(blank_separated) + " ", " " + std::string(word) + " ");
}

/// "n10e", "s80w": degrees from north or south.
bool is_quadrant(std::string_view s)
{
    return s.size() >= 3 && s.size() <= 4 && is_one_of(s.substr(0, 1), "n s") &&
           is_one_of(s.substr(s.size() - 1), "e w") && std::all_of(s.begin() + 1, s.end() - 1, is_decimal);
}

/// Letters and digits of the first word, in lower case.
std::string first_word(std::string_view words)
{
    const std::string s = lower(trimmed(words));
    std::string word = s.substr(0, s.find_first_of(" ,;\t"));
    std::erase_if(word, [](char c) { return !is_decimal(c) && !(c >= 'a' && c <= 'z'); });
    return word;
}

} // namespace

Component component_in_part(std::string_view part)
{
    constexpr std::string_view verticals = "v z u up ud upd updown dn dwn down ver vert vertical vrt vt",
                               horizontals =
                                   "h n e s w ns ew sn we x y l t r hor horiz horizontal north south east west "
                                   "long longitudinal lon tran trans transverse trn lat lateral rad radial tan "
                                   "tangential";
    if (is_quadrant(part)) return Component::horizontal;
    if (part.size() == 3 && is_one_of(part.substr(0, 1), "h b e c s l f g d m") &&
        is_one_of(part.substr(1, 1), "n l g h")) {
        if (part[2] == 'z') return Component::vertical;
        if (is_one_of(part.substr(2), "n e 1 2 x y r t")) return Component::horizontal;
    }
    std::string_view word = part;
    if (word.size() >= 2 && is_decimal(word.back())) word.remove_suffix(1); // "ud2", "h1"
    if (is_one_of(word, verticals)) return Component::vertical;
    return is_one_of(word, horizontals) ? Component::horizontal : Component::none;
}

Component component_in(std::string_view words)
{
    const std::string first = first_word(words);
    if (!first.empty() && first.size() <= 3 && std::all_of(first.begin(), first.end(), is_decimal) &&
        std::stoi(first) <= 360)
        return Component::horizontal;
    if (const Component known = component_in_part(first); known != Component::none) return known;
    const std::string s = lower(words);
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
    for (std::size_t end = s.find_last_of(letters); end != std::string::npos;) {
        const std::size_t before = s.find_last_not_of(letters, end),
                          begin = before == std::string::npos ? 0 : before + 1;
        const Component known = component_in_part(std::string_view(s).substr(begin, end + 1 - begin));
        if (known != Component::none) return known;
        end = begin == 0 ? std::string::npos : s.find_last_of(letters, begin - 1);
    }
    return Component::none;
}

bool is_downwards(std::string_view words)
{
    return is_one_of(first_word(words), "dn dwn down downward downwards");
}

namespace {

constexpr std::array<AccelerationUnit, 11> table{{{"g", units::standard_gravity},
                                                  {"m/s2", 1.0},
                                                  {"cm/s2", 0.01},
                                                  {"gal", units::gal},
                                                  {"mg", 0.001 * units::standard_gravity},
                                                  {"mm/s2", 0.001},
                                                  // Of agency files only:
                                                  {"g/10", 0.1 * units::standard_gravity},
                                                  {"in/s2", 0.0254},
                                                  {"micro-g", 1e-6 * units::standard_gravity},
                                                  {"%g", 0.01 * units::standard_gravity},
                                                  {"ft/s2", 0.3048}}};

void replace_all(std::string& s, std::string_view from, std::string_view to)
{
    for (std::size_t at = 0; (at = s.find(from, at)) != std::string::npos; at += to.size())
        s.replace(at, from.size(), to);
}

} // namespace

std::optional<AccelerationUnit> acceleration_unit(std::string_view text)
{
    if (text.size() > 24) return std::nullopt;
    std::string s = lower(trimmed(text));
    // One spelling: "m/sec/sec", "m/s^2", "m/s**2", "m_s2", "m s-2", "m/s²" -> "m/s2".
    replace_all(s, "seconds", "s");
    replace_all(s, "sec", "s");
    replace_all(s, "\xc2\xb2", "2");
    replace_all(s, "**", "");
    replace_all(s, "^", "");
    for (const std::string_view per : {" s-2", "*s-2", ".s-2", "ms-2"})
        replace_all(s, per, per == "ms-2" ? "m/s2" : "/s2");
    replace_all(s, "/s/s", "/s2");
    replace_all(s, "_s2", "/s2");
    replace_all(s, "/ss", "/s2");
    replace_all(s, " ", "");
    for (const AccelerationUnit& unit : table)
        if (s == unit.name) return unit;
    if (s == "g's") return table[0];
    if (s == "gals") return table[3];
    if (s == "milli-g" || s == "millig") return table[4];
    return std::nullopt;
}

std::optional<std::string> take_unit(std::string& heading, const std::function<bool(std::string_view)>& known)
{
    const std::string_view whole = heading;
    const auto taken = [&](std::size_t name, std::size_t from, std::size_t length) {
        std::optional<std::string> unit(std::string(trimmed(whole.substr(from, length))));
        heading = std::string(trimmed(whole.substr(0, name)));
        return unit;
    };
    const std::size_t open = whole.find_last_of("[(");
    if (open != std::string_view::npos && (whole.back() == ']' || whole.back() == ')') &&
        known(whole.substr(open + 1, whole.size() - open - 2)))
        return taken(open, open + 1, whole.size() - open - 2);
    for (std::size_t at = whole.find_first_of("_ "); at != std::string_view::npos;
         at = whole.find_first_of("_ ", at + 1))
        if (known(whole.substr(at + 1))) return taken(at, at + 1, std::string_view::npos);
    return std::nullopt;
}

std::optional<std::string> unit_in_words(std::string_view line)
{
    static constexpr std::array<std::string_view, 11> keys{"sec and ", "seconds and ", "accel is ",  "acceleration is ",
                                                           "units:",   "units=",       "units are ", "units of ",
                                                           " in ",     "peak ",        "("};
    const std::string s = lower(line.substr(0, 160));
    std::optional<std::string> first;
    for (const std::string_view key : keys) {
        const std::size_t at = s.find(key);
        if (at == std::string::npos) continue;
        std::string_view rest = trimmed(std::string_view(s).substr(at + key.size()));
        std::size_t used = 0;
        if (parse_number(rest, &used)) rest = trimmed(rest.substr(used)); // "units of 1.00 mm/s/s"
        std::string word(rest.substr(0, rest.find_first_of(" ,;()\t")));
        while (!word.empty() && word.back() == '.') word.pop_back();
        if (acceleration_unit(word)) return word;
        if (!first && !word.empty() && key != "(" && key != "peak ") first = word;
    }
    return first;
}

} // namespace damslip::records
