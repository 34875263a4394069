#include "analysis/sweep/result_store.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>
#include <utility>

namespace damslip {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t application = 0x64616d73, format = 7; ///< application_id and user_version of the file
constexpr const char* as_written = "a file as it was written";

/// A text of a row and its column; empty: none.
struct RowText {
    const char* column;
    std::string (*get)(const FinishedRow& row);
    void (*set)(FinishedRow& row, const std::string& text); ///< @throws nlohmann::json::exception
};

constexpr std::array<RowText, 4> row_texts = {
    {{"status", [](const FinishedRow& row) { return row.results.status; },
      [](FinishedRow& row, const std::string& text) { row.results.status = text; }},
     {"event_slips_m",
      [](const FinishedRow& row) {
          return row.results.event_slips.empty() ? "" : nlohmann::json(row.results.event_slips).dump();
      },
      [](FinishedRow& row, const std::string& text) {
          row.results.event_slips = nlohmann::json::parse(text).get<std::vector<double>>();
      }},
     {"anchors",
      [](const FinishedRow& row) {
          if (row.results.anchors.empty()) return std::string();
          nlohmann::ordered_json list;
          for (const RowAnchor& a : row.results.anchors)
              list.push_back({{"name", a.name}, {"largest_force_N_m", a.largest_force}, {"state", a.state}});
          return list.dump();
      },
      [](FinishedRow& row, const std::string& text) {
          for (const nlohmann::json& a : nlohmann::json::parse(text))
              row.results.anchors.push_back({a.at("name"), a.at("largest_force_N_m"), a.at("state")});
      }},
     {"history",
      [](const FinishedRow& row) {
          const SlipHistory& h = row.history;
          return h.interval > 0.0 ? nlohmann::ordered_json{{"interval_s", h.interval}, {"slip_m", h.slip}}.dump() : "";
      },
      [](FinishedRow& row, const std::string& text) {
          const auto json = nlohmann::json::parse(text);
          row.history = {json.at("interval_s"), json.at("slip_m")};
      }}}};

constexpr std::size_t value_columns = row_numbers.size() + row_texts.size(); ///< between id and checksum

const char* column_name(std::size_t i)
{
    return i < row_numbers.size() ? row_numbers[i].column : row_texts[i - row_numbers.size()].column;
}

/// ", slip_m, ..., history"
std::string all_columns()
{
    std::string list;
    for (std::size_t i = 0; i < value_columns; ++i) list += fmt::format(", {}", column_name(i));
    return list;
}

/// SQLite keeps no NaN.
bool has(const std::optional<double>& number)
{
    return number && !std::isnan(*number);
}

/// A step takes different numbers to different ones, so damage within one word is always found; the shift brings high
/// bits down, without which damage of two words could cancel out.
class Checksum {
public:
    void add(std::uint64_t word)
    {
        hash_ = (hash_ ^ word) * 0x9e3779b97f4a7c15u;
        hash_ ^= hash_ >> 32;
    }
    void add(std::string_view text)
    {
        add(text.size());
        for (; !text.empty(); text.remove_prefix(std::min(text.size(), sizeof(std::uint64_t)))) {
            std::uint64_t word = 0;
            std::memcpy(&word, text.data(), std::min(text.size(), sizeof word));
            add(word);
        }
    }
    std::int64_t value() const { return static_cast<std::int64_t>(hash_); }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

using Texts = std::array<std::string, row_texts.size()>;

std::int64_t checksum_of(const FinishedRow& row, const Texts& texts)
{
    Checksum sum;
    sum.add(row.id);
    for (std::size_t i = 0; i < value_columns; ++i) {
        if (i >= row_numbers.size() ? texts[i - row_numbers.size()].empty() : !has(row.results.*row_numbers[i].value))
            continue;
        sum.add(i);
        if (i < row_numbers.size())
            sum.add(std::bit_cast<std::uint64_t>(*(row.results.*row_numbers[i].value)));
        else
            sum.add(texts[i - row_numbers.size()]);
    }
    return sum.value();
}

/// What the table `sweep` has of a sweep, its part and its axes, by column.
using Head = std::vector<std::pair<const char*, std::string>>;

Head head_of(const SweepIdentity& i, const Shard& shard, const std::string& axes)
{
    return {{"version", i.version},
            {"scene", i.scene},
            {"records", i.records},
            {"grid", i.grid},
            {"rows", std::to_string(i.rows)},
            {"part", fmt::format("{}/{}", shard.index, shard.count)},
            {"axes", axes}};
}

std::int64_t checksum_of(const Head& head)
{
    Checksum sum;
    for (const auto& [name, value] : head) sum.add(value);
    return sum.value();
}

/// What differs between two heads, in words: "scene (other contents); version (1.1 now, 1.0 there)".
std::string differences(const Head& mine, const Head& theirs)
{
    std::string words;
    for (std::size_t i = 0; i < mine.size(); ++i) {
        const std::string name = mine[i].first;
        if (mine[i].second == theirs[i].second) continue;
        words += (words.empty() ? "" : "; ") + name;
        words += name == "scene" || name == "records"
                     ? " (other contents)"
                     : fmt::format(" ({} now, {} there)", mine[i].second, theirs[i].second);
    }
    return words;
}

[[noreturn]] void not_a_store(const fs::path& file)
{
    refuse(file, "this is not a database of a sweep of this version.",
           "a database NAME.sqlite that this version wrote, or a part NAME.i-of-n.sqlite",
           "choose another file; to begin again delete this one");
}

/// Journals of the text format before: nobody wants those rows computed again unasked.
void refuse_old_journal(fs::path file)
{
    const std::string now = file.filename().string();
    for (const char* ending : {".csv.journal", ".json.journal"})
        if (fs::exists(file.replace_extension().concat(ending)))
            refuse(
                file, "this journal is of an earlier version, and is not read any more.", "a database " + now,
                "finish the sweep with the version that began it, or delete the journal: its rows are computed again");
}

} // namespace

/// An open database, of this process alone: no lock but the file's own is needed, and network drives do.
/// @throws InputError, naming the file
class Database {
public:
    Database(const fs::path& path, int flags) : file(path)
    {
        if (fs::exists(file) && !fs::is_regular_file(file)) not_a_store(file);
        const int code = sqlite3_open_v2(file.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX, nullptr);
        handle_.reset(handle);
        check(code);
        run("PRAGMA locking_mode = EXCLUSIVE; PRAGMA page_size = 8192");
    }

    void check(int code) const
    {
        if (code == SQLITE_OK) return;
        const std::string why = sqlite3_errmsg(handle);
        if (code = sqlite3_errcode(handle) & 0xff; code == SQLITE_NOTADB) not_a_store(file);
        if (code == SQLITE_BUSY)
            refuse(file, "another process has this database open.", "one process for each --out",
                   "wait for it, or end it, or choose another --out");
        if (code == SQLITE_CORRUPT)
            refuse(file, fmt::format("this database is damaged: {}.", why), as_written, "delete it to begin again");
        if (code == SQLITE_CONSTRAINT)
            refuse(file, "a row is in two parts.", "each row in one part", "run the parts again");
        refuse(file, fmt::format("cannot be written: {}.", why), "write permission and space left on the disk",
               "make room, or choose another --out; what is finished stays for --resume");
    }
    void run(const std::string& statements) const
    {
        check(sqlite3_exec(handle, statements.c_str(), nullptr, nullptr, nullptr));
    }

    const fs::path file;
    sqlite3* handle = nullptr;

private:
    struct Close {
        void operator()(sqlite3* open) const { sqlite3_close(open); }
    };
    std::unique_ptr<sqlite3, Close> handle_;
};

namespace {

/// A statement, its values bound one after the other; texts have to live until it is run.
class Statement {
public:
    Statement(const Database& database, const std::string& text) : database_(database)
    {
        sqlite3_stmt* made = nullptr;
        const int code = sqlite3_prepare_v2(database.handle, text.c_str(), -1, &made, nullptr);
        statement_.reset(made);
        database.check(code);
    }

    void bind(double number) { sqlite3_bind_double(statement_.get(), ++bound_, number); }
    void bind(std::int64_t number) { sqlite3_bind_int64(statement_.get(), ++bound_, number); }
    void bind(std::size_t number) { bind(static_cast<std::int64_t>(number)); }
    void bind(const std::string& text)
    {
        sqlite3_bind_text(statement_.get(), ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_STATIC);
    }
    void bind_none() { sqlite3_bind_null(statement_.get(), ++bound_); }

    /// To the next row of the answer. @returns false: there is none; values can be bound anew
    bool next()
    {
        if (sqlite3_step(statement_.get()) == SQLITE_ROW) return true;
        bound_ = 0;
        database_.check(sqlite3_reset(statement_.get())); // the code of what went wrong
        return false;
    }
    template <class... Values>
    Statement& run(const Values&... values)
    {
        (bind(values), ...);
        next();
        return *this;
    }

    bool has_number(std::size_t i) const
    {
        return sqlite3_column_type(statement_.get(), static_cast<int>(i)) == SQLITE_FLOAT;
    }
    double number(std::size_t i) const { return sqlite3_column_double(statement_.get(), static_cast<int>(i)); }
    std::int64_t integer(std::size_t i) const { return sqlite3_column_int64(statement_.get(), static_cast<int>(i)); }
    std::string text(std::size_t i) const
    {
        const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), static_cast<int>(i)));
        return {text ? text : "",
                static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), static_cast<int>(i)))};
    }

private:
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
    };
    const Database& database_;
    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
    int bound_ = 0;
};

std::int64_t integer(const Database& database, const std::string& question)
{
    return Statement(database, question).run().integer(0);
}

/// The row that a statement with all columns is at; none for one that is not as it was written.
std::optional<FinishedRow> row_of(const Statement& columns)
{
    FinishedRow row;
    row.id = static_cast<std::size_t>(columns.integer(0));
    Texts texts;
    for (std::size_t i = 0; i < row_numbers.size(); ++i)
        if (columns.has_number(i + 1)) row.results.*row_numbers[i].value = columns.number(i + 1);
    for (std::size_t i = 0; i < texts.size(); ++i) texts[i] = columns.text(row_numbers.size() + i + 1);
    if (columns.integer(value_columns + 1) != checksum_of(row, texts)) return std::nullopt;
    try {
        for (std::size_t i = 0; i < texts.size(); ++i)
            if (!texts[i].empty()) row_texts[i].set(row, texts[i]);
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
    const std::optional<Status> status = status_of_word(row.results.status);
    row.good = !status || is_answer(*status); // others are remarks: the method does not apply
    return row;
}

} // namespace

/// Writes rows, many by one statement: half the time of one by one. Columns that no row has had are left out.
class RowInserter {
public:
    explicit RowInserter(const Database& database) : database_(database) {}

    /// @param rows  by id: others make the file half as large again
    void insert(std::span<const FinishedRow* const> rows)
    {
        constexpr std::size_t most = 64;
        for (std::size_t first = 0; first < rows.size(); first += most)
            insert_together(rows.subspan(first, std::min(most, rows.size() - first)));
    }

private:
    void insert_together(std::span<const FinishedRow* const> rows)
    {
        if (!statement_ || rows.size() != together_) prepare(rows.size());
        texts_.resize(rows.size());
        for (std::size_t k = 0; k < rows.size(); ++k)
            if (!bind(*rows[k], texts_[k])) return insert_together(rows); // with one more column
        statement_->run();
    }
    void prepare(std::size_t rows)
    {
        std::string names, marks;
        for (std::size_t i = 0; i < value_columns; ++i) {
            names += used_[i] ? fmt::format("{}, ", column_name(i)) : "";
            marks += used_[i] ? "?," : "";
        }
        std::string text = fmt::format("INSERT OR REPLACE INTO rows(id, {}checksum) VALUES", names);
        for (std::size_t k = 0; k < rows; ++k) text += fmt::format("{}(?,{}?)", k ? "," : "", marks);
        statement_.emplace(database_, text);
        together_ = rows;
    }
    /// @returns false: it has a value of a column that the statement has not; the next one has
    bool bind(const FinishedRow& row, Texts& texts)
    {
        statement_->bind(row.id);
        for (std::size_t i = 0; i < value_columns; ++i) {
            const bool is_number = i < row_numbers.size();
            const std::optional<double>* number = is_number ? &(row.results.*row_numbers[i].value) : nullptr;
            std::string* text = is_number ? nullptr : &texts[i - row_numbers.size()];
            if (text) *text = row_texts[i - row_numbers.size()].get(row);
            const bool there = number ? has(*number) : !text->empty();
            if (there && !used_[i]) {
                used_[i] = true;
                statement_.reset();
                return false;
            }
            if (!used_[i]) continue;
            if (!there)
                statement_->bind_none();
            else if (number)
                statement_->bind(**number);
            else
                statement_->bind(*text);
        }
        statement_->bind(checksum_of(row, texts));
        return true;
    }

    const Database& database_;
    std::optional<Statement> statement_;
    std::array<bool, value_columns> used_{}; ///< columns that any row had
    std::size_t together_ = 0;
    std::vector<Texts> texts_;
};

ResultStore::ResultStore(const fs::path& file, const SweepIdentity& identity, const Shard& shard, StoreStart start)
{
    if (start == StoreStart::resume && !fs::exists(file)) refuse_old_journal(file);
    if (!file.parent_path().empty()) make_folder(file.parent_path());
    open(file, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    const bool empty = integer(*database_, "SELECT count(*) FROM sqlite_schema") == 0;
    if (!empty) check_format();
    database_->run("PRAGMA synchronous = OFF; BEGIN IMMEDIATE"); // for processes that end, not for power that fails
    if (empty || (start == StoreStart::fresh &&
                  integer(*database_, "SELECT done OR NOT EXISTS (SELECT 1 FROM rows) FROM sweep") != 0)) {
        create(identity, shard);
    } else {
        read_head();
        const Head mine = head_of(identity, shard, axes_), theirs = head_of(identity_, shard_, axes_);
        if (mine != theirs)
            refuse(file, "this database belongs to a sweep of other inputs: " + differences(mine, theirs) + ".",
                   "the database of the same scene, records, grid, part and version",
                   "choose another --out, or delete this file to begin again");
        read_rows();
        if (start == StoreStart::fresh)
            refuse(file, fmt::format("{} rows of this sweep are finished here.", finished_),
                   "--resume to go on, or another --out", "add  --resume ; to begin again delete this file");
        Statement remove(*database_, "DELETE FROM rows WHERE id = ?");
        for (const std::int64_t id : damaged_) remove.run(id);
    }
    database_->run("COMMIT");
}

ResultStore::ResultStore(const fs::path& file)
{
    if (!fs::exists(file)) refuse(file, "there is no such file.", "a part of a sweep", "check the path");
    open(file, SQLITE_OPEN_READWRITE);
    check_format();
    read_head();
    read_rows();
}

ResultStore::~ResultStore()
{
    try {
        flush();
    } catch (const InputError&) { // an append() before it has said so
    }
}

const fs::path& ResultStore::file() const
{
    return database_->file;
}

void ResultStore::open(const fs::path& file, int flags)
{
    database_ = std::make_unique<Database>(file, flags);
    inserter_ = std::make_unique<RowInserter>(*database_);
}

void ResultStore::check_format() const
{
    if (integer(*database_, "PRAGMA application_id") != application ||
        integer(*database_, "PRAGMA user_version") != format)
        not_a_store(file());
}

void ResultStore::create(const SweepIdentity& identity, const Shard& shard)
{
    database_->run(fmt::format(R"(
DROP VIEW IF EXISTS results;
DROP TABLE IF EXISTS sweep; DROP TABLE IF EXISTS rows; DROP TABLE IF EXISTS axis; DROP TABLE IF EXISTS begun;
CREATE TABLE sweep(version, scene, records, grid, rows, part, axes, checksum, done);
CREATE TABLE rows(id INTEGER PRIMARY KEY{}, checksum);
CREATE TABLE axis(axis, place INTEGER, value, PRIMARY KEY(axis, place)) WITHOUT ROWID;
CREATE TABLE begun(id INTEGER PRIMARY KEY, times);
PRAGMA application_id = {}; PRAGMA user_version = {})",
                               all_columns(), application, format));
    identity_ = identity;
    shard_ = shard;
    write_head();
}

void ResultStore::write_head() const
{
    const Head head = head_of(identity_, shard_, axes_);
    database_->run("DELETE FROM sweep");
    Statement insert(*database_, "INSERT INTO sweep VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)");
    for (const auto& [name, value] : head) insert.bind(value);
    insert.run(checksum_of(head), std::int64_t{done_});
}

void ResultStore::read_head()
{
    Statement columns(*database_, "SELECT * FROM sweep");
    Head head = head_of({}, {}, "");
    const bool found = columns.next();
    for (std::size_t i = 0; i < head.size(); ++i) head[i].second = columns.text(i);
    if (!found || columns.integer(head.size()) != checksum_of(head))
        refuse(file(), "this database is damaged: what it belongs to cannot be read.", as_written,
               "delete it to begin again");
    identity_ = {columns.text(0), columns.text(1), columns.text(2), columns.text(3), std::stoull(columns.text(4))};
    shard_ = parse_shard(columns.text(5), "part");
    axes_ = columns.text(6);
    done_ = columns.integer(head.size() + 1) != 0;
}

void ResultStore::read_rows()
{
    if (const std::string word = Statement(*database_, "PRAGMA quick_check(1)").run().text(0); word != "ok")
        refuse(file(), fmt::format("this database is damaged: {}.", word), as_written, "delete it to begin again");
    Statement columns(*database_, "SELECT * FROM rows");
    while (columns.next())
        if (row_of(columns))
            ++finished_;
        else
            damaged_.push_back(columns.integer(0));
    Statement begun(*database_, "SELECT id, times FROM begun WHERE id NOT IN (SELECT id FROM rows)");
    while (begun.next()) stopped_[static_cast<std::size_t>(begun.integer(0))] = static_cast<int>(begun.integer(1));
}

std::vector<FinishedRow> ResultStore::rows(std::size_t first, std::size_t last) const
{
    const std::lock_guard lock(database_mutex_);
    std::vector<FinishedRow> found;
    Statement columns(*database_, "SELECT * FROM rows WHERE id BETWEEN ? AND ? ORDER BY id");
    columns.bind(first);
    columns.bind(last);
    while (columns.next()) {
        std::optional<FinishedRow> row = row_of(columns);
        if (!row)
            refuse(file(), fmt::format("row {} is damaged.", columns.integer(0)), "a file that nobody else writes",
                   "go on with --resume");
        found.push_back(std::move(*row));
    }
    return found;
}

void ResultStore::begin(std::span<const std::size_t> ids)
{
    flush();
    const std::lock_guard lock(database_mutex_);
    database_->run("BEGIN");
    Statement count(*database_, "INSERT INTO begun VALUES(?, 1) ON CONFLICT(id) DO UPDATE SET times = times + 1");
    for (const std::size_t id : ids) count.run(id);
    database_->run("COMMIT");
}

void ResultStore::append(std::span<const FinishedRow> rows)
{
    constexpr std::size_t most_waiting = 1024;
    constexpr std::chrono::milliseconds longest_wait(100);
    {
        const std::lock_guard lock(waiting_mutex_);
        if (waiting_.size() + rows.size() < most_waiting &&
            std::chrono::steady_clock::now() - written_ < longest_wait) {
            waiting_.insert(waiting_.end(), rows.begin(), rows.end());
            return;
        }
    }
    write(rows);
}

void ResultStore::flush()
{
    write({});
}

void ResultStore::write(std::span<const FinishedRow> rows)
{
    const std::lock_guard lock(database_mutex_);
    std::vector<FinishedRow> waiting;
    {
        const std::lock_guard lock_waiting(waiting_mutex_);
        waiting.swap(waiting_);
        written_ = std::chrono::steady_clock::now();
    }
    std::vector<const FinishedRow*> all;
    for (const FinishedRow& row : waiting) all.push_back(&row);
    for (const FinishedRow& row : rows) all.push_back(&row);
    if (all.empty()) return;
    std::sort(all.begin(), all.end(), [](const FinishedRow* a, const FinishedRow* b) { return a->id < b->id; });
    database_->run("BEGIN");
    inserter_->insert(all);
    database_->run("COMMIT");
}

void ResultStore::describe(const std::string& axes)
{
    const auto all = nlohmann::ordered_json::parse(axes);
    std::string columns;
    for (const auto& [name, axis] : all.items())
        if (axis["every"] != 0 && !axis["values"].empty())
            columns += fmt::format(", (SELECT value FROM axis WHERE axis = '{0}' AND place = id / {1} % {2}) AS {0}",
                                   name, axis["every"].get<std::size_t>(), axis["values"].size());
    axes_ = axes;
    database_->run("BEGIN");
    write_head();
    database_->run(fmt::format(R"(
DELETE FROM axis;
INSERT INTO axis SELECT a.key, v.key, v.atom FROM sweep, json_each(axes) a, json_each(a.value, '$.values') v;
DROP VIEW IF EXISTS results; CREATE VIEW results AS SELECT id{}{} FROM rows; COMMIT)",
                               columns, all_columns()));
}

void ResultStore::take(const fs::path& part)
{
    Statement(*database_, "ATTACH ? AS part").run(part.string());
    database_->run("BEGIN; INSERT INTO rows SELECT * FROM part.rows; COMMIT; DETACH part");
}

void ResultStore::mark_done()
{
    flush();
    done_ = true;
    database_->run("BEGIN");
    write_head();
    database_->run("COMMIT");
}

fs::path store_of(const fs::path& csv, const std::optional<Shard>& shard)
{
    const std::string part = shard ? fmt::format(".{}-of-{}", shard->index, shard->count) : "";
    return csv.parent_path() / (csv.stem().string() + part + ".sqlite");
}

} // namespace damslip
