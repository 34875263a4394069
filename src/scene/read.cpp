#include "scene/read.hpp"

#include "core/file.hpp"
#include "core/text.hpp"
#include "scene/check.hpp"
#include "scene/fragility_input.hpp"
#include "scene/keys.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace damslip {

namespace {

Findings::Place place_of(const toml::source_region& source)
{
    return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

std::string value_text(const toml::node& node)
{
    if (const auto* s = node.as_string()) return "\"" + s->get().substr(0, 80) + "\"";
    if (const auto* f = node.as_floating_point()) return shortest(f->get());
    if (const auto* i = node.as_integer()) return std::to_string(i->get());
    if (const auto* b = node.as_boolean()) return b->get() ? "true" : "false";
    if (node.is_array()) return "[...]";
    if (node.is_table()) return "{...}";
    return "a date or time";
}

std::string full_name(const std::string& group, const std::string& key)
{
    return group.empty() ? key : group + "." + key;
}

std::string allowed_text(const Key& key, const Range& range, const Units& units)
{
    std::string text = range.text() == "any number" ? "a number" : "a number " + range.text();
    if (!units.empty() && !units.front().suffix.empty()) text += " [" + units.front().suffix + "]";
    return text + ": " + key.meaning;
}

/// Reads the keys of one [table] into its struct.
class GroupReader {
public:
    GroupReader(const KeyGroup& group, std::string label, Findings& findings, std::set<std::string> subgroups)
        : group_(group), label_(std::move(label)), findings_(findings), subgroups_(std::move(subgroups))
    {
    }

    void read(const toml::table& table, void* object)
    {
        std::map<std::string, std::string> used; // key -> spelling
        for (auto&& [name, node] : table) {
            const std::string spelling(name.str());
            if (node.is_table() || node.is_array_of_tables())
                if (subgroups_.contains(spelling)) continue;
            const auto [key, unit] = find(spelling);
            const Findings::Place place = place_of(name.source());
            if (!key) {
                unknown(spelling, place);
                continue;
            }
            const std::string full = full_name(label_, key->name);
            if (const auto twice = used.find(key->name); twice != used.end()) {
                findings_.wrong_at(place,
                                   fmt::format("{} is given twice, as {} and {}.", full, twice->second, spelling),
                                   "one of them", "delete one");
                continue;
            }
            used[key->name] = spelling;
            findings_.saw(full, place);
            assign(*key, unit, spelling, node, object);
        }
        for (const Key& key : group_.keys)
            if (key.required && !used.contains(key.name)) missing(key);
    }

private:
    std::pair<const Key*, UnitSuffix> find(const std::string& spelling) const
    {
        for (const Key& key : group_.keys) {
            if (key.units.empty() && key.name == spelling) return {&key, {}};
            for (const UnitSuffix& unit : key.units)
                if (key.spelled(unit) == spelling) return {&key, unit};
        }
        return {nullptr, {}};
    }

    void unknown(const std::string& spelling, Findings::Place place)
    {
        const std::string full = full_name(label_, spelling);
        for (const Key& key : group_.keys) { // the name is right but its unit is missing or not accepted
            const bool bare = spelling == key.name;
            const bool other_unit =
                spelling.starts_with(key.name + "_") && !key.units.empty() && !key.units.front().suffix.empty();
            if (!bare && !other_unit) continue;
            findings_.wrong_at(
                place,
                fmt::format("{} {}.", full, bare ? "has no unit in its name" : "has an unknown unit in its name"),
                fmt::format("{}", fmt::join(key.spellings(), ", ")), "write  " + key.canonical() + " = " + key.example);
            return;
        }
        std::vector<std::string> names;
        for (const Key& key : group_.keys)
            for (const std::string& s : key.spellings()) names.push_back(s);
        const std::vector<std::string> canonical = [&] {
            std::vector<std::string> c;
            for (const Key& key : group_.keys) c.push_back(key.canonical());
            return c;
        }();
        const std::string_view near = nearest(spelling, names);
        findings_.wrong_at(
            place,
            fmt::format("unknown key {}.{}", full,
                        near.empty() ? "" : fmt::format(" Did you mean {}?", full_name(label_, std::string(near)))),
            fmt::format("keys of {}: {}", label_.empty() ? "the top level" : "[" + label_ + "]",
                        fmt::join(canonical, ", ")),
            near.empty() ? "correct or delete the line" : "write  " + std::string(near));
    }

    void missing(const Key& key)
    {
        findings_.wrong(label_.empty() ? key.name : label_,
                        fmt::format("{} is missing.", full_name(label_, key.canonical())),
                        key.units.empty() ? key.meaning : allowed_text(key, key.range, key.units),
                        fmt::format("add  {} = {}{}", key.canonical(), key.example,
                                    label_.empty() ? "" : "  to [" + group_.name + "]"));
    }

    void not_allowed(const Key& key, const std::string& spelling, const toml::node& node, const std::string& expected)
    {
        const double value = node.value<double>().value_or(0.0);
        const bool degrees = spelling == key.name && value > 1.0 && value < 89.9 &&
                             std::any_of(key.units.begin(), key.units.end(), [](const UnitSuffix& u) { return u.tangent; });
        findings_.wrong_at(place_of(node.source()),
                           fmt::format("{} = {} is not allowed.", full_name(label_, spelling), value_text(node)),
                           expected,
                           degrees ? fmt::format("degrees? write  {}_deg = {}", key.name, value_text(node))
                                   : fmt::format("for example  {} = {}", key.canonical(), key.example));
    }

    /// The number in `node` as SI if it is finite and in range (the range is in canonical units).
    std::optional<double> number(const Key& key, const UnitSuffix& unit, const Units& units, const Range& range,
                                 const std::string& spelling, const toml::node& node,
                                 const std::string& expected_extra = "")
    {
        const std::optional<double> written = node.is_number() ? node.value<double>() : std::nullopt;
        const bool angle_of_friction = unit.tangent;
        if (written && std::isfinite(*written) && (!angle_of_friction || (*written >= 0 && *written < 89.9))) {
            const double si = to_si(*written, unit);
            const double canonical =
                units.empty() || unit.suffix == units.front().suffix ? *written : si / units.front().factor;
            if (range.contains(canonical) && std::isfinite(si)) return si;
        }
        not_allowed(key, spelling, node,
                    (angle_of_friction ? "0 ... below 89.9 [deg]: " + key.meaning : allowed_text(key, range, units)) +
                        expected_extra);
        return std::nullopt;
    }

    /// Notes a number that is allowed but not what real dams have.
    void look_at(const Key& key, const UnitSuffix& unit, const std::string& spelling, const toml::node& node)
    {
        const double value = node.value<double>().value_or(0.0);
        const std::string subject = fmt::format("{} = {}", full_name(label_, spelling), value_text(node));
        if (auto note = unusual(key, {subject, value, unit})) findings_.note_at(place_of(node.source()), *note);
    }

    /// The same of pairs, whose usual range is that of the second entries: the first unusual one is noted.
    void look_at_pairs(Key key, const UnitSuffix& unit, const std::string& spelling, const toml::array& list)
    {
        key.units = key.second_units;
        for (const toml::node& item : list) {
            const toml::node& second = (*item.as_array())[1];
            const double value = second.value<double>().value_or(0.0);
            const std::string subject =
                fmt::format("{} with the second entry {}", full_name(label_, spelling), value_text(second));
            if (auto note = unusual(key, {subject, value, unit, false}))
                return findings_.note_at(place_of(second.source()), *note);
        }
    }

    /// The number of a key that has one, looked at.
    std::optional<double> number_of(const Key& key, const UnitSuffix& unit, const std::string& spelling,
                                    const toml::node& node, const std::string& expected_extra = "")
    {
        const auto v = number(key, unit, key.units, key.range, spelling, node, expected_extra);
        if (v) look_at(key, unit, spelling, node);
        return v;
    }

    std::optional<int> whole_number(const Key& key, const std::string& spelling, const toml::node& node)
    {
        const auto v = node.value_exact<int64_t>();
        if (v && *v >= -1000 && *v <= 1000) return static_cast<int>(*v);
        not_allowed(key, spelling, node, "a whole number: " + key.meaning);
        return std::nullopt;
    }

    void assign(const Key& key, const UnitSuffix& unit, const std::string& spelling, const toml::node& node,
                void* object)
    {
        const Slot slot = key.value.slot(object);
        if (auto* const* d = std::get_if<double*>(&slot)) {
            if (const auto v = number_of(key, unit, spelling, node)) **d = *v;
        } else if (auto* const* o = std::get_if<std::optional<double>*>(&slot)) {
            if (const auto v = number_of(key, unit, spelling, node)) **o = *v;
        } else if (const auto* either = std::get_if<NumberOrWord>(&slot)) {
            if (node.value<std::string>() == key.value.words.front())
                *either->word_given = true;
            else if (const auto v = number_of(key, unit, spelling, node, " or \"" + key.value.words.front() + "\""))
                *either->number = *v;
        } else if (auto* const* i = std::get_if<int*>(&slot)) {
            if (const auto v = whole_number(key, spelling, node)) **i = *v;
        } else if (auto* const* oi = std::get_if<std::optional<int>*>(&slot)) {
            if (const auto v = whole_number(key, spelling, node)) **oi = *v;
        } else if (auto* const* b = std::get_if<bool*>(&slot)) {
            if (const auto v = node.value_exact<bool>())
                **b = *v;
            else
                not_allowed(key, spelling, node, "true or false: " + key.meaning);
        } else if (const auto* c = std::get_if<Choice>(&slot)) {
            read_choice(key, *c, spelling, node);
        } else if (auto* const* points = std::get_if<std::vector<Point>*>(&slot)) {
            read_pairs(key, unit, spelling, node, **points);
        } else if (auto* const* list = std::get_if<std::vector<std::string>*>(&slot)) {
            read_texts(key, spelling, node, **list);
        } else if (const auto* numbers = std::get_if<Numbers>(&slot)) {
            if (numbers->one) {
                if (const auto v = number_of(key, unit, spelling, node)) *numbers->list = {*v};
            } else if (auto values = read_numbers(key, unit, spelling, node)) {
                *numbers->list = std::move(*values);
            }
        } else if (const auto* ends = std::get_if<Ends>(&slot)) {
            if (const auto v = read_numbers(key, unit, spelling, node, 2)) {
                *ends->from = v->front();
                *ends->to = v->back();
            }
        } else {
            read_text(key, slot, spelling, node);
        }
    }

    void read_choice(const Key& key, const Choice& choice, const std::string& spelling, const toml::node& node)
    {
        const std::vector<std::string>& words = key.value.words;
        const auto word = node.value_exact<std::string>();
        for (std::size_t i = 0; word && i < words.size(); ++i)
            if (words[i] == *word) return choice.set(static_cast<int>(i));
        const std::string_view near = word ? nearest(*word, words) : std::string_view{};
        findings_.wrong_at(
            place_of(node.source()),
            fmt::format("{} = {} is not allowed.", full_name(label_, spelling), value_text(node)),
            fmt::format("one of \"{}\": {}", fmt::join(words, "\", \""), key.meaning),
            fmt::format("write  {} = \"{}\"", key.name, near.empty() ? words.front() : std::string(near)));
    }

    /// Names and titles stand in tables and in notes of one line.
    static std::string in_one_line(std::string text)
    {
        std::replace_if(
            text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
        return text;
    }

    void read_text(const Key& key, const Slot& slot, const std::string& spelling, const toml::node& node)
    {
        const auto text = node.value_exact<std::string>();
        if (!text || text->empty() || text->size() > 4096 || text->find('\0') != std::string::npos)
            return not_allowed(key, spelling, node, "a text in quotes: " + key.meaning);
        if (auto* const* s = std::get_if<std::string*>(&slot))
            **s = in_one_line(*text);
        else if (auto* const* os = std::get_if<std::optional<std::string>*>(&slot))
            **os = in_one_line(*text);
        else if (auto* const* p = std::get_if<std::filesystem::path*>(&slot))
            **p = *text;
        else if (auto* const* op = std::get_if<std::optional<std::filesystem::path>*>(&slot))
            **op = *text;
    }

    void read_texts(const Key& key, const std::string& spelling, const toml::node& node, std::vector<std::string>& out)
    {
        const toml::array* list = node.as_array();
        if (!list || list->empty() || list->size() > 1000)
            return not_allowed(key, spelling, node, "a list of texts [\"a\", \"b\"]: " + key.meaning);
        std::vector<std::string> texts;
        for (const toml::node& item : *list) {
            const auto text = item.value_exact<std::string>();
            if (!text || text->empty() || text->size() > 4096 || text->find('\0') != std::string::npos)
                return not_allowed(key, spelling, item, "a text in quotes: " + key.meaning);
            texts.push_back(in_one_line(*text));
        }
        out = std::move(texts);
    }

    /// @param count  of numbers there must be; 0: any
    std::optional<std::vector<double>> read_numbers(const Key& key, const UnitSuffix& unit,
                                                    const std::string& spelling, const toml::node& node,
                                                    std::size_t count = 0)
    {
        const toml::array* list = node.as_array();
        if (!list || list->empty() || list->size() > 1000 || (count > 0 && list->size() != count)) {
            not_allowed(key, spelling, node,
                        fmt::format("a list of {}numbers [a, b{}]: {}", count == 2 ? "two " : "",
                                    count == 2 ? "" : ", ...", key.meaning));
            return std::nullopt;
        }
        std::vector<double> values;
        for (const toml::node& item : *list) {
            const auto v = number_of(key, unit, spelling, item);
            if (!v) return std::nullopt;
            values.push_back(*v);
        }
        return values;
    }

    void read_pairs(const Key& key, const UnitSuffix& unit, const std::string& spelling, const toml::node& node,
                    std::vector<Point>& out)
    {
        const toml::array* list = node.as_array();
        if (!list || list->empty() || list->size() > 10000)
            return not_allowed(key, spelling, node, "a list of pairs [[a, b], ...]: " + key.meaning);
        const bool same =
            &key.units == &key.second_units || key.second_units.front().suffix == key.units.front().suffix;
        std::vector<Point> points;
        for (const toml::node& item : *list) {
            const toml::array* pair = item.as_array();
            if (!pair || pair->size() != 2)
                return not_allowed(key, spelling, item, "a pair [a, b] of numbers: " + key.meaning);
            const auto x = number(key, unit, key.units, Range::any(), spelling, (*pair)[0]);
            const auto y =
                number(key, same ? unit : key.second_units.front(), key.second_units, key.range, spelling, (*pair)[1]);
            if (!x || !y) return;
            points.push_back({*x, *y});
        }
        out = std::move(points);
        look_at_pairs(key, same ? unit : key.second_units.front(), spelling, *list);
    }

    const KeyGroup& group_;
    std::string label_;
    Findings& findings_;
    std::set<std::string> subgroups_;
};

void wrong_shape_of(const KeyGroup& group, const std::string& label, const toml::node& node, const std::string& header,
                    Findings& findings)
{
    findings.wrong_at(place_of(node.source()), fmt::format("{} = {} is not allowed.", label, value_text(node)),
                      group.meaning, "write  " + header + "  and its keys below it");
}

/// A table in an entry of a list: [seam.wedge] of the [[seam]] above it. @param list_label  "seam[1]"
void read_inside(const KeyGroup& group, const std::string& list_label, const toml::table& entry_table, void* entry,
                 Findings& findings)
{
    const std::string name = group.name.substr(group.name.find('.') + 1), label = list_label + "." + name;
    const toml::node* node = entry_table.get(name);
    if (!node) return;
    const toml::table* table = node->as_table();
    if (!table) return wrong_shape_of(group, label, *node, "[" + group.name + "]", findings);
    findings.saw(label, place_of(table->source()));
    GroupReader(group, label, findings, {}).read(*table, group.inside(entry, true));
}

/// The nodes of a group: none, one table, or a list of tables.
void read_group(const KeyGroup& group, const std::vector<KeyGroup>& all, const toml::table& root, Scene& scene,
                Findings& findings)
{
    if (group.inside) return; // read with the entries of its list
    std::set<std::string> subgroups;
    for (const KeyGroup& other : all) {
        const std::string prefix = group.name.empty() ? "" : group.name + ".";
        if (other.name != group.name && other.name.starts_with(prefix))
            subgroups.insert(other.name.substr(prefix.size(), other.name.find('.', prefix.size()) - prefix.size()));
    }
    if (group.name.empty()) {
        toml::table own; // the plain keys of the top level; tables are reported by unknown_tables
        GroupReader reader(group, "", findings, subgroups);
        for (auto&& [name, node] : root)
            if (!node.is_table() && !node.is_array_of_tables() && !subgroups.contains(std::string(name.str())))
                own.insert(name, node);
        reader.read(own, group.open(scene));
        return;
    }
    const toml::node_view<const toml::node> view = root.at_path(group.name);
    const auto wrong_shape = [&](const toml::node& node, const std::string& header) {
        wrong_shape_of(group, group.name, node, header, findings);
    };
    if (group.presence == Presence::list) {
        if (!view) return;
        const toml::array* list = view.as_array();
        if (!list || (!list->empty() && !list->is_array_of_tables()))
            return wrong_shape(*view.node(), "[[" + group.name + "]]");
        if (list->size() > 1000) {
            findings.wrong_at(place_of(list->source()), fmt::format("{} has {} entries.", group.name, list->size()),
                              "at most 1000", "split the scene");
            return;
        }
        int index = 0;
        for (const toml::node& item : *list) {
            const std::string label = fmt::format("{}[{}]", group.name, ++index);
            findings.saw(label, place_of(item.source()));
            void* const entry = group.open(scene);
            GroupReader(group, label, findings, subgroups).read(*item.as_table(), entry);
            for (const KeyGroup& inner : all)
                if (inner.inside && list_of(inner) == group.name)
                    read_inside(inner, label, *item.as_table(), entry, findings);
        }
        return;
    }
    if (!view) {
        if (group.presence == Presence::always)
            GroupReader(group, group.name, findings, subgroups).read(toml::table{}, group.open(scene));
        return;
    }
    const toml::table* table = view.as_table();
    if (!table) return wrong_shape(*view.node(), "[" + group.name + "]");
    findings.saw(group.name, place_of(table->source()));
    GroupReader(group, group.name, findings, subgroups).read(*table, group.open(scene));
}

/// [expect]: quantity = { value = 1.27640, digits = 6, source = "..." }.
void read_expectations(const toml::table& root, Scene& scene, Findings& findings)
{
    const toml::node* node = root.get("expect");
    if (!node) return;
    const toml::table* table = node->as_table();
    const auto wrong = [&](const toml::node& where, const std::string& name) {
        findings.wrong_at(
            place_of(where.source()),
            fmt::format("expect{} = {} is not allowed.", name.empty() ? "" : "." + name, value_text(where)),
            "{ value = <number>, digits = <1 ... 15>, source = \"<where it comes from>\" }",
            "for example  yield_acceleration_m_s2 = { value = 1.2764, digits = 5, source = \"(4-3) by hand\" }");
    };
    if (!table) return wrong(*node, "");
    for (auto&& [name, item] : *table) {
        const toml::table* entry = item.as_table();
        if (!entry || entry->size() != 3) {
            wrong(item, std::string(name.str()));
            continue;
        }
        const auto number = (*entry)["value"].value<double>();
        const auto digits = (*entry)["digits"].value_exact<int64_t>();
        const auto source = (*entry)["source"].value_exact<std::string>();
        if (number && std::isfinite(*number) && digits && *digits >= 1 && *digits <= 15 && source && !source->empty())
            scene.expectations.push_back({std::string(name.str()), *number, static_cast<int>(*digits), *source});
        else
            wrong(item, std::string(name.str()));
    }
}

void unknown_tables(const std::vector<KeyGroup>& groups, const toml::table& root, Findings& findings)
{
    std::vector<std::string> names{"expect"};
    names.insert(names.end(), std::begin(fragility_tables), std::end(fragility_tables));
    for (const KeyGroup& g : groups)
        if (!g.name.empty() && g.name.find('.') == std::string::npos) names.push_back(g.name);
    for (auto&& [name, node] : root) {
        const std::string table(name.str());
        if ((!node.is_table() && !node.is_array_of_tables()) ||
            std::find(names.begin(), names.end(), table) != names.end())
            continue;
        const std::string_view near = nearest(table, names);
        findings.wrong_at(
            place_of(name.source()),
            fmt::format("unknown table [{}].{}", table, near.empty() ? "" : fmt::format(" Did you mean [{}]?", near)),
            fmt::format("tables: {}", fmt::join(names, ", ")),
            near.empty() ? "correct or delete it" : fmt::format("write  [{}]", near));
    }
}

/// The tables of a scene whose block is a [wedge]; others are refused by name.
void keep_wedge_tables(std::vector<KeyGroup>& groups, toml::table& root, Findings& findings)
{
    for (const KeyGroup& group : groups) {
        const std::string table = group.name.substr(0, group.name.find('.'));
        if (const toml::node* node = root.get(table); node && !belongs_to_wedge(table)) {
            findings.wrong_at(
                place_of(node->source()), fmt::format("[{}] has no place in a scene of a [wedge].", table),
                "[project], [site], [wedge], [[wedge.plane]], [[wedge.force]], [motion], [[motion.record]], [sliding], "
                "[regressions], [criteria]",
                fmt::format("delete [{}], or [wedge]", table));
            root.erase(table);
        }
    }
    std::erase_if(groups, [](const KeyGroup& group) { return !belongs_to_wedge(group.name); });
}

/// A document of the user's that judges: a part of a scene, read by the same keys.
Scene criteria_of(const std::filesystem::path& file, const std::vector<KeyGroup>& groups)
{
    toml::table root = toml_of(read_file(file, 1u << 20), file);
    Findings findings(file.string());
    Scene document;
    document.file = file;
    std::string words; // where it comes from
    for (const char* name : {"title", "edition", "source"})
        if (const auto value = root[name].value<std::string>()) words += (words.empty() ? "" : ", ") + *value;
    for (auto&& [name, node] : root) {
        const std::string_view key = name.str();
        if (key == "title" || key == "edition" || key == "source" || key == "criteria" || key == "combination") continue;
        findings.wrong_at(place_of(name.source()), fmt::format("{} has no place in a document of criteria.", key),
                          "title, edition, source, [criteria], [[combination]]", "delete it, or move it to the scene");
    }
    for (const KeyGroup& group : groups)
        if (group.name == "criteria" || group.name == "combination") read_group(group, groups, root, document, findings);
    if (document.combinations.empty())
        findings.wrong_at({1, 1}, "this document of criteria has no [[combination]].",
                          "[[combination]] with name, kind and required_sliding_factor", "add one");
    findings.throw_if_any();
    for (Combination& c : document.combinations)
        if (c.source.empty()) c.source = words;
    return document;
}

/// The first combination of a kind; null: the document has none.
const Combination* of_kind(const Scene& document, CombinationKind kind)
{
    const auto at = std::find_if(document.combinations.begin(), document.combinations.end(),
                                 [=](const Combination& c) { return c.kind == kind; });
    return at == document.combinations.end() ? nullptr : &*at;
}

/// What the scene leaves open is the document's: all load combinations, or by their kind what they require.
void use_criteria(const Scene& document, Scene& scene)
{
    if (scene.combinations.empty()) scene.combinations = document.combinations;
    for (Combination& c : scene.combinations) {
        const Combination* by = of_kind(document, c.kind);
        if (!by) continue;
        if (!c.required_sliding_factor) c.required_sliding_factor = by->required_sliding_factor;
        if (!c.required_residual_factor) c.required_residual_factor = by->required_residual_factor;
        if (!c.required_flotation_factor) c.required_flotation_factor = by->required_flotation_factor;
        if (!c.required_overturning_factor) c.required_overturning_factor = by->required_overturning_factor;
        if (!c.required_resultant) c.required_resultant = by->required_resultant;
        if (c.source.empty()) c.source = by->source;
    }
    Criteria& criteria = scene.criteria;
    if (!criteria.allowable_slip) criteria.allowable_slip = document.criteria.allowable_slip;
    if (criteria.report_order.empty()) criteria.report_order = document.criteria.report_order;
    criteria.document.clear(); // merged: the resolved scene stands for itself
}

void merge_criteria(const std::vector<KeyGroup>& groups, FileCheck check, Scene& scene, Findings& findings)
{
    const std::string name = scene.criteria.document;
    if (!name.ends_with(".toml")) return;
    const std::filesystem::path file = scene.file.parent_path() / name;
    if (check == FileCheck::skip && !std::filesystem::exists(file)) return;
    if (!std::filesystem::is_regular_file(file))
        return findings.wrong("criteria.document", fmt::format("criteria.document = \"{}\": there is no such file.", name),
                              "a path from the scene's folder, or \"cadam3d\"", "correct the path");
    use_criteria(criteria_of(file, groups), scene);
}

void resolve_paths(Scene& scene)
{
    const std::filesystem::path folder = scene.file.parent_path();
    for (RecordFiles& record : scene.motion.records) {
        if (record.name.empty()) record.name = record.horizontal.stem().string();
        if (!record.horizontal.empty()) record.horizontal = folder / record.horizontal;
        if (record.vertical) record.vertical = folder / *record.vertical;
    }
    number_names(scene.motion.records);
    if (scene.mesh.file) scene.mesh.file = folder / *scene.mesh.file;
}

/// Where a TOML text is as it is read, and how deep: brackets and dotted keys, whether its syntax is right or not.
class DepthScan {
public:
    explicit DepthScan(std::string_view text) : text_(text) {}

    /// @returns the first place that is deeper than `deepest`
    std::optional<Findings::Place> deeper_than(int deepest)
    {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '#')
                pass_until("\n");
            else if (c == '"' || c == '\'')
                pass_string(c);
            else
                count(c), pass(1);
            if (depth_ + dots_ > deepest) return place_;
        }
        return std::nullopt;
    }

private:
    void count(char c)
    {
        if (c == '.') ++dots_;
        if (c == '[' || c == '{') {
            open_.push_back(dots_ + 1);
            depth_ += open_.back();
        }
        if ((c == ']' || c == '}') && !open_.empty()) {
            depth_ -= open_.back();
            open_.pop_back();
        }
        if (std::string_view("[]{},\n").find(c) != std::string_view::npos) dots_ = 0; // another key or value begins
    }

    void pass(std::size_t bytes)
    {
        for (const char c : text_.substr(at_, bytes))
            place_ = c == '\n' ? Findings::Place{place_.line + 1, 1} : Findings::Place{place_.line, place_.column + 1};
        at_ += bytes;
    }
    void pass_until(std::string_view end) { pass(std::min(text_.find(end, at_), text_.size()) - at_); }

    void pass_string(char quote)
    {
        const std::string three(3, quote);
        const bool long_one = text_.substr(at_).starts_with(three);
        const std::string_view end = long_one ? std::string_view(three) : std::string_view(three).substr(0, 1);
        for (pass(end.size()); at_ < text_.size() && !text_.substr(at_).starts_with(end);) {
            if (text_[at_] == '\n' && !long_one) return; // torn
            pass(text_[at_] == '\\' && quote == '"' && at_ + 1 < text_.size() ? 2 : 1);
        }
        pass(std::min(end.size(), text_.size() - at_));
    }

    std::string_view text_;
    std::size_t at_ = 0;
    Findings::Place place_{1, 1};
    int depth_ = 0, dots_ = 0;
    std::vector<int> open_; ///< levels of each open bracket, with those of the key before it
};

/// Tables are copied and destroyed by recursion: what is nested too deep would overflow the stack.
void check_depth(std::string_view text, const std::filesystem::path& file)
{
    constexpr int deepest = 64;
    const std::optional<Findings::Place> place = DepthScan(text).deeper_than(deepest);
    if (!place) return;
    throw InputError(Diagnostic{file.string(), place->line, place->column,
                                fmt::format("this is nested deeper than {} levels.", deepest),
                                "tables and lists of a scene, three levels at most", "correct this line"});
}

} // namespace

toml::table toml_of(std::string_view text, const std::filesystem::path& file)
{
    check_depth(text, file);
    try {
        return toml::parse(text, file.string());
    } catch (const toml::parse_error& error) {
        Findings findings(file.string());
        findings.wrong_at(place_of(error.source()), std::string(error.description()),
                          "TOML: key = value, texts in quotes, decimal point, [table] headers", "correct this line");
        findings.throw_if_any();
        throw;
    }
}

Scene parse_scene(std::string_view toml_text, const std::filesystem::path& file, FileCheck check)
{
    toml::table root = toml_of(toml_text, file);
    const bool fragility = std::any_of(std::begin(fragility_tables), std::end(fragility_tables),
                                       [&root](const char* table) { return root.contains(table); });
    if (!fragility) return scene_of_table(std::move(root), file, check);

    std::vector<Diagnostic> wrong = wrong_in_fragility_tables(toml_text, file);
    try {
        Scene scene = scene_of_table(std::move(root), file, check);
        if (wrong.empty()) return scene;
    } catch (const InputError& error) {
        wrong.insert(wrong.begin(), error.diagnostics().begin(), error.diagnostics().end());
    }
    throw InputError(std::move(wrong));
}

Scene scene_of_table(toml::table root, const std::filesystem::path& file, FileCheck check)
{
    Findings findings(file.string());
    Scene scene;
    scene.file = file;
    thread_local SectionInput section; // what the keys of the section write to; the table of keys is made once
    thread_local const std::vector<KeyGroup> all_groups = key_groups(section);
    section = {};
    const bool wedge = root.contains("wedge");
    std::vector<KeyGroup> of_wedge;
    if (wedge) {
        of_wedge = all_groups;
        keep_wedge_tables(of_wedge, root, findings);
    }
    const std::vector<KeyGroup>& groups = wedge ? of_wedge : all_groups;
    unknown_tables(groups, root, findings);
    for (const char* table : fragility_tables) root.erase(table); // they are no part of a Scene
    for (const KeyGroup& group : groups) read_group(group, groups, root, scene, findings);
    read_expectations(root, scene, findings);
    merge_criteria(groups, check, scene, findings);

    if (!wedge) scene.section = make_section(section, findings);
    if (scene.title.empty()) scene.title = file.stem().string();
    if (!findings.any()) { // a second look at values only when each is right by itself
        resolve_paths(scene);
        apply_preset(scene, [&findings](const char* key) { return !findings.given(key); }); // what the file says wins
        fill_defaults(scene, findings);
        check_consistency(scene, findings, check);
        note_unusual(scene, findings);
        std::sort(scene.lift_joints.begin(), scene.lift_joints.end(),
                  [](const LiftJoint& a, const LiftJoint& b) { return a.elevation < b.elevation; });
    }
    findings.throw_if_any();
    scene.notes = findings.notes();
    return scene;
}

void number_names(std::vector<RecordFiles>& records)
{
    std::set<std::string> taken;
    for (RecordFiles& record : records) {
        const std::string name = record.name;
        for (int k = 2; !taken.insert(record.name).second; ++k) record.name = fmt::format("{} ({})", name, k);
    }
}

Scene read_scene(const std::filesystem::path& file)
{
    return parse_scene(read_file(file, 4u << 20), file);
}

// Where a key stands in its file, for messages.

namespace key_places {

namespace {

/// A key or table as a message names it: "contact.sliding", "seam[2].exit", "[lifts]", "[[seam]]".
struct Named {
    std::vector<std::string> parts; ///< "seam", "exit"
    std::size_t entry = 0;          ///< of the list that the first part is, from 0
    bool numbered = false;          ///< "seam[2]": the entry is in the message
};

bool of_a_key(char c)
{
    return std::islower(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)) || c == '_';
}

/// The one that begins at `at`; none: another word.
std::optional<Named> named_at(std::string_view text, std::size_t at)
{
    Named named;
    const bool table = text[at] == '[';
    while (at < text.size() && text[at] == '[') ++at;
    for (;;) {
        const std::size_t begin = at;
        while (at < text.size() && of_a_key(text[at])) ++at;
        if (at == begin) break;
        named.parts.emplace_back(text.substr(begin, at - begin));
        if (!table && named.parts.size() == 1 && at < text.size() && text[at] == '[') {
            std::size_t number = 0;
            const auto end = std::from_chars(text.data() + at + 1, text.data() + text.size(), number);
            if (end.ec != std::errc{} || number == 0 || end.ptr == text.data() + text.size() || *end.ptr != ']') return std::nullopt;
            named.entry = number - 1;
            named.numbered = true;
            at = static_cast<std::size_t>(end.ptr - text.data()) + 1;
        }
        if (at + 1 >= text.size() || text[at] != '.' || !of_a_key(text[at + 1])) break;
        ++at;
    }
    const bool closed = table && at < text.size() && text[at] == ']';
    const bool key = !table && (named.parts.size() > 1 || named.numbered); // one word alone may be any word
    return !named.parts.empty() && (closed || key) ? std::optional(named) : std::nullopt;
}

/// The node of a key in a table, with or without its unit: "level" finds "level_m".
const toml::node* entry_of(const toml::table& table, const std::string& key)
{
    if (const toml::node* node = table.get(key)) return node;
    for (const auto& [name, node] : table)
        if (name.str().starts_with(key + "_")) return &node;
    return nullptr;
}

const toml::node* find(const toml::table& scene, const Named& named)
{
    const toml::node* node = &scene;
    for (const std::string& part : named.parts) {
        const toml::table* table = node->as_table();
        if (const toml::array* list = node->as_array())
            table = list->size() > named.entry ? list->get(named.entry)->as_table() : nullptr;
        node = table ? entry_of(*table, part) : nullptr;
        if (!node) return nullptr;
    }
    const toml::array* const list = node->as_array();
    return list && list->is_array_of_tables() ? list->get(named.entry) : node;
}

} // namespace

} // namespace key_places

Diagnostic with_line(Diagnostic d)
{
    if (d.line > 0 || !d.file.ends_with(".toml")) return d;
    try {
        const toml::table scene = toml::parse(read_file(d.file));
        for (const std::string* text : {&d.problem, &d.expected, &d.fix})
            for (std::size_t at = 0; at < text->size(); ++at) {
                if (at > 0 && (key_places::of_a_key((*text)[at - 1]) || (*text)[at - 1] == '.' || (*text)[at - 1] == '[')) continue;
                if (!key_places::of_a_key((*text)[at]) && (*text)[at] != '[') continue;
                const std::optional<key_places::Named> named = key_places::named_at(*text, at);
                const toml::node* const node = named ? key_places::find(scene, *named) : nullptr;
                if (!node) continue;
                d.line = static_cast<int>(node->source().begin.line);
                return d;
            }
    } catch (const std::exception&) { // the file is gone, or was never one
    }
    return d;
}

} // namespace damslip
