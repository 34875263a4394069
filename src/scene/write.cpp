#include "scene/write.hpp"

#include "core/file.hpp"
#include "core/text.hpp"
#include "scene/key_table.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/plausible.hpp"

#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

std::string toml_text(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += '\\', out += c;
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
        else
            out += c;
    }
    return out + "\"";
}

/// TOML floats need a point or an exponent to stay floats for strict readers.
std::string toml_number(double x)
{
    const std::string text = shortest(x);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

struct Written {
    std::string suffix;
    double value;
};

/// `si` in the first unit in which the written number reads back as the same double.
Written in_unit(double si, const Units& units)
{
    for (const UnitSuffix& unit : units) {
        if (unit.tangent) continue;
        const double near = si / unit.factor;
        for (const double candidate : {near, std::nextafter(near, -HUGE_VAL), std::nextafter(near, HUGE_VAL)})
            if (to_si(candidate, unit) == si) return {unit.suffix, candidate};
    }
    return {units.front().suffix, si / units.front().factor};
}

std::string spelled(const Key& key, const std::string& suffix)
{
    return suffix.empty() ? key.name : key.name + "_" + suffix;
}

std::string number_line(const Key& key, double si)
{
    const Written w = in_unit(si, key.units);
    return spelled(key, w.suffix) + " = " + toml_number(w.value) + "\n";
}

std::string pairs_line(const Key& key, const std::vector<Point>& points)
{
    // One suffix has to serve all first entries: the first unit that is exact for every one of them.
    const bool same = key.second_units.front().suffix == key.units.front().suffix;
    for (const UnitSuffix& unit : key.units) {
        bool exact = true;
        std::string list;
        for (const Point& p : points) {
            const Written x = in_unit(p.x, {unit});
            const Written y = in_unit(p.y, same ? Units{unit} : key.second_units);
            exact = exact && to_si(x.value, unit) == p.x;
            list += (list.empty() ? "[" : ", [") + toml_number(x.value) + ", " + toml_number(y.value) + "]";
        }
        if (exact || &unit == &key.units.back()) return spelled(key, unit.suffix) + " = [" + list + "]\n";
    }
    return "";
}

/// @param one  the first as a number, not as a list
std::string numbers_line(const Key& key, const std::vector<double>& values, bool one = false)
{
    if (one) return number_line(key, values.front());
    std::string list;
    for (const UnitSuffix& unit : key.units) { // the first unit that is exact for every one of them
        bool exact = true;
        list.clear();
        for (const double si : values) {
            const Written w = in_unit(si, {unit});
            exact = exact && to_si(w.value, unit) == si;
            list += (list.empty() ? "" : ", ") + toml_number(w.value);
        }
        if (exact || &unit == &key.units.back()) return spelled(key, unit.suffix) + " = [" + list + "]\n";
    }
    return "";
}

std::string path_text(const std::filesystem::path& path, RecordPaths style)
{
    return style == RecordPaths::file_names ? path.filename().string()
                                            : std::filesystem::absolute(path).lexically_normal().string();
}

std::string line(const Key& key, const Slot& slot, RecordPaths paths)
{
    struct Write {
        const Key& key;
        RecordPaths paths;
        std::string operator()(double* v) const { return number_line(key, *v); }
        std::string operator()(std::optional<double>* v) const { return *v ? number_line(key, **v) : ""; }
        std::string operator()(int* v) const { return key.name + " = " + std::to_string(*v) + "\n"; }
        std::string operator()(std::optional<int>* v) const
        {
            return *v ? key.name + " = " + std::to_string(**v) + "\n" : "";
        }
        std::string operator()(bool* v) const { return key.name + (*v ? " = true\n" : " = false\n"); }
        std::string operator()(std::string* v) const
        {
            return v->empty() ? "" : key.name + " = " + toml_text(*v) + "\n";
        }
        std::string operator()(std::optional<std::string>* v) const
        {
            return *v ? key.name + " = " + toml_text(**v) + "\n" : "";
        }
        std::string operator()(std::filesystem::path* v) const
        {
            return v->empty() ? "" : key.name + " = " + toml_text(path_text(*v, paths)) + "\n";
        }
        std::string operator()(std::optional<std::filesystem::path>* v) const
        {
            return *v ? key.name + " = " + toml_text(path_text(**v, paths)) + "\n" : "";
        }
        std::string operator()(std::vector<Point>* v) const { return v->empty() ? "" : pairs_line(key, *v); }
        std::string operator()(std::vector<std::string>* v) const
        {
            std::string list;
            for (const std::string& word : *v) list += (list.empty() ? "" : ", ") + toml_text(word);
            return v->empty() ? "" : key.name + " = [" + list + "]\n";
        }
        std::string operator()(const Numbers& v) const { return v.list->empty() ? "" : numbers_line(key, *v.list, v.one); }
        std::string operator()(const Ends& v) const { return numbers_line(key, {*v.from, *v.to}); }
        std::string operator()(const Choice& c) const
        {
            const int i = c.get();
            return i < 0 ? "" : key.name + " = " + toml_text(c.words[static_cast<std::size_t>(i)]) + "\n";
        }
        std::string operator()(const NumberOrWord& v) const
        {
            if (*v.word_given) return key.canonical() + " = " + toml_text(v.word) + "\n";
            return *v.number ? number_line(key, **v.number) : "";
        }
    };
    return std::visit(Write{key, paths}, slot);
}

} // namespace

std::string resolved_toml(const Scene& given, RecordPaths paths)
{
    const Scene scene = with_own_choices(given);
    SectionInput section;
    std::string out;
    const std::vector<KeyGroup> groups = key_groups(section);
    const auto write = [&](const KeyGroup& group, const void* item) {
        std::string lines;
        for (const Key& key : group.keys)
            if (!key.applies || key.applies(item)) lines += line(key, key.slot(const_cast<void*>(item)), paths);
        if (lines.empty() && group.presence == Presence::always) return;
        if (!group.name.empty())
            out += group.presence == Presence::list ? "\n[[" + group.name + "]]\n" : "\n[" + group.name + "]\n";
        out += lines;
    };
    for (const KeyGroup& group : groups) {
        if (group.inside || (scene.wedge && !belongs_to_wedge(group.name))) continue;
        for (const void* item : group.items(scene)) {
            write(group, item);
            for (const KeyGroup& inner : groups)
                if (inner.inside && list_of(inner) == group.name)
                    if (const void* there = inner.inside(const_cast<void*>(item), false)) write(inner, there);
        }
    }
    if (!scene.expectations.empty()) out += "\n[expect]\n";
    for (const Expectation& e : scene.expectations)
        out += fmt::format("{} = {{ value = {}, digits = {}, source = {} }}\n", toml_text(e.quantity),
                           toml_number(e.value), e.digits, toml_text(e.source));
    return out;
}

std::vector<UsualValue> usual_values(const Scene& given)
{
    const Scene scene = with_own_choices(given);
    SectionInput section;
    std::vector<UsualValue> values;
    for (const KeyGroup& group : key_groups(section)) {
        if (group.name == "section" || group.name == "mesh" || group.name == "time" || group.name == "sliding" ||
            (scene.wedge && !belongs_to_wedge(group.name)))
            continue;
        const std::vector<const void*> items = group.items(scene);
        for (std::size_t i = 0; i < items.size(); ++i)
            for (const Key& key : group.keys) {
                const bool numerical = key.usual && key.usual->source == "judgement" && group.name != "criteria";
                if (!key.usual || numerical || (key.applies && !key.applies(items[i]))) continue;
                std::string written = line(key, key.slot(const_cast<void*>(items[i])), RecordPaths::file_names);
                if (written.empty()) continue;
                written.pop_back(); // the end of the line
                const std::size_t at = written.find(" = ");
                const std::string number = items.size() > 1 ? fmt::format(" ({})", i + 1) : "";
                const std::string text = written.substr(at + 3);
                const std::optional<double> value = parse_whole_number_text(text);
                values.push_back({group.name + "." + written.substr(0, at) + number, value ? six_digits(*value) : text, *key.usual,
                                  key.units.front()});
            }
    }
    return values;
}

std::string scene_hash(const Scene& scene)
{
    Scene computed = scene;
    computed.project = {};  // a new revision of the report is still a report of the same numbers
    computed.title.clear(); // by default the file's name
    return sha256(resolved_toml(computed, RecordPaths::file_names));
}

} // namespace damslip
