#include "analysis/prepare/record_list.hpp"

#include "core/csv.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "records/generate/generate.hpp"
#include "records/read/read_record.hpp"
#include "scene/read.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glob.h>
#include <map>
#include <optional>
#include <set>

namespace damslip {

namespace {

using records::Component;

std::string in_capitals(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

bool is_digit(char c)
{
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Three digits that are an angle.
bool is_azimuth(std::string_view angle)
{
    return angle.size() == 3 && std::all_of(angle.begin(), angle.end(), is_digit) &&
           std::stoi(std::string(angle)) <= 360;
}

constexpr std::string_view separators = "_-. ";

/// The name without its part from `begin` to `end`, with one separator for two.
std::string without_part(std::string_view name, std::size_t begin, std::size_t end)
{
    const std::size_t left = name.substr(0, begin).find_last_not_of(separators);
    const std::size_t right = name.find_first_not_of(separators, end);
    const std::string before(left == std::string_view::npos ? "" : name.substr(0, left + 1));
    const std::string after(right == std::string_view::npos ? "" : name.substr(right));
    return before + (before.empty() || after.empty() ? "" : std::string(1, name[begin - 1])) + after;
}

/// Parts of a name between separators, "N-S", "E-W" and "U-D" being one.
struct NamePart {
    std::size_t begin, end;
    std::string word; ///< in lower case, without separators
};

std::vector<NamePart> parts_of(std::string_view stem)
{
    std::vector<NamePart> parts;
    for (std::size_t at = 0; (at = stem.find_first_not_of(separators, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(stem.find_first_of(separators, at), stem.size());
        parts.push_back({at, end, records::lower(stem.substr(at, end - at))});
        at = end;
        if (parts.size() < 2) continue;
        const NamePart& before = parts[parts.size() - 2];
        const std::string both = before.word + parts.back().word;
        if (both != "ns" && both != "ew" && both != "ud" && both != "sn" && both != "we") continue;
        const std::size_t begin = before.begin;
        parts.resize(parts.size() - 2);
        parts.push_back({begin, end, both});
    }
    return parts;
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

/// One component of a file.
struct Channel {
    std::filesystem::path file;
    std::string column; ///< of a file that holds several
};

/// One station in one earthquake.
struct Station {
    std::string event; ///< its name
    std::vector<Channel> horizontal, vertical;
};

/// What a file holds by its headers.
struct Survey {
    std::filesystem::path file;
    std::vector<std::string>
        components;    ///< of its channels; none where it cannot be read: the error is reported when it is
    std::string title; ///< event and station
};

Survey survey_of(const std::filesystem::path& file)
{
    Survey survey{file, {}, ""};
    try {
        records::ReadOptions options;
        options.survey = true;
        options.uneven = records::UnevenTime::resample;
        for (const Record& record : records::parse_record(read_file(file), file.string(), options)) {
            survey.components.push_back(record.source.component);
            survey.title = record.source.title;
        }
        const std::string& component = survey.components.front();
        if (survey.title.ends_with(component)) // of PEER
            survey.title.resize(survey.title.size() - component.size());
    } catch (const InputError&) {
        survey.components.clear();
    }
    return survey;
}

/// The channels of a file that holds one or two horizontal and at most one vertical; nothing for others.
std::optional<Station> station_in(const Survey& survey)
{
    if (survey.components.size() < 2) return std::nullopt;
    Station station{survey.file.stem().string(), {}, {}};
    for (const std::string& component : survey.components) {
        const Component kind = records::component_in(component);
        if (kind == Component::none) return std::nullopt;
        (kind == Component::vertical ? station.vertical : station.horizontal).push_back({survey.file, component});
    }
    if (station.horizontal.empty() || station.horizontal.size() > 2 || station.vertical.size() > 1) return std::nullopt;
    return station;
}

/// The reading of the name that agrees with the header's component: "140" of the header is no other part of "E06140".
std::optional<ComponentName> name_with(const std::filesystem::path& file, const std::string& component)
{
    std::string word = records::lower(component.substr(0, component.find(' ')));
    std::erase_if(word, [](char c) { return c == '-'; });
    if (word.empty()) return std::nullopt;
    if (word.size() < 3 && std::all_of(word.begin(), word.end(), is_digit)) word.insert(0, 3 - word.size(), '0');
    const std::string stem = file.stem().string();
    const std::vector<NamePart> parts = parts_of(stem);
    for (auto part = parts.rbegin(); part != parts.rend(); ++part)
        if (part->word == word)
            return ComponentName{records::component_in(component), without_part(stem, part->begin, part->end)};
    if (word.size() > 1 && stem.size() > word.size() && records::lower(stem).ends_with(word))
        return ComponentName{records::component_in(component),
                             without_part(stem, stem.size() - word.size(), stem.size())};
    return std::nullopt;
}

/// A file with what header and name say, as far as it is settled without the others.
struct NamedFile {
    Survey survey;
    std::vector<ComponentName> readings; ///< of the name
    Component of_header = Component::none;
    ComponentName chosen;
};

std::string key_of(const std::filesystem::path& file, const std::string& base)
{
    return (file.parent_path() / in_capitals(base)).string();
}

NamedFile named_file(Survey survey)
{
    NamedFile named{std::move(survey), component_names(named.survey.file), Component::none, {}};
    const std::string component = named.survey.components.size() == 1 ? named.survey.components.front() : "";
    named.of_header = records::component_in(component);
    if (named.of_header != Component::none)
        if (auto same = name_with(named.survey.file, component)) named.readings.insert(named.readings.begin(), *same);
    return named;
}

/// The first reading that counts: alone, or because another file has its base.
void choose_readings(std::vector<NamedFile>& files)
{
    std::map<std::string, std::set<std::string>> files_of_base;
    for (const NamedFile& file : files)
        for (const ComponentName& name : file.readings)
            if (name.kind != Component::none)
                files_of_base[key_of(file.survey.file, name.base)].insert(file.survey.file.string());
    for (NamedFile& file : files)
        for (const ComponentName& name : file.readings)
            if (name.alone || files_of_base[key_of(file.survey.file, name.base)].size() > 1) {
                file.chosen = name;
                break;
            }
}

std::string in_words(Component kind)
{
    return kind == Component::vertical ? "vertical" : "horizontal";
}

/// "a, b, c and 7 more".
std::string names_of(const std::vector<std::string>& names)
{
    constexpr std::size_t most = 5;
    std::string list;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i) list += (i ? ", " : "") + names[i];
    return list + (names.size() > most ? fmt::format(" and {} more", names.size() - most) : "");
}

/// Motions of a station: one for each horizontal component.
void add_station(const Station& station, const RecordFiles& like, double weight, RecordList& list)
{
    for (std::size_t i = 0; i < station.horizontal.size(); ++i) {
        const Channel& channel = station.horizontal[i];
        RecordFiles record = record_of(channel.file);
        if (!channel.column.empty()) record.name += "-" + channel.column.substr(0, channel.column.find_first_of(" ,"));
        const auto taken = std::count_if(list.records.begin(), list.records.end(), [&](const RecordFiles& other) {
            return other.name == record.name || other.name.starts_with(record.name + " (");
        });
        if (taken > 0) record.name += fmt::format(" ({})", taken + 1);
        record.column = channel.column;
        record.magnitude = like.magnitude;
        record.scale = like.scale;
        record.vertical = like.vertical;
        record.vertical_column = like.vertical_column;
        if (!like.vertical && station.vertical.size() == 1) {
            record.vertical = station.vertical.front().file;
            record.vertical_column = station.vertical.front().column;
        }
        if (station.horizontal.size() == 2) record.other_horizontal = station.horizontal[1 - i].file;
        list.records.push_back(std::move(record));
        list.events.push_back(station.event);
        list.weights.push_back(weight);
    }
}

RecordList paired(const std::vector<std::filesystem::path>& paths, bool stations_in_files)
{
    std::vector<NamedFile> files;
    for (const std::filesystem::path& path : paths) files.push_back(named_file(survey_of(path)));
    choose_readings(files);
    std::vector<std::string> order, unknown, without_vertical;
    std::map<std::string, Station> stations;
    RecordList list;
    bool any_vertical = false;
    for (const NamedFile& file : files) {
        const std::filesystem::path& path = file.survey.file;
        auto station = stations_in_files ? station_in(file.survey) : std::nullopt;
        std::string key = key_of(path, file.chosen.base);
        Component kind = file.of_header != Component::none ? file.of_header : file.chosen.kind;
        if (file.of_header != Component::none && file.chosen.kind == Component::none && !file.survey.title.empty())
            key = path.parent_path().string() + "\n" + file.survey.title; // of a name without a direction
        if (station) key = "\n" + path.string();
        const auto [at, is_new] = stations.try_emplace(key, Station{file.chosen.base, {}, {}});
        if (is_new) order.push_back(key);
        if (station) {
            at->second = *station;
            any_vertical |= !station->vertical.empty();
            continue;
        }
        if (file.of_header != Component::none && file.chosen.kind != Component::none &&
            file.of_header != file.chosen.kind)
            list.notes.push_back(fmt::format("{}: {} by its header ({}), {} by its name: the header counts.",
                                             path.string(), in_words(file.of_header), file.survey.components.front(),
                                             in_words(file.chosen.kind)));
        if (kind == Component::none && file.survey.components.size() < 2) unknown.push_back(path.filename().string());
        any_vertical |= kind == Component::vertical;
        (kind == Component::vertical ? at->second.vertical : at->second.horizontal).push_back({path, ""});
    }
    for (const std::string& key : order) {
        const Station& station = stations[key];
        const std::size_t before = list.records.size();
        add_station(station, {}, 1.0, list);
        for (std::size_t i = before; i < list.records.size(); ++i)
            if (!list.records[i].vertical) without_vertical.push_back(list.records[i].name);
        if (station.horizontal.empty() || station.vertical.size() > 1)
            for (const Channel& channel : station.vertical)
                list.notes.push_back(fmt::format(
                    "{} is a vertical component {}: it is left out.", channel.file.string(),
                    station.horizontal.empty() ? "without a horizontal one" : "and not the only one of its station"));
    }
    if (any_vertical && !without_vertical.empty())
        list.notes.push_back(fmt::format("without a vertical component: {}.", names_of(without_vertical)));
    if (!unknown.empty())
        list.notes.push_back(
            fmt::format("neither header nor name says the component, taken as horizontal: {}.", names_of(unknown)));
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

RecordList records_of_pattern(const std::string& pattern, bool folder, bool stations)
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
    RecordList list = paired(files, stations);
    list.folder = folder_of(pattern);
    return list;
}

RecordList records_of_list(const std::filesystem::path& list, const std::string& text, bool stations)
{
    static const std::vector<std::string> known = {"horizontal", "vertical",        "other_horizontal",
                                                   "column",     "vertical_column", "event",
                                                   "weight",     "magnitude",       "scale"};
    const std::string known_columns = fmt::format("{}", fmt::join(known, ", "));
    const auto refused = [&](int line, const std::string& problem, const std::string& expected) {
        return InputError(Diagnostic{list.string(), line, 0, problem, expected, "correct this line"});
    };
    RecordList files;
    files.folder = folder_of(list);
    const CsvTable table = parse_csv(text);
    const std::vector<std::string>& columns = table.heading.cells;
    records::check_list(list, table, known, {"horizontal"}, known_columns.c_str());
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
            } else if (columns[k] == "column" || columns[k] == "vertical_column") {
                (columns[k] == "column" ? record.column : record.vertical_column) = cell;
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
        if (auto station =
                stations && record.column.empty() ? station_in(survey_of(record.horizontal)) : std::nullopt) {
            if (!event.empty()) station->event = event;
            add_station(*station, record, weight, files);
            continue;
        }
        if (!record.column.empty()) record.name += "-" + record.column.substr(0, record.column.find_first_of(" ,"));
        files.events.push_back(event.empty() ? record.horizontal.stem().string() : event);
        files.weights.push_back(weight);
        files.records.push_back(std::move(record));
    }
    return files;
}

} // namespace

std::vector<ComponentName> component_names(const std::filesystem::path& file)
{
    const std::string stem = file.stem().string();
    const std::size_t size = stem.size();
    std::string extension = records::lower(file.extension().string());
    if (!extension.empty()) extension.erase(0, 1);
    std::vector<ComponentName> names;
    const bool letter = extension.size() == 1 && std::string_view("nezu").find(extension) != std::string_view::npos;
    const bool volume =
        extension.size() == 2 && extension[0] == 'v' && is_digit(extension[1]); // of an agency: .V1, .V2
    if ((extension.size() >= 2 && !volume) || letter)
        if (const Component kind = records::component_in_part(extension);
            kind != Component::none) // KiK-net: borehole 1, surface 2
            names.push_back({kind, is_digit(extension.back()) ? stem + "." + extension.back() : stem});
    if (size > 3 && is_azimuth(std::string_view(stem).substr(size - 3)) && !is_digit(stem[size - 4]))
        names.push_back({Component::horizontal, without_part(stem, size - 3, size)});
    if (size > 3 && is_digit(stem[size - 3])) // a station's number, then the direction
        for (const char* word : {"ns", "ew", "ud", "up", "dn"})
            if (records::lower(stem.substr(size - 2)) == word)
                names.push_back({records::component_in_part(word), without_part(stem, size - 2, size)});
    const std::vector<NamePart> parts = parts_of(stem);
    std::vector<ComponentName> weak;
    if (parts.size() > 1)
        for (std::size_t k = parts.size(); k-- > 0;) {
            const Component kind =
                is_azimuth(parts[k].word) ? Component::horizontal : records::component_in_part(parts[k].word);
            if (kind == Component::none) continue;
            // A letter or a number in the middle may mean anything else.
            const bool end = k == 0 || k + 1 == parts.size();
            const bool sure = parts[k].word.size() > 1 && !is_azimuth(parts[k].word);
            (sure || (end && !is_azimuth(parts[k].word)) ? names : weak)
                .push_back({kind, without_part(stem, parts[k].begin, parts[k].end)});
        }
    if (size > 4 && is_azimuth(std::string_view(stem).substr(size - 3)))
        weak.push_back({Component::horizontal, without_part(stem, size - 3, size)});
    for (const std::string_view word :
         {"vert", "dwn", "ver", "up", "ud", "dn", "ns", "ew", "n", "e", "z", "v", "h", "x", "y"})
        if (size > word.size() && records::lower(stem).ends_with(word))
            weak.push_back({records::component_in_part(word), without_part(stem, size - word.size(), size)});
    for (ComponentName& name : weak) name.alone = false;
    names.insert(names.end(), weak.begin(), weak.end());
    names.push_back({Component::none, stem});
    return names;
}

namespace {

RecordList found_records(const std::string& pattern, bool stations)
{
    const std::filesystem::path path = pattern;
    if (std::filesystem::is_directory(path)) return records_of_pattern((path / "*").string(), true, stations);
    if (path.extension() == ".csv" && std::filesystem::is_regular_file(path)) {
        const std::string text = read_file(path);
        if (records::is_seed_list(text)) return records_of_a_seed_list(path);
        if (text.find("horizontal") != std::string::npos) return records_of_list(path, text, stations);
    }
    return records_of_pattern(pattern, false, stations);
}

} // namespace

RecordList record_list(const std::string& pattern, bool stations)
{
    RecordList list = found_records(pattern, stations);
    number_names(list.records);
    return list;
}

} // namespace damslip
