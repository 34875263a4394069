#include "random/mutated_scene.hpp"

#include "core/file.hpp"
#include "random/random_motion.hpp"
#include "scene/keys.hpp"
#include "source_dir.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace damslip::random {

namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text)
{
    Lines lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

bool is_table(const std::string& line)
{
    return line.starts_with('[');
}

/// "key = value" of a table whose values may change.
bool is_entry(const std::string& line)
{
    return line.find(" = ") != std::string::npos && !line.starts_with('#') && !line.starts_with("title");
}

/// Leaves out the tables for which `drop` holds.
template <class Drop>
Lines without_tables(const Lines& lines, Drop&& drop)
{
    Lines kept;
    bool dropped = false;
    for (const std::string& line : lines) {
        if (is_table(line)) dropped = drop(line);
        if (!dropped) kept.push_back(line);
    }
    return kept;
}

std::size_t some(Draw& draw, std::size_t count)
{
    return static_cast<std::size_t>(draw.whole(0, static_cast<int>(count) - 1));
}

std::vector<std::size_t> entries(const Lines& lines)
{
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (is_entry(lines[i])) places.push_back(i);
    return places;
}

std::string value_of(const std::string& line)
{
    return line.substr(line.find(" = ") + 3);
}

void set_value(std::string& line, const std::string& value)
{
    line = line.substr(0, line.find(" = ") + 3) + value;
}

void scale_a_number(Lines& lines, Draw& draw)
{
    const std::vector<std::size_t> places = entries(lines);
    if (places.empty()) return;
    std::string& line = lines[places[some(draw, places.size())]];
    char* end = nullptr;
    const std::string text = value_of(line);
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str()) return;
    const double factor = draw.chance(0.6) ? draw.log_between(0.5, 2.0) : draw.log_between(1e-3, 1e3);
    set_value(line, fmt::format("{:.6g}", value * factor) + end);
}

void exchange_two_values(Lines& lines, Draw& draw)
{
    const std::vector<std::size_t> places = entries(lines);
    if (places.size() < 2) return;
    std::string &a = lines[places[some(draw, places.size())]], &b = lines[places[some(draw, places.size())]];
    const std::string kept = value_of(a);
    set_value(a, value_of(b));
    set_value(b, kept);
}

void lose_a_line(Lines& lines, Draw& draw)
{
    const std::vector<std::size_t> places = entries(lines);
    if (!places.empty()) lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(places[some(draw, places.size())]));
}

void lose_a_table(Lines& lines, Draw& draw)
{
    Lines tables;
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(tables), is_table);
    if (tables.empty()) return;
    const std::string lost = tables[some(draw, tables.size())];
    lines = without_tables(lines, [&](const std::string& table) { return table == lost; });
}

/// Puts the line into its table, which is made where it is missing; the key's own line, if there is one, goes.
void put(Lines& lines, const std::string& table, const std::string& line)
{
    const std::string key = line.substr(0, line.find(" = ") + 3);
    auto at = std::find(lines.begin(), lines.end(), table);
    if (at == lines.end()) {
        lines.push_back(table);
        at = std::prev(lines.end());
    }
    auto end = std::find_if(std::next(at), lines.end(), is_table);
    const auto place = at - lines.begin();
    const auto old = std::find_if(std::next(at), end, [&](const std::string& l) { return l.starts_with(key); });
    if (old != end) lines.erase(old);
    lines.insert(lines.begin() + place + 1, line);
}

void add_what_makes_it_hard(Lines& lines, Draw& draw)
{
    const auto number = [&](double low, double high) { return fmt::format("{:.4g}", draw.log_between(low, high)); };
    switch (draw.whole(0, 9)) {
    case 0:
        return put(lines, "[contact]", "cohesion_kPa = " + number(1, 3000));
    case 1:
        return put(lines, "[contact]", "friction = " + number(0.2, 3));
    case 2:
        return put(lines, "[contact]", "residual_friction = " + number(0.1, 1));
    case 3:
        return put(lines, "[time]", "slip_tolerance = " + number(1e-5, 0.5));
    case 4:
        return put(lines, "[time]", fmt::format("substeps = {}", draw.whole(0, 2)));
    case 5:
        return put(lines, "[time]", "alpha = -" + number(1e-3, 0.3));
    case 6:
        return put(lines, "[damping]", "ratio = " + number(1e-4, 0.3));
    case 7:
        return put(lines, "[reservoir]", "model = \"added-mass\"");
    case 8:
        return put(lines, "[contact]", "separation = \"none\"");
    default:
        return put(lines, "[foundation]", "young_modulus_GPa = " + number(1, 200));
    }
}

/// A value such as the documents show, or at the ends of what is usual or allowed; or another word of its list.
std::string some_value(const KeyGroup& group, const Key& key, Draw& draw)
{
    if (!group.inside) {
        if (const auto& words = key.value.words; key.value.kind == ValueKind::word)
            return '"' + words[some(draw, words.size())] + '"';
        if (key.value.kind == ValueKind::flag) return draw.word({"true", "false"});
    }
    std::vector<double> ends;
    for (const double end : {key.range.low, key.range.high})
        if (std::isfinite(end)) ends.push_back(end);
    if (key.usual) ends.insert(ends.end(), {key.usual->low, key.usual->high});
    return ends.empty() || draw.chance(0.5) ? key.example : fmt::format("{}", ends[some(draw, ends.size())]);
}

/// A key of the table of keys, one time in five of a table that the scene has not.
void set_a_key(Lines& lines, Draw& draw)
{
    SectionInput section;
    const std::vector<KeyGroup> groups = key_groups(section);
    const KeyGroup& group = groups[some(draw, groups.size())];
    const std::string table = group.in_list() ? "[[" + group.name + "]]" : "[" + group.name + "]";
    const bool there = std::find(lines.begin(), lines.end(), table) != lines.end();
    if (group.name.empty() || group.name == "mesh" || (!there && draw.chance(0.8))) return;
    const Key& key = group.keys[some(draw, group.keys.size())];
    put(lines, table, key.spellings()[some(draw, key.spellings().size())] + " = " + some_value(group, key, draw));
}

std::string example(Draw& draw)
{
    const std::string name = draw.word({"reference_dam",
                                        "reference_dam_profile",
                                        "reference_dam_ruptured",
                                        "reference_dam_printed_uplift",
                                        "reference_dam_goldgruber",
                                        "triangular_dam",
                                        "cracked_upper_block",
                                        "koyna",
                                        "pine_flat",
                                        "anchored_dam",
                                        "bonded_dam",
                                        "flexible_block",
                                        "inclined_block",
                                        "lifts_dam",
                                        "opening_water",
                                        "reference_dam_rock_mass",
                                        "rock_slope",
                                        "rock_wedge",
                                        "seam_dam",
                                        "sequence"});
    return read_file(std::filesystem::path(source_dir()) / "examples" / (name + ".toml"));
}

} // namespace

SceneFiles mutated_scene(Draw& draw)
{
    Lines lines = without_tables(lines_of(example(draw)), [](const std::string& table) {
        return table == "[expect]" || table == "[[motion.record]]" || table == "[mesh]";
    });
    const double contact_size = draw.between(3, 8), size = draw.between(8, 20);
    const bool wedge = std::find(lines.begin(), lines.end(), "[wedge]") != lines.end();
    put(lines, "[sliding]", "run_out_max_s = 2");
    if (!wedge) put(lines, "[dam]", "young_modulus_GPa = 25"); // not all examples need one
    for (int k = draw.whole(0, 3); k > 0; --k) add_what_makes_it_hard(lines, draw);
    for (int k = draw.whole(0, 3); k > 0; --k) set_a_key(lines, draw);
    for (int k = draw.whole(0, 3); k > 0; --k) {
        const double kind = draw.unit();
        if (kind < 0.6)
            scale_a_number(lines, draw);
        else if (kind < 0.75)
            exchange_two_values(lines, draw);
        else if (kind < 0.9)
            lose_a_line(lines, draw);
        else
            lose_a_table(lines, draw);
    }
    if (!wedge) {
        put(lines, "[mesh]",
            fmt::format("contact_size_m = {:.4g}", contact_size)); // never so fine that it takes minutes
        put(lines, "[mesh]", fmt::format("size_m = {:.4g}", size));
    }
    SceneFiles files;
    random_motion(draw, files);
    std::vector<std::string> records{"drawn"};
    for (std::string& line : lines) {
        if (line.starts_with("sequence = ")) {
            line = "sequence = [\"drawn\", \"again\"]";
            records = {"drawn", "again"};
        }
        files.scene += line + "\n";
    }
    for (const std::string& record : records) {
        files.scene += fmt::format("[[motion.record]]\nname = \"{}\"\nhorizontal = \"horizontal.csv\"\n", record);
        if (!files.vertical.empty()) files.scene += "vertical = \"vertical.csv\"\n";
    }
    files.spoilt = true;
    return files;
}

} // namespace damslip::random
