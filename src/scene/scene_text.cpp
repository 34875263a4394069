#include "scene/scene_text.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "scene/check.hpp"
#include "scene/keys.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

namespace damslip {

struct SceneText::Tables {
    std::filesystem::path file;
    std::string text; ///< as it was read; empty: root has other values
    toml::table root;
    SectionInput section;
    std::vector<KeyGroup> groups = key_groups(section);

    /// The tables with values set. @param of  the text that these are of
    toml::table with(std::span<const KeyChange> changes, const SceneText& of) const;
};

namespace {

/// Can a key of this kind be set to a number, a word, true or false?
bool settable(const Key& key)
{
    return key.value.kind <= ValueKind::word;
}

/// "lift_joint[crown].friction" -> group "lift_joint", entry "crown", key "friction"; "seam[A].wedge.friction" -> "seam.wedge", "A", "friction".
struct KeyPath {
    std::string group, entry, key;
};
KeyPath path_of(const std::string& text)
{
    const std::size_t open = text.find('['), close = text.rfind(']');
    const bool listed = open != std::string::npos && close != std::string::npos && close > open;
    const std::size_t dot = listed ? text.find('.', close) : text.rfind('.');
    if (dot == std::string::npos) return {"", "", text};
    KeyPath path{text.substr(0, listed ? open : dot), "", text.substr(dot + 1)};
    if (!listed) return path;
    path.entry = text.substr(open + 1, close - open - 1);
    if (const std::size_t inner = path.key.rfind('.'); inner != std::string::npos) {
        path.group += "." + path.key.substr(0, inner);
        path.key.erase(0, inner + 1);
    }
    return path;
}

struct Target {
    const KeyGroup* group;
    const Key* key;
    std::string entry; ///< as typed
};

std::optional<Target> find(const std::vector<KeyGroup>& groups, const std::string& text)
{
    const KeyPath path = path_of(text);
    for (const KeyGroup& group : groups) {
        if (group.name != path.group || group.in_list() == path.entry.empty()) continue;
        for (const Key& key : group.keys) {
            const std::vector<std::string> names = key.spellings();
            if (std::find(names.begin(), names.end(), path.key) != names.end() && settable(key))
                return Target{&group, &key, path.entry};
        }
    }
    return std::nullopt;
}

/// Name of the i-th entry of a list, from 0; its number where it has none.
std::string entry_name(const toml::table& entry, std::size_t i)
{
    return entry["name"].value<std::string>().value_or(std::to_string(i + 1));
}

[[noreturn]] void refuse_key(const std::filesystem::path& file, const std::string& key,
                             const std::vector<std::string>& known)
{
    const std::string_view near = nearest(key, known);
    refuse(
        file, fmt::format("unknown key {}.{}", key, near.empty() ? "" : fmt::format(" Did you mean {}?", near)),
        "a number or a choice of the scene with its unit, such as contact.friction or reservoir.level_m; an entry of a "
        "list by its name: lift_joint[NAME].friction",
        near.empty() ? "damslip worker SCENE lists the keys in its first line" : fmt::format("write  {}", near));
}

/// The entry of a list that is meant by its name or its number, and its name; null: there is none.
std::pair<toml::table*, std::string> entry_of(toml::table& root, const Target& target)
{
    toml::array* list = root.at_path(list_of(*target.group)).as_array();
    for (std::size_t i = 0; list && i < list->size(); ++i)
        if (toml::table* entry = (*list)[i].as_table())
            if (const std::string name = entry_name(*entry, i);
                name == target.entry || std::to_string(i + 1) == target.entry)
                return {entry, name};
    return {};
}

/// The table that holds the key, made where the file has none.
toml::table* table_of(toml::table& root, const Target& target)
{
    const std::string& name = target.group->name;
    if (target.group->in_list()) {
        toml::table* const entry = entry_of(root, target).first;
        if (!entry || !target.group->inside) return entry;
        return (*entry)[name.substr(name.find('.') + 1)].as_table();
    }
    toml::table* at = &root;
    for (std::size_t from = 0; from < name.size();) {
        const std::size_t dot = std::min(name.find('.', from), name.size());
        const std::string part = name.substr(from, dot - from);
        if (!at->contains(part)) at->insert(part, toml::table{});
        at = (*at)[part].as_table();
        if (!at) return nullptr;
        from = dot + 1;
    }
    return at;
}

void put(toml::table& table, const std::string& name, const KeyValue& value, bool whole_number)
{
    if (const auto* d = std::get_if<double>(&value)) {
        const bool fits = whole_number && std::floor(*d) == *d && std::abs(*d) < 1e9;
        if (fits)
            table.insert_or_assign(name, static_cast<std::int64_t>(*d));
        else
            table.insert_or_assign(name, *d);
    } else if (const auto* b = std::get_if<bool>(&value)) {
        table.insert_or_assign(name, *b);
    } else {
        table.insert_or_assign(name, std::get<std::string>(value));
    }
}

/// The friction of the base takes a residual friction above it along, as --friction does.
void lower_residual(toml::table& contact, const KeyChange& change)
{
    const auto* friction = std::get_if<double>(&change.value);
    const auto residual = contact["residual_friction"].value<double>();
    if (friction && residual && *residual > *friction) contact.insert_or_assign("residual_friction", *friction);
}

} // namespace

std::string text_of(const KeyValue& value)
{
    if (const auto* d = std::get_if<double>(&value)) return shortest(*d);
    if (const auto* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
    return "\"" + std::get<std::string>(value) + "\"";
}

SceneText::SceneText(std::string_view toml_text, std::filesystem::path file)
{
    auto tables = std::make_shared<Tables>();
    tables->text = toml_text;
    tables->root = toml_of(toml_text, file);
    tables->file = std::move(file);
    tables_ = std::move(tables);
}

SceneText SceneText::read(const std::filesystem::path& file)
{
    return {read_file(file, 4u << 20), file};
}

const std::filesystem::path& SceneText::file() const
{
    return tables_->file;
}

toml::table SceneText::Tables::with(std::span<const KeyChange> changes, const SceneText& of) const
{
    toml::table changed = root;
    std::set<std::pair<const toml::table*, const Key*>> set; // of a list: key and entry
    for (const KeyChange& change : changes) {
        const std::optional<Target> target = find(groups, change.key);
        toml::table* table = target ? table_of(changed, *target) : nullptr;
        if (!table) refuse_key(file, change.key, of.keys());
        if (!set.emplace(table, target->key).second)
            refuse(file, fmt::format("{} is set twice.", change.key), "one value and one unit for each key",
                   "leave one out");
        for (const std::string& spelling : target->key->spellings()) table->erase(spelling);
        put(*table, path_of(change.key).key, change.value, target->key->value.kind == ValueKind::whole);
        if (change.key == "contact.friction") lower_residual(*table, change);
    }
    return changed;
}

Scene SceneText::with(std::span<const KeyChange> changes) const
{
    if (changes.empty() && !tables_->text.empty()) // a copy of the tables has no lines for messages
        return scene_of_table(toml_of(tables_->text, tables_->file), tables_->file, FileCheck::must_exist);
    return scene_of_table(tables_->with(changes, *this), tables_->file, FileCheck::must_exist);
}

SceneText SceneText::set(std::span<const KeyChange> changes) const
{
    auto tables = std::make_shared<Tables>();
    tables->file = tables_->file;
    tables->root = tables_->with(changes, *this);
    return SceneText(std::shared_ptr<const Tables>(std::move(tables)));
}

double SceneText::written(const std::string& key) const
{
    const std::optional<Target> target = find(tables_->groups, key);
    if (!target) refuse_key(tables_->file, key, keys());
    toml::table root = tables_->root;
    const toml::table* table = table_of(root, *target);
    const std::optional<double> value = table ? (*table)[path_of(key).key].value<double>() : std::nullopt;
    if (!value)
        refuse(tables_->file, fmt::format("{} is not in the file.", key),
               "a number for a factor to multiply, in the same spelling", fmt::format("write  {} = ...", key));
    return *value;
}

std::vector<std::string> SceneText::keys() const
{
    std::vector<std::string> names;
    const auto add = [&names](const KeyGroup& group, const std::string& label) {
        for (const Key& key : group.keys)
            if (settable(key)) names.push_back(label.empty() ? key.canonical() : label + "." + key.canonical());
    };
    const bool wedge = tables_->root.contains("wedge");
    for (const KeyGroup& group : tables_->groups) {
        if (wedge && !belongs_to_wedge(group.name)) continue;
        if (group.in_list()) {
            const std::string name = list_of(group), inner = group.inside ? group.name.substr(name.size() + 1) : "";
            const toml::array* list = tables_->root.at_path(name).as_array();
            for (std::size_t i = 0; list && i < list->size(); ++i)
                if (const toml::table* entry = (*list)[i].as_table(); entry && (inner.empty() || entry->contains(inner)))
                    add(group, fmt::format("{}[{}]{}{}", name, entry_name(*entry, i), inner.empty() ? "" : ".", inner));
        } else if (group.presence == Presence::always || tables_->root.at_path(group.name)) {
            add(group, group.name);
        }
    }
    return names;
}

std::vector<std::string> SceneText::words(const std::string& key) const
{
    const std::optional<Target> target = find(tables_->groups, key);
    if (!target) refuse_key(tables_->file, key, keys());
    const Value& value = target->key->value;
    return value.kind == ValueKind::word ? value.words : std::vector<std::string>{};
}

std::string SceneText::canonical(const std::string& key) const
{
    const std::optional<Target> target = find(tables_->groups, key);
    if (!target) refuse_key(tables_->file, key, keys());
    std::string label = target->group->name;
    if (!target->entry.empty()) {
        toml::table root = tables_->root;
        if (!table_of(root, *target)) refuse_key(tables_->file, key, keys());
        const std::string name = list_of(*target->group), inner = label.substr(name.size());
        label = name + "[" + entry_of(root, *target).second + "]" + inner;
    }
    return label.empty() ? target->key->canonical() : label + "." + target->key->canonical();
}

namespace {

/// The strength of the plane that the block slides on; null: that of the base.
Contact* strength_of_plane(Scene& scene)
{
    const std::string& name = scene.planes.slides_on;
    if (name.empty()) return nullptr;
    for (Seam& seam : scene.seams)
        if (seam.name == name) return &seam.strength;
    for (LiftJoint& joint : scene.lift_joints)
        if (joint.name == name) return &joint.strength;
    return scene.lifts ? &scene.lifts->strength : nullptr;
}

void set_friction(Contact& strength, double friction)
{
    strength.friction = friction;
    if (strength.residual_friction) strength.residual_friction = std::min(*strength.residual_friction, friction);
}

} // namespace

void set_friction(Scene& scene, double friction)
{
    if (Contact* strength = strength_of_plane(scene)) {
        if (!strength->friction_table.empty())
            refuse_usage(fmt::format("the friction of \"{}\" is given twice, by the command line and by its "
                                     "friction_table_m.",
                                     scene.planes.slides_on),
                         "one of them", "take friction_table_m out of the scene to vary the friction");
        set_friction(*strength, friction);
        for (std::size_t i = 0; scene.seam_body && i < scene.seam_body->of_seam; ++i)
            set_friction(scene.seam_body->strengths[i], friction);
        return;
    }
    if (!scene.contact.friction_table.empty())
        refuse_usage("the friction is given twice, by the command line and by contact.friction_table_m of the scene.",
                     "one of them", "take friction_table_m out of the scene to vary the friction");
    if (scene.wedge) {
        std::vector<RockPlane>& planes = scene.wedge->planes;
        const double old = planes.front().friction;
        planes.back().friction = old > 0.0 ? planes.back().friction * (friction / old) : friction;
        planes.front().friction = friction;
    }
    set_friction(scene.contact, friction);
}

Scene with_friction(Scene scene, double friction)
{
    set_friction(scene, friction);
    return scene;
}

namespace {

using Json = nlohmann::ordered_json;

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

/// A law in braces: its numbers.
Json law_schema(const Key& key)
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

/// @param unit  of one spelling @param first  of the range
Json value_schema(const Key& key, const UnitSuffix& unit, const UnitSuffix& first)
{
    const Json number = unit.tangent ? number_schema({0, 89.9, false, true}, 1.0)
                                     : number_schema(key.range, first.factor / unit.factor);
    const Json text{{"type", "string"}, {"minLength", 1}};
    switch (key.value.kind) {
    case ValueKind::number:
        return number;
    case ValueKind::number_or_word:
        return {{"anyOf", {number, {{"const", key.value.words.front()}}}}};
    case ValueKind::whole: {
        Json j = number;
        j["type"] = "integer";
        return j;
    }
    case ValueKind::flag:
        return {{"type", "boolean"}};
    case ValueKind::word:
        return {{"enum", key.value.words}};
    case ValueKind::text:
        return text;
    case ValueKind::texts:
        return {{"type", "array"}, {"minItems", 1}, {"items", text}};
    case ValueKind::numbers:
        return {{"type", "array"}, {"minItems", 1}, {"items", number}};
    case ValueKind::ends:
        return {{"type", "array"}, {"minItems", 2}, {"items", number}, {"maxItems", 2}};
    case ValueKind::pairs:
        return {{"type", "array"},
                {"minItems", 1},
                {"items", {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", {{"type", "number"}}}}}};
    case ValueKind::text_or_list:
        return {{"anyOf", {text, {{"type", "array"}, {"minItems", 1}, {"items", text}}}}};
    case ValueKind::names:
        return {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", text}};
    case ValueKind::law:
        return law_schema(key);
    case ValueKind::discrete: {
        const Json weights{{"type", "array"}, {"minItems", 1}, {"items", number_schema(Range::above(0), 1.0)}};
        return {{"type", "object"},
                {"additionalProperties", false},
                {"required", {"values", "weights"}},
                {"properties", {{"values", {{"type", "array"}, {"minItems", 1}}}, {"weights", weights}}}};
    }
    }
    return {};
}

Json group_schema(const KeyGroup& group)
{
    Json properties = Json::object();
    Json required = Json::array();
    Json one_of_spellings = Json::array();
    for (const Key& key : group.keys) {
        const Units units = key.units.empty() ? Units{{"", 1.0}} : key.units;
        const bool says_default = !key.default_text.empty() && (key.value.slot || !key.required);
        Json spellings = Json::array();
        for (const UnitSuffix& unit : units) {
            Json schema = value_schema(key, unit, units.front());
            schema["description"] = key.meaning + (says_default ? ". Default: " + key.default_text : "");
            if (key.usual)
                schema["usual"] = key.second_units.empty() ? usual_schema(*key.usual, unit, units.front())
                                                           : usual_schema(*key.usual, {}, {});
            properties[key.spelled(unit)] = schema;
            spellings.push_back({{"required", {key.spelled(unit)}}});
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

/// "> 0", "`true`, `false`", "`sobol`, `lhs`, `random`".
std::string allowed(const Key& key)
{
    const std::string range = key.range.text();
    switch (key.value.kind) {
    case ValueKind::number:
        return range;
    case ValueKind::number_or_word:
        return range + " or `\"" + key.value.words.front() + "\"`";
    case ValueKind::whole:
        return key.value.slot ? "whole number" : "whole number, " + range;
    case ValueKind::flag:
        return "`true`, `false`";
    case ValueKind::word:
        return fmt::format("`{}`", fmt::join(key.value.words, "`, `"));
    case ValueKind::text:
        return "text";
    case ValueKind::texts:
        return "list of texts";
    case ValueKind::numbers:
        return (key.value.slot ? "list of numbers, each " : "list of numbers ") + range;
    case ValueKind::ends:
        return "two numbers, each " + range;
    case ValueKind::pairs:
        return "list of pairs, second entry " + range;
    case ValueKind::text_or_list:
        return "text, or list of texts";
    case ValueKind::names:
        return "two names";
    case ValueKind::law:
    case ValueKind::discrete:
        return fmt::format("`{}`", key.example);
    }
    return {};
}

std::string usual_cell(const Key& key)
{
    if (!key.usual) return "";
    return fmt::format("{} ... {}{} ({})", shortest(key.usual->low), shortest(key.usual->high),
                       key.usual->or_zero && !(key.usual->low <= 0.0) ? ", or 0" : "", key.usual->source);
}

std::string header_of(const std::string& name, Presence presence)
{
    return name.empty() ? "Top level" : presence == Presence::list ? "`[[" + name + "]]`" : "`[" + name + "]`";
}

std::string fragility_markdown()
{
    std::string out;
    for (const KeyGroup& table : fragility_key_tables()) {
        out += fmt::format("\n## {}\n{}\n\n| key | allowed | default | meaning |\n| --- | --- | --- | --- |\n",
                           header_of(table.name, table.presence), table.meaning);
        for (const Key& key : table.keys)
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
    Json root{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", "damslip scene"},
              {"type", "object"},
              {"additionalProperties", false}};
    Json properties = Json::object();
    Json required = Json::array();
    for (const KeyGroup& group : keys::joined({key_groups(section), fragility_key_tables()})) {
        Json schema = group_schema(group);
        if (group.name.empty()) {
            for (auto& [name, value] : schema["properties"].items()) properties[name] = value;
            continue;
        }
        const std::size_t dot = group.name.find('.');
        if (dot != std::string::npos) {
            Json& outer = properties[group.name.substr(0, dot)];
            (group.inside ? outer["items"] : outer)["properties"][group.name.substr(dot + 1)] = schema;
            continue;
        }
        if (group.presence == Presence::always && (schema.contains("required") || schema.contains("allOf")))
            required.push_back(group.name);
        properties[group.name] = schema;
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
        out += fmt::format("\n## {}\n{}\n\n| key | allowed | usual | default | honoured by | meaning |\n| --- | --- | "
                           "--- | --- | --- | --- |\n",
                           header_of(group.name, group.presence), group.meaning);
        for (const Key& key : group.keys) {
            std::vector<std::string> others = key.spellings();
            others.erase(others.begin());
            out += fmt::format("| `{}`{} | {} | {} | {} | {} | {} |\n", key.canonical(),
                               others.empty() ? "" : fmt::format(" (or {})", fmt::join(others, ", ")),
                               escaped(allowed(key)), escaped(usual_cell(key)), escaped(key.default_text),
                               method_words(honoured_by(group.name, key.name)), escaped(key.meaning));
        }
    }
    return out + fragility_markdown() + sources_markdown();
}

} // namespace damslip
