#include "scene/document.hpp"

#include "core/number.hpp"
#include "core/units.hpp"
#include "scene/fragility_keys.hpp"
#include "scene/key_methods.hpp"
#include "scene/key_table.hpp"
#include "scene/usual.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip {

namespace {

using Json = nlohmann::ordered_json;

bool is_number(const Slot& slot)
{
    return std::holds_alternative<double*>(slot) || std::holds_alternative<std::optional<double>*>(slot) ||
           std::holds_alternative<NumberOrWord>(slot);
}

Json number_schema(const Range& range, double canonical_to_unit)
{
    Json j{{"type", "number"}};
    if (std::isfinite(range.low)) j[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low * canonical_to_unit;
    if (std::isfinite(range.high)) j[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high * canonical_to_unit;
    return j;
}

/// The usual range of a number in the unit of one spelling. Checkers pass over a keyword they do not know.
Json usual_schema(const Usual& usual, const UnitSuffix& unit, const UnitSuffix& first)
{
    const auto in_unit = [&](double x) {
        return unit.tangent ? std::atan(x) / units::degree : x * first.factor / unit.factor;
    };
    return {{"minimum", in_unit(usual.low)}, {"maximum", in_unit(usual.high)}, {"source", usual.source}};
}

Json value_schema(const Key& key, const UnitSuffix& unit, const Slot& slot)
{
    if (is_number(slot)) {
        const Range degrees{0, 89.9, false, true};
        Json j = unit.tangent ? number_schema(degrees, 1.0)
                              : number_schema(key.range, key.units.front().factor / unit.factor);
        if (const auto* either = std::get_if<NumberOrWord>(&slot)) return {{"anyOf", {j, {{"const", either->word}}}}};
        return j;
    }
    if (std::holds_alternative<int*>(slot) || std::holds_alternative<std::optional<int>*>(slot))
        return {{"type", "integer"}};
    if (std::holds_alternative<bool*>(slot)) return {{"type", "boolean"}};
    if (const auto* c = std::get_if<Choice>(&slot)) return {{"enum", c->words}};
    if (std::holds_alternative<std::vector<Point>*>(slot))
        return {{"type", "array"},
                {"minItems", 1},
                {"items", {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", {{"type", "number"}}}}}};
    if (std::holds_alternative<std::vector<std::string>*>(slot))
        return {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "string"}, {"minLength", 1}}}};
    return {{"type", "string"}, {"minLength", 1}};
}

/// A Scene with every optional table present, so that each key has a place to look at.
Slot probe(const KeyGroup& group, const Key& key, Scene& scene)
{
    return key.slot(group.open(scene));
}

Json group_schema(const KeyGroup& group, Scene& scene)
{
    Json properties = Json::object();
    Json required = Json::array();
    Json one_of_spellings = Json::array();
    for (const Key& key : group.keys) {
        const Slot slot = probe(group, key, scene);
        const Units units = key.units.empty() ? Units{{"", 1.0}} : key.units;
        Json spellings = Json::array();
        for (const UnitSuffix& unit : units) {
            Json schema = value_schema(key, unit, slot);
            schema["description"] = key.meaning + (key.default_text.empty() ? "" : ". Default: " + key.default_text);
            if (key.usual)
                schema["usual"] = key.second_units.empty() ? usual_schema(*key.usual, unit, units.front())
                                                           : usual_schema(*key.usual, {}, {});
            const std::string name = unit.suffix.empty() ? key.name : key.name + "_" + unit.suffix;
            properties[name] = schema;
            spellings.push_back({{"required", {name}}});
        }
        if (!key.required) continue;
        if (spellings.size() == 1)
            required.push_back(key.canonical());
        else
            one_of_spellings.push_back({{"oneOf", spellings}});
    }
    Json j{{"type", "object"},
           {"description", group.meaning},
           {"additionalProperties", false},
           {"properties", properties}};
    if (!required.empty()) j["required"] = required;
    if (!one_of_spellings.empty()) j["allOf"] = one_of_spellings;
    return group.presence == Presence::list ? Json{{"type", "array"}, {"items", j}} : j;
}

std::string escaped(std::string text)
{
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.replace(at, 1, "\\|");
    return text;
}

std::string allowed(const Key& key, const Slot& slot)
{
    if (const auto* c = std::get_if<Choice>(&slot)) return fmt::format("`{}`", fmt::join(c->words, "`, `"));
    if (std::holds_alternative<bool*>(slot)) return "`true`, `false`";
    if (std::holds_alternative<int*>(slot) || std::holds_alternative<std::optional<int>*>(slot)) return "whole number";
    if (const auto* either = std::get_if<NumberOrWord>(&slot))
        return key.range.text() + " or `\"" + either->word + "\"`";
    if (is_number(slot)) return key.range.text();
    if (std::holds_alternative<std::vector<Point>*>(slot)) return "list of pairs, second entry " + key.range.text();
    if (std::holds_alternative<std::vector<std::string>*>(slot)) return "list of texts";
    return "text";
}

std::string usual_cell(const Key& key)
{
    if (!key.usual) return "";
    return fmt::format("{} ... {}{} ({})", shortest(key.usual->low), shortest(key.usual->high),
                       key.usual->or_zero && !(key.usual->low <= 0.0) ? ", or 0" : "", key.usual->source);
}

/// A law in braces: its numbers.
Json law_schema(const FragilityKey& key)
{
    Json properties = Json::object(), required = Json::array();
    for (const LawNumber& number : key.numbers) {
        properties[number.name] = number_schema(number.positive ? Range::above(0) : Range::any(), 1.0);
        if (number.required) required.push_back(number.name);
    }
    Json j{{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
    if (!required.empty()) j["required"] = required;
    return j;
}

Json value_schema(const FragilityKey& key)
{
    const Json text{{"type", "string"}, {"minLength", 1}};
    switch (key.value) {
    case FragilityValue::number:
        return number_schema(key.range, 1.0);
    case FragilityValue::whole: {
        Json j = number_schema(key.range, 1.0);
        j["type"] = "integer";
        return j;
    }
    case FragilityValue::flag:
        return {{"type", "boolean"}};
    case FragilityValue::word:
        return {{"enum", key.words}};
    case FragilityValue::text:
        return text;
    case FragilityValue::text_or_list:
        return {{"anyOf", {text, {{"type", "array"}, {"minItems", 1}, {"items", text}}}}};
    case FragilityValue::numbers:
        return {{"type", "array"}, {"minItems", 1}, {"items", number_schema(key.range, 1.0)}};
    case FragilityValue::names:
        return {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", text}};
    case FragilityValue::law:
        return law_schema(key);
    case FragilityValue::discrete: {
        const Json weights{{"type", "array"}, {"minItems", 1}, {"items", number_schema(Range::above(0), 1.0)}};
        return {{"type", "object"},
                {"additionalProperties", false},
                {"required", {"values", "weights"}},
                {"properties", {{"values", {{"type", "array"}, {"minItems", 1}}}, {"weights", weights}}}};
    }
    }
    return {};
}

/// "number > 0", "`sobol`, `lhs`, `random`".
std::string allowed(const FragilityKey& key)
{
    switch (key.value) {
    case FragilityValue::number:
        return key.range.text();
    case FragilityValue::whole:
        return "whole number, " + key.range.text();
    case FragilityValue::flag:
        return "`true`, `false`";
    case FragilityValue::word:
        return fmt::format("`{}`", fmt::join(key.words, "`, `"));
    case FragilityValue::text:
        return "text";
    case FragilityValue::text_or_list:
        return "text, or list of texts";
    case FragilityValue::numbers:
        return "list of numbers " + key.range.text();
    case FragilityValue::names:
        return "two names";
    case FragilityValue::law:
    case FragilityValue::discrete:
        return fmt::format("`{}`", key.example);
    }
    return {};
}

Json group_schema(const FragilityKeyTable& table)
{
    Json properties = Json::object(), required = Json::array();
    for (const FragilityKey& key : table.keys) {
        properties[key.name] = value_schema(key);
        const bool needed = key.default_text == "required";
        properties[key.name]["description"] =
            key.meaning + (key.default_text.empty() || needed ? "" : ". Default: " + key.default_text);
        if (needed) required.push_back(key.name);
    }
    Json j{{"type", "object"},
           {"description", table.meaning},
           {"additionalProperties", false},
           {"properties", properties}};
    if (!required.empty()) j["required"] = required;
    return table.presence == Presence::list ? Json{{"type", "array"}, {"items", j}} : j;
}

std::string header_of(const std::string& name, Presence presence)
{
    return name.empty() ? "Top level" : presence == Presence::list ? "`[[" + name + "]]`" : "`[" + name + "]`";
}

std::string fragility_markdown()
{
    std::string out;
    for (const FragilityKeyTable& table : fragility_key_tables()) {
        out += fmt::format("\n## {}\n{}\n\n| key | allowed | default | meaning |\n| --- | --- | --- | --- |\n",
                           header_of(table.name, table.presence), table.meaning);
        for (const FragilityKey& key : table.keys)
            out += fmt::format("| `{}` | {} | {} | {} |\n", key.name, escaped(allowed(key)), escaped(key.default_text),
                               escaped(key.meaning));
    }
    return out;
}

std::string sources_markdown()
{
    std::string out = "\n## Sources of the usual ranges\nThe ranges are rounded outward from what a source gives.\n\n"
                      "| source | |\n| --- | --- |\n";
    for (const UsualSource& source : usual_sources()) out += fmt::format("| {} | {} |\n", source.name, source.full);
    out += "\nNumbers without a usual range:\n\n| key | why |\n| --- | --- |\n";
    for (const NoUsualRange& key : no_usual_range()) out += fmt::format("| `{}` | {} |\n", key.key, key.reason);
    return out;
}

} // namespace

std::string scene_schema()
{
    SectionInput section;
    Scene scene;
    Json root{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", "damslip scene"},
              {"type", "object"},
              {"additionalProperties", false}};
    Json properties = Json::object();
    Json required = Json::array();
    for (const KeyGroup& group : key_groups(section)) {
        Json schema = group_schema(group, scene);
        if (group.name.empty()) {
            for (auto& [name, value] : schema["properties"].items()) properties[name] = value;
            continue;
        }
        const std::size_t dot = group.name.find('.');
        if (dot != std::string::npos) {
            properties[group.name.substr(0, dot)]["properties"][group.name.substr(dot + 1)] = schema;
            continue;
        }
        if (group.presence == Presence::always && (schema.contains("required") || schema.contains("allOf")))
            required.push_back(group.name);
        properties[group.name] = schema;
    }
    for (const FragilityKeyTable& table : fragility_key_tables()) {
        const std::size_t dot = table.name.find('.');
        if (dot == std::string::npos)
            properties[table.name] = group_schema(table);
        else
            properties[table.name.substr(0, dot)]["properties"][table.name.substr(dot + 1)] = group_schema(table);
    }
    required.push_back("section");
    properties["expect"] = {
        {"type", "object"},
        {"additionalProperties", {{"type", "object"}, {"required", {"value", "digits", "source"}}}}};
    root["anyOf"] = {{{"required", {"wedge"}}}, {{"required", required}}}; // a wedge has no section
    root["properties"] = properties;
    return root.dump(2) + "\n";
}

std::string scene_keys_markdown()
{
    SectionInput section;
    Scene scene;
    std::string out =
        "# Keys of a scene file\n\nMade from the key table of the program (`damslip schema --markdown`). "
        "Numbers carry their unit in the key; the other spellings of a key "
        "accept other units.\nTables and keys that are not given switch nothing on.\n\nA value outside what is allowed "
        "is an "
        "error. A value that is allowed, but outside what is usual, is noted: on standard error, in the "
        "results and in the report, with the value one unit step away that would be usual. With `--strict` "
        "a note is an error (exit code 3), before anything is computed. Values of the command line "
        "(`--friction`, `--scale`, `--dt`, axes of `sweep`) are looked at like their keys. Values beside "
        "each other are looked at, too: water levels beside the crest and each other, base, rock box, "
        "curtain and drains beside the size of the dam.\n\n"
        "Honoured by: methods whose answer follows the key (rigid: the rigid block of `screen` and `sweep`; flexible: "
        "[flexible_block]; equilibrium: load combinations; spectrum: `--response-spectrum`; fe, reduced: `fe`, "
        "`fe --reduced`; all: these, regressions and `modes`). Another method has no use for it, refuses it, or says "
        "in a note that its slip leaves it out; then no PASS rests on that slip.\n";
    for (const KeyGroup& group : key_groups(section)) {
        out += fmt::format(
            "\n## {}\n{}\n\n| key | allowed | usual | default | honoured by | meaning |\n| --- | --- | --- | --- | --- | --- |\n",
            header_of(group.name, group.presence), group.meaning);
        for (const Key& key : group.keys) {
            std::vector<std::string> others = key.spellings();
            others.erase(others.begin());
            const Slot slot = probe(group, key, scene);
            out += fmt::format("| `{}`{} | {} | {} | {} | {} | {} |\n", key.canonical(),
                               others.empty() ? "" : fmt::format(" (or {})", fmt::join(others, ", ")),
                               escaped(allowed(key, slot)), escaped(usual_cell(key)), escaped(key.default_text),
                               method_words(honoured_by(group.name, key.name)), escaped(key.meaning));
        }
    }
    return out + fragility_markdown() + sources_markdown();
}

} // namespace damslip
