#include "analysis/sweep/sweep_journal.hpp"

#include "core/append_number.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <fmt/compile.h>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace damslip {

namespace {

constexpr std::string_view first_line = "damslip sweep journal 6";
constexpr std::string_view done_line = "done\n", begun_word = "begun";
constexpr std::size_t checksum_digits = 16, head_lines = 7;

/// Up to eight bytes as a number, the first the lowest: the same on every machine.
std::uint64_t word_of(std::string_view bytes)
{
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) word |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << 8 * i;
    return word;
}

/// Eight bytes a step, as hexadecimal digits. A step takes different numbers to different ones, so damage within one
/// word is always found; the shift brings high bits down, without which damage of two words could cancel out.
std::array<char, checksum_digits> checksum(std::string_view text)
{
    std::uint64_t hash = 0xcbf29ce484222325u ^ text.size();
    const auto take = [&hash](std::uint64_t word) {
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    };
    constexpr std::size_t bytes = 8;
    for (; text.size() >= bytes; text.remove_prefix(bytes)) {
        std::uint64_t word = 0;
        std::memcpy(&word, text.data(), bytes);
        take(std::endian::native == std::endian::little ? word : word_of(text.substr(0, bytes)));
    }
    take(word_of(text));
    std::array<char, checksum_digits> digits;
    for (std::size_t i = checksum_digits; i-- > 0; hash >>= 4) digits[i] = "0123456789abcdef"[hash & 0xF];
    return digits;
}

/// As JSON has it, with all digits; null for none.
void add_number(std::string& out, const std::optional<double>& value)
{
    if (!value || !std::isfinite(*value))
        out += "null";
    else if (*value == 0.0)
        out += std::signbit(*value) ? "-0.0" : "0";
    else
        append_shortest(out, *value);
}

std::string head_of(const SweepIdentity& i, const Shard& shard)
{
    return fmt::format("{}\nversion {}\nscene {}\nrecords {}\ngrid {}\nrows {}\npart {}/{}\n", first_line, i.version,
                       i.scene, i.records, i.grid, i.rows, shard.index, shard.count);
}

/// The status stands among the numbers.
constexpr std::size_t status_place = 8, result_count = row_numbers.size() + 1;

RowResults results_of(nlohmann::json cells)
{
    RowResults results;
    if (cells[status_place].is_string()) results.status = cells[status_place].get<std::string>();
    cells.erase(status_place);
    for (std::size_t i = 0; i < row_numbers.size(); ++i)
        if (cells[i].is_number()) results.*row_numbers[i] = cells[i].get<double>();
    return results;
}

/// Slips after the events and anchors, as the last element of a line; nothing where there are none.
void add_extras(const RowResults& results, std::string& text)
{
    if (results.event_slips.empty() && results.anchors.empty()) return;
    text += ",{\"events\":[";
    for (std::size_t k = 0; k < results.event_slips.size(); ++k) {
        if (k) text += ",";
        add_number(text, results.event_slips[k]);
    }
    text += "],\"anchors\":[";
    for (std::size_t k = 0; k < results.anchors.size(); ++k) {
        text += (k ? ",[" : "[") + nlohmann::json(results.anchors[k].name).dump() + ",";
        add_number(text, results.anchors[k].largest_force);
        text += "," + nlohmann::json(results.anchors[k].state).dump() + "]";
    }
    text += "]}";
}

/// @throws nlohmann::json::exception  for what add_extras() would not write
void read_extras(const nlohmann::json& json, RowResults& results)
{
    results.event_slips = json.at("events").get<std::vector<double>>();
    for (const nlohmann::json& anchor : json.at("anchors"))
        results.anchors.push_back(
            {anchor.at(0).get<std::string>(), anchor.at(1).get<double>(), anchor.at(2).get<std::string>()});
}

/// Lines of rows one after the other. A number or word that the row before had in the same place is copied from it.
class RowLines {
public:
    void add(const FinishedRow& row, std::string& out)
    {
        const std::size_t begin = out.size();
        out.append(checksum_digits, '0');
        out += ' ';
        const std::size_t text = out.size();
        add_row(row, out);
        const std::array<char, checksum_digits> sum = checksum(std::string_view(out).substr(text));
        std::copy(sum.begin(), sum.end(), out.begin() + static_cast<std::ptrdiff_t>(begin));
        out += '\n';
    }

private:
    struct Number {
        std::uint64_t bits = 0;
        std::string text;
    };

    void add_row(const FinishedRow& row, std::string& out)
    {
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("[{},{},["), row.id, row.good);
        for (std::size_t i = 0; i < row_numbers.size(); ++i) {
            if (i == status_place) add_status(row.results.status, out);
            if (const std::optional<double>& number = row.results.*row_numbers[i])
                add_number_of(i, *number, out);
            else
                out += "null";
            out += i + 1 < row_numbers.size() ? ',' : ']';
        }
        if (row.history.interval > 0.0) add_history(row.history, out);
        add_extras(row.results, out);
        out += ']';
    }
    void add_status(const std::string& status, std::string& out)
    {
        if (status != status_ || status_text_.empty()) {
            status_ = status;
            status_text_ = (status.empty() ? "null" : nlohmann::json(status).dump()) + ",";
        }
        out += status_text_;
    }
    void add_number_of(std::size_t place, double number, std::string& out)
    {
        const auto bits = std::bit_cast<std::uint64_t>(number);
        Number& last = last_[place];
        if (last.text.empty() || last.bits != bits) {
            last.bits = bits;
            last.text.clear();
            add_number(last.text, number);
        }
        out += last.text;
    }
    static void add_history(const SlipHistory& history, std::string& out)
    {
        out += ',';
        add_number(out, history.interval);
        out += ",[";
        for (std::size_t k = 0; k < history.slip.size(); ++k) {
            if (k) out += ',';
            add_number(out, history.slip[k]);
        }
        out += ']';
    }

    std::array<Number, row_numbers.size()> last_;
    std::string status_, status_text_;
};

/// Nothing for a line that is not what RowLines wrote.
std::optional<FinishedRow> row_of(std::string_view line, std::size_t rows)
{
    if (line.size() < checksum_digits + 2 || line[checksum_digits] != ' ') return std::nullopt;
    const std::string_view text = line.substr(checksum_digits + 1);
    const std::array<char, checksum_digits> sum = checksum(text);
    if (std::string_view(sum.data(), sum.size()) != line.substr(0, checksum_digits)) return std::nullopt;
    auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_array() || json.empty()) return std::nullopt;
    nlohmann::json more;
    if (json.back().is_object()) {
        more = std::move(json.back());
        json.erase(json.size() - 1);
    }
    if ((json.size() != 3 && json.size() != 5) || !json[0].is_number_unsigned() || !json[1].is_boolean() ||
        !json[2].is_array() || json[2].size() != result_count || json[0].get<std::size_t>() >= rows)
        return std::nullopt;
    FinishedRow row{json[0].get<std::size_t>(), json[1].get<bool>(), results_of(json[2]), {}};
    if (json.size() == 5) {
        if (!json[3].is_number() || !json[4].is_array()) return std::nullopt;
        row.history = {json[3].get<double>(), json[4].get<std::vector<double>>()};
    }
    try {
        if (!more.is_null()) read_extras(more, row.results);
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
    return row;
}

/// What differs between two heads, in words: "the scene, the grid (friction 0.7; ... here, friction 0.8; ... there)".
std::string differences(const std::string& mine, const std::string& theirs)
{
    std::string words;
    std::size_t a = 0, b = 0;
    while (a < mine.size() && b < theirs.size()) {
        const auto line = [](const std::string& text, std::size_t& at) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            std::string out = text.substr(at, end - at);
            at = end + 1;
            return out;
        };
        const std::string here = line(mine, a), there = line(theirs, b);
        if (here == there) continue;
        const std::string name = here.substr(0, here.find(' '));
        const bool hash = name == "scene" || name == "records";
        const auto value = [&](const std::string& text) { return text.substr(std::min(text.size(), name.size() + 1)); };
        words +=
            (words.empty() ? "" : "; ") + name +
            (hash ? std::string(" (other contents)") : fmt::format(" ({} now, {} there)", value(here), value(there)));
    }
    return words;
}

/// The lines of a file one after the other, each with its line end; the last one may be torn and have none. Some of the file is held at a time.
class LinesOfFile {
public:
    LinesOfFile(int descriptor, const std::filesystem::path& file) : descriptor_(descriptor), file_(file) {}

    /// To the next one. @returns false: there is none
    bool next()
    {
        at_ += length_;
        begin_ += length_;
        std::size_t end = held_.find('\n', begin_);
        while (end == std::string::npos && read_on()) end = held_.find('\n', begin_);
        length_ = std::min(end, held_.size() - 1) + 1 - begin_;
        return begin_ < held_.size();
    }
    std::string_view line() const { return std::string_view(held_).substr(begin_, length_); }
    std::uint64_t at() const { return at_; } ///< its first byte
    bool torn() const { return !line().ends_with('\n'); }

private:
    /// Drops what is behind and reads on. @returns false: at the end of the file
    bool read_on()
    {
        constexpr std::size_t some = 1u << 20;
        held_.erase(0, begin_);
        begin_ = 0;
        const std::size_t before = held_.size();
        held_.resize(before + some);
        const ssize_t n = ::pread(descriptor_, held_.data() + before, some, static_cast<off_t>(at_ + before));
        if (n < 0)
            refuse(file_, fmt::format("cannot be read: {}.", std::strerror(errno)), "a file with read permission",
                   "choose another --out");
        held_.resize(before + static_cast<std::size_t>(n));
        return n > 0;
    }

    int descriptor_;
    const std::filesystem::path& file_;
    std::string held_;
    std::size_t begin_ = 0, length_ = 0; ///< of the line in held_
    std::uint64_t at_ = 0;
};

/// Nothing is lost with it: its table is written, or it has no row yet.
bool replaceable(LinesOfFile lines)
{
    if (!lines.next() || !lines.line().starts_with(first_line)) return false;
    std::size_t rows = 0;
    bool done = false;
    for (std::size_t line = 1; lines.next(); ++line) {
        rows += line >= head_lines && !lines.line().starts_with(begun_word);
        done = lines.line() == done_line;
    }
    return done || rows == 0;
}

/// Ids of a line that begin() wrote; a damaged one gives others or none, which only costs time.
std::vector<std::size_t> begun_ids(std::string_view line)
{
    std::vector<std::size_t> ids;
    std::istringstream in{std::string(line.substr(begun_word.size()))};
    for (std::size_t id = 0; in >> id;) ids.push_back(id);
    return ids;
}

/// Opened and locked; the lock goes with the process, however it ends.
int open_locked(const std::filesystem::path& file)
{
    const int descriptor = ::open(file.c_str(), O_RDWR | O_APPEND | O_CLOEXEC);
    if (descriptor < 0)
        refuse(file, fmt::format("cannot be opened: {}.", std::strerror(errno)), "a file with write permission",
               "choose another --out");
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor);
        refuse(file, "another process is writing this journal.", "one process for each --out",
               "wait for it, or end it, or choose another --out");
    }
    return descriptor;
}

} // namespace

Journal::Journal(std::filesystem::path file, const SweepIdentity& identity, const Shard& shard, JournalStart start)
    : file_(std::move(file))
{
    const std::string head = head_of(identity, shard);
    const bool there = std::filesystem::exists(file_);
    if (!there) write_file(file_, head);
    descriptor_ = open_locked(file_);
    if (!there) return;
    try {
        if (start == JournalStart::fresh && replaceable({descriptor_, file_})) {
            write_file(file_, head); // a new file in its place: whole at any moment
            const int old = std::exchange(descriptor_, open_locked(file_));
            ::close(old);
            return;
        }
        read(head, identity.rows);
        if (start == JournalStart::fresh)
            refuse(file_, fmt::format("{} rows of this sweep are finished here.", finished_.size()),
                   "--resume to go on, or another --out", "add  --resume ; to begin again delete this file");
        if (::ftruncate(descriptor_, static_cast<off_t>(whole_bytes_)) != 0)
            refuse(file_, fmt::format("cannot be cut: {}.", std::strerror(errno)), "a file with write permission",
                   "choose another --out");
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

Journal::~Journal()
{
    ::close(descriptor_); // the lock goes with it
}

void Journal::read(const std::string& head, std::size_t rows)
{
    LinesOfFile lines(descriptor_, file_);
    std::string begins;
    while (begins.size() < head.size() && lines.next()) begins += lines.line();
    if (begins != head) {
        const bool journal = begins.starts_with(std::string(first_line) + "\n");
        while (journal && std::count(begins.begin(), begins.end(), '\n') < std::ptrdiff_t{head_lines} && lines.next())
            begins += lines.line();
        refuse(file_,
               journal ? "this journal belongs to a sweep of other inputs: " + differences(head, begins) + "."
                       : std::string("this is not a journal of a sweep."),
               "the journal of the same scene, records, grid, part and version",
               "choose another --out, or delete this file to begin again");
    }
    std::vector<bool> seen(rows);
    whole_bytes_ = head.size();
    while (lines.next()) {
        if (lines.torn()) {
            ++damaged_;
            break;
        }
        const std::string_view line = lines.line();
        const std::optional<FinishedRow> row = row_of(line.substr(0, line.size() - 1), rows);
        if (line == done_line)
            done_ = true;
        else if (line.starts_with(begun_word))
            for (const std::size_t id : begun_ids(line)) ++stopped_[id];
        else if (!row)
            ++damaged_;
        else if (!seen[row->id]) {
            seen[row->id] = true;
            finished_.push_back({row->id, lines.at(), static_cast<std::uint32_t>(line.size() - 1)});
        }
        whole_bytes_ = lines.at() + line.size();
    }
    rows_ = rows;
    std::sort(finished_.begin(), finished_.end(), [](const Place& a, const Place& b) { return a.id < b.id; });
    std::erase_if(stopped_, [&](const auto& entry) { return entry.first >= rows || seen[entry.first]; });
}

std::vector<FinishedRow> Journal::finished_rows(std::size_t first, std::size_t last) const
{
    std::vector<FinishedRow> found;
    const auto before = [](const Place& place, std::size_t id) { return place.id < id; };
    std::string line;
    for (auto at = std::lower_bound(finished_.begin(), finished_.end(), first, before);
         at != finished_.end() && at->id <= last; ++at) {
        line.resize(at->length);
        const ssize_t n = ::pread(descriptor_, line.data(), line.size(), static_cast<off_t>(at->byte));
        std::optional<FinishedRow> row = n == static_cast<ssize_t>(line.size()) ? row_of(line, rows_) : std::nullopt;
        if (!row)
            refuse(file_, fmt::format("row {} was whole when the sweep began and is not any more.", at->id),
                   "a file that nobody else writes", "go on with --resume");
        found.push_back(std::move(*row));
    }
    return found;
}

void Journal::append(std::span<const FinishedRow> rows)
{
    std::string text;
    RowLines lines;
    for (const FinishedRow& row : rows) lines.add(row, text);
    write(text);
}

void Journal::begin(std::span<const std::size_t> ids)
{
    std::string line(begun_word);
    for (const std::size_t id : ids) line += fmt::format(" {}", id);
    write(line + "\n");
}

void Journal::mark_done()
{
    if (!std::exchange(done_, true)) write(done_line);
}

void Journal::write(std::string_view lines)
{
    const std::lock_guard lock(mutex_);
    for (std::size_t written = 0; written < lines.size();) {
        const ssize_t n = ::write(descriptor_, lines.data() + written, lines.size() - written);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0)
            refuse(file_, fmt::format("cannot be written: {}.", std::strerror(errno)), "space left on the disk",
                   "make room, then go on with --resume");
        written += static_cast<std::size_t>(n);
    }
}

std::filesystem::path journal_of(const std::filesystem::path& csv)
{
    std::filesystem::path file = csv;
    file += ".journal";
    return file;
}

} // namespace damslip
