#include "pages/sweep/sweep_parts.hpp"

#include "core/csv.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/number.hpp"
#include "pages/sweep/sweep_tables.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <regex>
#include <utility>

namespace damslip::pages {

namespace {

namespace fs = std::filesystem;

/// A part file as read, checked against its own checksum.
struct SweepPart {
    fs::path file;
    Shard shard;
    std::string comments, header; ///< of the whole sweep; the row of keys
    std::size_t rows = 0, not_converged = 0, rows_of_sweep = 0;
    std::map<std::size_t, std::string> lines; ///< by id
};

[[noreturn]] void not_a_part(const fs::path& file)
{
    refuse(file, "this is not a part of a sweep.", "a file written by  damslip sweep ... --shard i/n",
           "name the part files, or a folder that holds them");
}

constexpr std::uintmax_t largest_part = std::uintmax_t{2} << 30; ///< bytes, some ten million rows

/// The end of a line that starts with `start`; its text without the newline goes to `line`.
std::size_t next_line(const fs::path& file, const std::string& content, std::size_t start, std::string& line)
{
    const std::size_t end = content.find('\n', start);
    if (end == std::string::npos) not_a_part(file);
    line = content.substr(start, end - start);
    return end + 1;
}

void read_lines(const std::string& body, SweepPart& part)
{
    std::string line;
    std::size_t at = next_line(part.file, body, 0, part.header);
    while (at < body.size()) {
        at = next_line(part.file, body, at, line);
        std::size_t id = 0;
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), id);
        if (error != std::errc() || end == line.data() + line.size() || *end != ',' || id >= part.rows_of_sweep ||
            !part.lines.emplace(id, line).second)
            refuse(part.file, fmt::format("the row \"{}\" has no id of this sweep of its own.", line.substr(0, 40)),
                   fmt::format("each id below {} once", part.rows_of_sweep), "run this part again");
    }
}

SweepPart read_part(const fs::path& file)
{
    static const std::regex sweep_line("# sweep [0-9a-f]{64}, ([0-9]{1,12}) rows"),
        part_line("# part ([0-9]{1,7})/([0-9]{1,7}), ([0-9]{1,12}) rows, ([0-9]{1,12}) not converged, sha256 "
                  "([0-9a-f]{64})");
    std::smatch of_sweep, of_part;
    std::string first, scene, sweep, own;
    const auto head_of = [&](const std::string& text, SweepPart& part) { // @returns where the rows begin
        std::size_t at = next_line(file, text, 0, first);
        at = next_line(file, text, at, scene);
        at = next_line(file, text, at, sweep);
        part.comments = text.substr(0, at);
        at = next_line(file, text, at, own);
        if (!std::regex_match(sweep, of_sweep, sweep_line) || !std::regex_match(own, of_part, part_line))
            not_a_part(file);
        return at;
    };
    SweepPart part;
    part.file = file;
    const std::string content = read_file(file, largest_part, [&](const std::string& start) { head_of(start, part); });
    const std::size_t at = head_of(content, part);
    part.rows_of_sweep = std::stoull(of_sweep[1]);
    part.shard = {std::stoull(of_part[1]), std::stoull(of_part[2])};
    part.rows = std::stoull(of_part[3]);
    part.not_converged = std::stoull(of_part[4]);
    const std::string body = content.substr(at);
    if (sha256(body) != of_part[5] || part.shard.index >= part.shard.count)
        refuse(file, "the rows are not those that were written: the checksum differs.", "a part file as written",
               fmt::format("run the part again:  --shard {}/{}", part.shard.index, part.shard.count));
    read_lines(body, part);
    return part;
}

std::vector<fs::path> part_files(const std::vector<fs::path>& paths)
{
    static const std::regex name(R"(.*\.[0-9]+-of-[0-9]+\.csv)");
    std::vector<fs::path> files;
    for (const fs::path& path : paths) {
        std::error_code error;
        if (!fs::is_directory(path, error)) {
            files.push_back(path);
            continue;
        }
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(path, error))
            if (std::regex_match(entry.path().filename().string(), name)) found.push_back(entry.path());
        if (error) refuse(path, "the folder cannot be read: " + error.message() + ".", "a readable folder", "");
        if (found.empty())
            refuse(path, "there is no part of a sweep in this folder.", "files named *.i-of-n.csv",
                   "run the parts first:  damslip sweep ... --out results.csv --shard i/n");
        std::sort(found.begin(), found.end());
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

/// All of one sweep, none twice, none missing.
void check_parts(const std::vector<SweepPart>& parts)
{
    const SweepPart& first = parts.front();
    std::map<std::size_t, const SweepPart*> by_index;
    for (const SweepPart& part : parts) {
        if (part.comments != first.comments || part.header != first.header || part.shard.count != first.shard.count)
            refuse(part.file,
                   fmt::format("part {}/{} is not of the same sweep as {}.", part.shard.index, part.shard.count,
                               first.file.string()),
                   "parts of one sweep: the same scene, records, grid, version and number of parts",
                   "merge the parts of each sweep by themselves");
        const auto [there, fresh] = by_index.emplace(part.shard.index, &part);
        if (!fresh)
            refuse(part.file,
                   fmt::format("part {}/{} is given twice, also as {}.", part.shard.index, part.shard.count,
                               there->second->file.string()),
                   "each part once", "leave one of them out");
    }
    std::string missing, flags;
    for (std::size_t i = 0; i < first.shard.count; ++i)
        if (!by_index.contains(i)) {
            missing += fmt::format("{}{}/{}", missing.empty() ? "" : ", ", i, first.shard.count);
            flags += fmt::format("{}--shard {}/{}", flags.empty() ? "" : ", ", i, first.shard.count);
        }
    if (!missing.empty())
        refuse({},
               fmt::format("{} of {} parts are missing: {}.", first.shard.count - by_index.size(), first.shard.count,
                           missing),
               "all parts of the sweep", "run them:  " + flags);
}

Cell cell_of(const std::string& key, const std::string& field)
{
    for (const char* word : {"uplift", "opening_water", "reservoir", "record", "method", "status"})
        if (key == word) return field;
    if (field.empty()) return {};
    const std::optional<double> number = parse_number(field);
    if (!number) return field;
    if (key == "id" || key == "polarity") return static_cast<std::int64_t>(*number);
    return *number;
}

} // namespace

Table sweep_rows_of(const std::string& csv)
{
    const CsvTable read = parse_csv(csv);
    const std::vector<std::string>& keys = read.heading.cells;
    const auto has = [&](const std::string& key) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
    AxisColumns with{has("opening_water"), has("period_s"), has("damping"), {}, {}, has("mean_slip_m")};
    const auto numbered = [&](const char* key, const char* what, std::vector<std::string>& names) {
        while (has(fmt::format(fmt::runtime(key), names.size() + 1)))
            names.push_back(fmt::format("{} {}", what, names.size() + 1));
    };
    numbered("slip_after_event_{}_m", "event", with.events);
    numbered("anchor_{}_state", "anchor", with.anchors);
    Table table{"", sweep_columns(with), {}, {}};
    const auto check = [&](const CsvLine& line, bool fits) {
        if (!fits)
            refuse({},
                   fmt::format("line {}, \"{:.60}\", is not one of a sweep of this version.", line.number,
                               fmt::format("{}", fmt::join(line.cells, ","))),
                   "the columns of this version", "run the parts again");
    };
    check(read.heading, std::equal(keys.begin(), keys.end(), table.columns.begin(), table.columns.end(),
                                   [](const std::string& key, const Column& column) { return key == column.key; }));
    for (const CsvLine& line : read.rows) {
        check(line, line.cells.size() == keys.size());
        std::vector<Cell>& row = table.rows.emplace_back();
        for (std::size_t i = 0; i < keys.size(); ++i) row.push_back(cell_of(keys[i], line.cells[i]));
    }
    return table;
}

fs::path part_file(const fs::path& csv, const Shard& shard)
{
    fs::path file = csv;
    file.replace_filename(csv.stem().string() + fmt::format(".{}-of-{}.csv", shard.index, shard.count));
    return file;
}

std::string part_text(const SweepIdentity& identity, const Shard& shard, const std::string& body, std::size_t rows,
                      std::size_t not_converged)
{
    std::string text;
    for (const std::string& comment : csv_comments(identity)) text += "# " + comment + "\n";
    text += fmt::format("# part {}/{}, {} rows, {} not converged, sha256 {}\n", shard.index, shard.count, rows,
                        not_converged, sha256(body));
    return text + body;
}

MergedSweep merge_parts(const std::vector<fs::path>& paths)
{
    std::vector<SweepPart> parts;
    for (const fs::path& file : part_files(paths)) parts.push_back(read_part(file));
    check_parts(parts);
    MergedSweep merged;
    merged.parts = parts.size();
    std::map<std::size_t, std::string> lines;
    for (SweepPart& part : parts) {
        merged.not_converged += part.not_converged;
        lines.merge(part.lines);
        if (!part.lines.empty()) // ids that were there before stay behind
            refuse(part.file, fmt::format("row {} is also in another part.", part.lines.begin()->first),
                   "each row in one part", "run the parts again");
    }
    if (lines.size() != parts.front().rows_of_sweep)
        refuse(parts.front().file,
               fmt::format("the parts have {} rows, the sweep {}.", lines.size(), parts.front().rows_of_sweep),
               "all rows", "run the parts again");
    merged.rows = lines.size();
    merged.text = parts.front().comments + parts.front().header + "\n";
    for (const auto& [id, line] : lines) merged.text += line + "\n";
    return merged;
}

} // namespace damslip::pages
