#include "scene/plausible.hpp"

#include "core/number.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

/// A reading of the number that would be usual.
struct Meant {
    double value = 0.0;  ///< in the key's first unit
    std::string if_what; ///< "MPa was meant"
    std::string spelled; ///< the line to write; empty: the value by itself
};

/// "kg_m3" -> "kg/m3".
std::string spoken(std::string suffix)
{
    if (const std::size_t at = suffix.find('_'); at != std::string::npos) suffix[at] = '/';
    return suffix;
}

std::string with_unit(const std::string& number, const UnitSuffix& unit)
{
    return unit.suffix.empty() ? number : number + " " + spoken(unit.suffix);
}

double in_first_unit(double value, const UnitSuffix& unit, const UnitSuffix& first)
{
    if (unit.suffix == first.suffix) return value;
    return to_si(value, unit) / first.factor;
}

std::string name_of(const UnitSuffix& unit)
{
    return unit.suffix.empty() ? "the plain number" : unit.tangent ? "an angle in deg" : spoken(unit.suffix);
}

/// The same figures in another unit of the key.
std::optional<Meant> other_unit(const Key& key, const WrittenNumber& number)
{
    for (const UnitSuffix& unit : key.units) {
        if (unit.suffix == number.unit.suffix || (unit.tangent && !(number.value >= 0 && number.value < 89.9)))
            continue;
        const double value = in_first_unit(number.value, unit, key.units.front());
        if (!key.usual->contains(value) || value == 0.0) continue;
        const std::string key_name = unit.suffix.empty() ? key.name : key.name + "_" + unit.suffix;
        return Meant{value, name_of(unit) + " was meant", key_name + " = " + shortest(number.value)};
    }
    return std::nullopt;
}

struct Step {
    double factor;
    const char* if_what;
};

std::optional<Meant> stepped(const Key& key, double value, std::initializer_list<Step> steps)
{
    for (const Step& step : steps)
        if (key.usual->contains(value * step.factor) && value != 0.0)
            return Meant{value * step.factor, step.if_what, {}};
    return std::nullopt;
}

/// What the number may have been meant as: one unit step away, for numbers without unit a step of the decimal point or of per
/// cent, for a hydraulic conductivity the sign of its exponent.
std::optional<Meant> meant(const Key& key, const WrittenNumber& number)
{
    const UnitSuffix& first = key.units.front();
    const double value = in_first_unit(number.value, number.unit, first);
    if (number.unit.tangent) return other_unit(key, number); // ten times the angle is not ten times its tangent
    if (first.suffix.empty()) {
        if (auto step = stepped(key, value, {{0.1, "the decimal point is one place off"}})) return step;
        if (auto unit = other_unit(key, number)) return unit;
        return stepped(key, value, {{0.01, "per cent was meant"}, {10.0, "the decimal point is one place off"}});
    }
    if (auto unit = other_unit(key, number)) return unit;
    if (first.suffix == "m_s" && value > 1.0 && key.usual->contains(1.0 / value))
        return Meant{1.0 / value, "the minus of the exponent is missing", {}};
    return stepped(key, value,
                   {{1e-3, "it is a thousandfold too large"},
                    {1e3, "it is a thousandfold too small"},
                    {1e-6, "it is a millionfold too large"},
                    {1e6, "it is a millionfold too small"}});
}

} // namespace

std::string six_digits(double value)
{
    return fmt::format("{:.6g}", value);
}

std::string usual_text(const Usual& usual, const UnitSuffix& unit)
{
    return fmt::format("{} ... {} ({})", shortest(usual.low), with_unit(shortest(usual.high), unit), usual.source);
}

std::optional<Diagnostic> unusual(const Key& key, const WrittenNumber& number)
{
    if (!key.usual) return std::nullopt;
    const UnitSuffix& first = key.units.front();
    const double value = in_first_unit(number.value, number.unit, first);
    if (key.usual->contains(value)) return std::nullopt;
    Diagnostic note;
    const std::string converted =
        number.unit.suffix == first.suffix ? "" : ", " + with_unit(six_digits(value), first) + ",";
    note.problem = number.subject + converted + " is unusual.";
    note.expected = usual_text(*key.usual, first);
    if (const auto guess = meant(key, number)) {
        note.fix = fmt::format("{} if {}", with_unit(six_digits(guess->value), first), guess->if_what);
        if (number.in_file && !guess->spelled.empty()) note.fix += ":  " + guess->spelled;
    } else {
        note.fix = "check value and unit";
    }
    return note;
}

Key key_named(const std::string& name)
{
    static SectionInput section;
    static const std::vector<KeyGroup> groups = key_groups(section);
    for (const KeyGroup& group : groups)
        for (const Key& key : group.keys)
            if (group.name + "." + key.name == name) return key;
    assert(false && "no such key");
    return {};
}

std::string note_text(const Diagnostic& note)
{
    std::string text = note.file;
    if (note.line > 0) text += ":" + std::to_string(note.line);
    text += (text.empty() ? "" : ": ") + note.problem;
    if (!note.expected.empty()) text += " Usual: " + note.expected + ".";
    if (note.fix.empty()) return text;
    std::string fix = note.fix;
    fix[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(fix[0])));
    return text + " " + fix + ".";
}

std::vector<std::string> note_texts(const std::vector<Diagnostic>& notes)
{
    std::vector<std::string> texts;
    for (const Diagnostic& note : notes) texts.push_back(note_text(note));
    return texts;
}

std::optional<Diagnostic> unusual_level(const std::string& subject, double level, double crest)
{
    if (!(level > crest * (1 + 1e-9))) return std::nullopt;
    Diagnostic note;
    note.problem =
        fmt::format("{} is {} m above the crest at {} m.", subject, six_digits(level - crest), six_digits(crest));
    note.expected = fmt::format("up to the crest, {} m; higher only at a spillway, or in a flood that overtops the dam "
                                "(EM 1110-2-2200)",
                                six_digits(crest));
    note.fix = level * 0.3048 <= crest && level * 0.3048 > 0.5 * crest
                   ? fmt::format("{} m if ft was meant", six_digits(level * 0.3048))
                   : "check datum and unit: levels are measured from the heel";
    return note;
}

} // namespace damslip
