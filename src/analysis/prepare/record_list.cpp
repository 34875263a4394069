#include "analysis/prepare/record_list.hpp"

#include "core/csv.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/number.hpp"
#include "core/text.hpp"
#include "records/generate/seed_list.hpp"
#include "scene/read.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <glob.h>
#include <map>

namespace damslip {

namespace {

using Kind = ComponentName::Kind;

std::string in_capitals(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

Kind kind_of(const std::string& word)
{
    for (const char* vertical : {"V", "Z", "UP", "UD", "DN", "DWN", "DOWN", "VER", "VERT", "VRT", "UD1", "UD2"})
        if (word == vertical) return Kind::vertical;
    for (const char* horizontal :
         {"H", "H1", "H2", "N", "E", "S", "W", "NS", "EW", "SN", "WE", "X", "Y", "L", "T", "NS1", "NS2", "EW1", "EW2"})
        if (word == horizontal) return Kind::horizontal;
    return Kind::none;
}

constexpr const char* columns_of_a_list = "horizontal, vertical, other_horizontal, event, weight, magnitude, scale";

bool is_digit(char c)
{
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Three digits at the end that are an angle, after something that is no digit.
bool ends_with_azimuth(const std::string& stem)
{
    if (stem.size() < 4) return false;
    const std::string angle = stem.substr(stem.size() - 3);
    return std::all_of(angle.begin(), angle.end(), is_digit) && std::stoi(angle) <= 360 &&
           !is_digit(stem[stem.size() - 4]);
}

std::string without_separator(std::string text)
{
    while (!text.empty() && std::string_view("_-. ").find(text.back()) != std::string_view::npos) text.pop_back();
    return text;
}

/// Files of a folder that are no records.
bool is_something_else(const std::filesystem::path& file)
{
    const std::string extension = in_capitals(file.extension().string());
    for (const char* other :
         {".TOML", ".MD", ".HTML", ".PDF", ".SVG", ".PNG", ".JPG", ".JSON", ".XML", ".PY", ".SH", ".ZIP", ".GZ"})
        if (extension == other) return true;
    return file.filename().string().starts_with(".");
}

std::filesystem::path folder_of(const std::filesystem::path& path)
{
    return path.parent_path().empty() ? "." : path.parent_path();
}

RecordFiles record_of(const std::filesystem::path& horizontal)
{
    RecordFiles record;
    record.name = horizontal.stem().string();
    record.horizontal = horizontal;
    return record;
}

/// One station in one earthquake.
struct Station {
    std::vector<std::filesystem::path> horizontal, vertical;
};

RecordList paired(const std::vector<std::filesystem::path>& files)
{
    std::vector<std::string> order;
    std::map<std::string, Station> stations;
    std::map<std::string, std::string> names;
    for (const std::filesystem::path& file : files) {
        const ComponentName component = component_of_name(file);
        const std::string key = (file.parent_path() / in_capitals(component.base)).string();
        const auto [at, is_new] = stations.try_emplace(key);
        if (is_new) order.push_back(key);
        names.try_emplace(key, component.base);
        (component.kind == Kind::vertical ? at->second.vertical : at->second.horizontal).push_back(file);
    }
    RecordList list;
    for (const std::string& key : order) {
        const Station& station = stations[key];
        for (const std::filesystem::path& file : station.horizontal) {
            RecordFiles record = record_of(file);
            if (station.vertical.size() == 1) record.vertical = station.vertical.front();
            if (station.horizontal.size() == 2)
                record.other_horizontal = station.horizontal[&file == &station.horizontal.front() ? 1 : 0];
            list.records.push_back(std::move(record));
            list.events.push_back(names[key]);
            list.weights.push_back(1.0);
        }
        if (station.horizontal.empty() || station.vertical.size() > 1)
            for (const std::filesystem::path& file : station.vertical)
                list.notes.push_back(fmt::format("{} is a vertical component {}: it is left out.", file.string(),
                                                 station.horizontal.empty() ? "without a horizontal one"
                                                                            : "and not the only one of its station"));
    }
    return list;
}

RecordList records_of_a_seed_list(const std::filesystem::path& list)
{
    RecordList files;
    const records::SeededSuite suite = records::records_of_seeds(list);
    files.folder = suite.folder;
    for (const records::SeededPair& pair : suite.pairs) {
        RecordFiles record = record_of(pair.horizontal);
        record.name = pair.name;
        record.vertical = pair.vertical;
        files.records.push_back(std::move(record));
        files.events.push_back(pair.event);
        files.weights.push_back(pair.weight);
    }
    if (suite.made > 0)
        files.made = fmt::format("{}: {} of {} artificial records were made of their seeds, in {}", list.string(),
                                 suite.made, suite.pairs.size(), suite.folder.string());
    return files;
}

RecordList records_of_pattern(const std::string& pattern, bool folder)
{
    std::vector<std::filesystem::path> files;
    glob_t found{};
    if (::glob(pattern.c_str(), 0, nullptr, &found) == 0)
        for (std::size_t i = 0; i < found.gl_pathc; ++i) // in the order of their names
            if (std::filesystem::is_regular_file(found.gl_pathv[i]) &&
                !(folder && is_something_else(found.gl_pathv[i])))
                files.emplace_back(found.gl_pathv[i]);
    ::globfree(&found);
    for (const std::filesystem::path& file : files)
        if (!is_utf8(file.native()))
            refuse(utf8_text(file.string()), "its name is not UTF-8.", "a name in UTF-8", "rename the file");
    RecordList list = paired(files);
    list.folder = folder_of(pattern);
    return list;
}

RecordList records_of_list(const std::filesystem::path& list, const std::string& text)
{
    static const std::vector<std::string> known = {"horizontal", "vertical", "other_horizontal", "event", "weight",
                                                   "magnitude",  "scale"};
    const auto refused = [&](int line, const std::string& problem, const std::string& expected) {
        return InputError(Diagnostic{list.string(), line, 0, problem, expected, "correct this line"});
    };
    RecordList files;
    files.folder = folder_of(list);
    const CsvTable table = parse_csv(text);
    const std::vector<std::string>& columns = table.heading.cells;
    for (const std::string& column : columns)
        if (std::find(known.begin(), known.end(), column) == known.end())
            throw refused(table.heading.number, fmt::format("unknown column \"{}\".", column), columns_of_a_list);
    if (std::find(columns.begin(), columns.end(), "horizontal") == columns.end())
        throw refused(table.heading.number, "there is no column horizontal.", columns_of_a_list);
    for (const auto& [number, cells] : table.rows) {
        RecordFiles record;
        std::string event;
        double weight = 1.0;
        for (std::size_t k = 0; k < columns.size() && k < cells.size(); ++k) {
            const std::string& cell = cells[k];
            if (cell.empty()) continue;
            const std::filesystem::path file = list.parent_path() / cell;
            if (columns[k] == "horizontal" || columns[k] == "vertical" || columns[k] == "other_horizontal") {
                if (!std::filesystem::exists(file))
                    throw refused(number, fmt::format("{} is not there.", file.string()),
                                  "a record, from the folder of this list");
                if (columns[k] == "vertical")
                    record.vertical = file;
                else if (columns[k] == "other_horizontal")
                    record.other_horizontal = file;
                else {
                    record.horizontal = file;
                    record.name = file.stem().string();
                }
            } else if (columns[k] == "event") {
                event = cell;
            } else {
                const std::optional<double> value = parse_whole_number_text(cell);
                if (!value || !(*value > 0.0))
                    throw refused(number, fmt::format("{} = {} is not allowed.", columns[k], cell), "a number > 0");
                (columns[k] == "weight"  ? weight
                 : columns[k] == "scale" ? record.scale
                                         : record.magnitude.emplace()) = *value;
            }
        }
        if (record.horizontal.empty())
            throw refused(number, "this line has no horizontal record.", "a file in the column horizontal");
        files.events.push_back(event.empty() ? record.name : event);
        files.weights.push_back(weight);
        files.records.push_back(std::move(record));
    }
    return files;
}

} // namespace

ComponentName component_of_name(const std::filesystem::path& file)
{
    std::string extension = in_capitals(file.extension().string());
    if (!extension.empty()) extension.erase(0, 1);
    const std::string stem = file.stem().string();
    if (extension.size() >= 2)
        if (const Kind kind = kind_of(extension); kind != Kind::none) return {kind, stem};
    if (ends_with_azimuth(stem)) return {Kind::horizontal, without_separator(stem.substr(0, stem.size() - 3))};
    if (stem.size() > 3 && is_digit(stem[stem.size() - 3])) // a station's number, then the direction
        for (const char* word : {"NS", "EW", "UD", "UP"})
            if (in_capitals(stem.substr(stem.size() - 2)) == word)
                return {kind_of(word), without_separator(stem.substr(0, stem.size() - 2))};
    const std::size_t separator = stem.find_last_of("_-. ");
    if (separator == std::string::npos || separator == 0) return {Kind::none, stem};
    const Kind kind = kind_of(in_capitals(stem.substr(separator + 1)));
    if (kind == Kind::none) return {Kind::none, stem};
    return {kind, without_separator(stem.substr(0, separator))};
}

namespace {

RecordList found_records(const std::string& pattern)
{
    const std::filesystem::path path = pattern;
    if (std::filesystem::is_directory(path)) return records_of_pattern((path / "*").string(), true);
    if (path.extension() == ".csv" && std::filesystem::is_regular_file(path)) {
        const std::string text = read_file(path);
        if (records::is_seed_list(text)) return records_of_a_seed_list(path);
        if (text.find("horizontal") != std::string::npos) return records_of_list(path, text);
    }
    return records_of_pattern(pattern, false);
}

} // namespace

RecordList record_list(const std::string& pattern)
{
    RecordList list = found_records(pattern);
    number_names(list.records);
    return list;
}

} // namespace damslip
