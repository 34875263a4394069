#include "scene/write.hpp"

#include "core/file.hpp"
#include "core/text.hpp"
#include "scene/keys.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
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

/// `si` in this unit: the number that reads back as the same double, or the nearest one.
double in_unit(double si, const UnitSuffix& unit)
{
    const double near = si / unit.factor;
    for (const double candidate : {near, std::nextafter(near, -HUGE_VAL), std::nextafter(near, HUGE_VAL)})
        if (to_si(candidate, unit) == si) return candidate;
    return near;
}

bool reads_back(double si, const UnitSuffix& unit)
{
    return !unit.tangent && to_si(in_unit(si, unit), unit) == si;
}

/// The first unit in which every one of the numbers reads back as the same double; else the one to fall back on.
const UnitSuffix& exact_unit(const std::vector<double>& si, const Units& units, const UnitSuffix& otherwise)
{
    const auto exact = [&](const UnitSuffix& unit) {
        return std::ranges::all_of(si, [&](double x) { return reads_back(x, unit); });
    };
    const auto found = std::ranges::find_if(units, exact);
    return found == units.end() ? otherwise : *found;
}

std::string number_line(const Key& key, double si)
{
    const UnitSuffix& unit = exact_unit({si}, key.units, key.units.front());
    return key.spelled(unit) + " = " + toml_number(in_unit(si, unit)) + "\n";
}

std::string pairs_line(const Key& key, const std::vector<Point>& points)
{
    std::vector<double> firsts;
    for (const Point& p : points) firsts.push_back(p.x);
    const UnitSuffix& unit = exact_unit(firsts, key.units, key.units.back()); // one has to serve all first entries
    const UnitSuffix& second =
        key.second_units.front().suffix == key.units.front().suffix ? unit : key.second_units.front();
    std::string list;
    for (const Point& p : points)
        list += (list.empty() ? "[" : ", [") + toml_number(in_unit(p.x, unit)) + ", " +
                toml_number(in_unit(p.y, second)) + "]";
    return key.spelled(unit) + " = [" + list + "]\n";
}

std::string numbers_line(const Key& key, const std::vector<double>& values)
{
    const UnitSuffix& unit = exact_unit(values, key.units, key.units.back());
    std::string list;
    for (const double si : values) list += (list.empty() ? "" : ", ") + toml_number(in_unit(si, unit));
    return key.spelled(unit) + " = [" + list + "]\n";
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
        std::string operator()(const Numbers& v) const
        {
            if (v.list->empty()) return "";
            return v.one ? number_line(key, v.list->front()) : numbers_line(key, *v.list);
        }
        std::string operator()(const Ends& v) const { return numbers_line(key, {*v.from, *v.to}); }
        std::string operator()(const Choice& c) const
        {
            const int i = c.get();
            return i < 0 ? "" : key.name + " = " + toml_text(key.value.words[static_cast<std::size_t>(i)]) + "\n";
        }
        std::string operator()(const NumberOrWord& v) const
        {
            if (*v.word_given) return key.canonical() + " = " + toml_text(key.value.words.front()) + "\n";
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
            if (!key.applies || key.applies(item)) lines += line(key, key.value.slot(const_cast<void*>(item)), paths);
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
                std::string written = line(key, key.value.slot(const_cast<void*>(items[i])), RecordPaths::file_names);
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
