#include "scene/scene_text.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/number.hpp"
#include "scene/key_table.hpp"
#include "scene/read_table.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
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
bool settable(const Slot& slot)
{
    return std::holds_alternative<double*>(slot) || std::holds_alternative<std::optional<double>*>(slot) ||
           std::holds_alternative<int*>(slot) || std::holds_alternative<std::optional<int>*>(slot) ||
           std::holds_alternative<bool*>(slot) || std::holds_alternative<Choice>(slot) ||
           std::holds_alternative<NumberOrWord>(slot);
}

bool whole(const Slot& slot)
{
    return std::holds_alternative<int*>(slot) || std::holds_alternative<std::optional<int>*>(slot);
}

Slot slot_of(const KeyGroup& group, const Key& key)
{
    static thread_local Scene probe;
    probe = Scene();
    return key.slot(group.open(probe));
}

/// "lift_joint[crown].friction" -> group "lift_joint", entry "crown", key "friction".
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
    if (listed) path.entry = text.substr(open + 1, close - open - 1);
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
        if (group.name != path.group || (group.presence == Presence::list) == path.entry.empty()) continue;
        for (const Key& key : group.keys) {
            const std::vector<std::string> names = key.spellings();
            if (std::find(names.begin(), names.end(), path.key) != names.end() && settable(slot_of(group, key)))
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
    throw InputError(Diagnostic{
        file.string(), 0, 0,
        fmt::format("unknown key {}.{}", key, near.empty() ? "" : fmt::format(" Did you mean {}?", near)),
        "a number or a choice of the scene with its unit, such as contact.friction or reservoir.level_m; an entry of a "
        "list by its name: lift_joint[NAME].friction",
        near.empty() ? "damslip worker SCENE lists the keys in its first line" : fmt::format("write  {}", near)});
}

/// The table that holds the key, made where the file has none.
toml::table* table_of(toml::table& root, const Target& target)
{
    const std::string& name = target.group->name;
    if (target.group->presence == Presence::list) {
        toml::array* list = root.at_path(name).as_array();
        for (std::size_t i = 0; list && i < list->size(); ++i) {
            toml::table* entry = (*list)[i].as_table();
            if (entry && (entry_name(*entry, i) == target.entry || std::to_string(i + 1) == target.entry)) return entry;
        }
        return nullptr;
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
            throw InputError(Diagnostic{file.string(), 0, 0, fmt::format("{} is set twice.", change.key),
                                        "one value and one unit for each key", "leave one out"});
        for (const std::string& spelling : target->key->spellings()) table->erase(spelling);
        put(*table, path_of(change.key).key, change.value, whole(slot_of(*target->group, *target->key)));
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
        throw InputError(Diagnostic{tables_->file.string(), 0, 0, fmt::format("{} is not in the file.", key),
                                    "a number for a factor to multiply, in the same spelling",
                                    fmt::format("write  {} = ...", key)});
    return *value;
}

std::vector<std::string> SceneText::keys() const
{
    std::vector<std::string> names;
    const auto add = [&names](const KeyGroup& group, const std::string& label) {
        for (const Key& key : group.keys)
            if (settable(slot_of(group, key)))
                names.push_back(label.empty() ? key.canonical() : label + "." + key.canonical());
    };
    const bool wedge = tables_->root.contains("wedge");
    for (const KeyGroup& group : tables_->groups) {
        if (wedge && !belongs_to_wedge(group.name)) continue;
        if (group.presence == Presence::list) {
            const toml::array* list = tables_->root.at_path(group.name).as_array();
            for (std::size_t i = 0; list && i < list->size(); ++i)
                if (const toml::table* entry = (*list)[i].as_table())
                    add(group, fmt::format("{}[{}]", group.name, entry_name(*entry, i)));
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
    const Slot slot = slot_of(*target->group, *target->key);
    const auto* choice = std::get_if<Choice>(&slot);
    return choice ? choice->words : std::vector<std::string>{};
}

std::string SceneText::canonical(const std::string& key) const
{
    const std::optional<Target> target = find(tables_->groups, key);
    if (!target) refuse_key(tables_->file, key, keys());
    std::string label = target->group->name;
    if (!target->entry.empty()) {
        toml::table root = tables_->root;
        const toml::table* entry = table_of(root, *target);
        if (!entry) refuse_key(tables_->file, key, keys());
        const toml::array* list = root.at_path(target->group->name).as_array();
        for (std::size_t i = 0; i < list->size(); ++i)
            if ((*list)[i].as_table() == entry) label += "[" + entry_name(*entry, i) + "]";
    }
    return label.empty() ? target->key->canonical() : label + "." + target->key->canonical();
}

} // namespace damslip
