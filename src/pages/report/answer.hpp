#pragma once

#include "core/csv.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace damslip::pages {

/// For text and double-quoted attributes of HTML and SVG: & < > " ' as entities, control characters other than tab and
/// newline left out.
std::string html_text(std::string_view text);

/// A JSON string, quoted; "<" as \u003c so that no text can end a <script>; bytes that are not UTF-8 as U+FFFD.
std::string json_text(std::string_view text);

/// Table rows as a JSON array of objects, by column key, for a command's --json object; nothing and non-finite numbers are null.
nlohmann::ordered_json json_of(const Table& table);

/// {"schema": "damslip.<what>/1", "program": {...}}: how each --json object begins.
nlohmann::ordered_json json_header(const std::string& what);

/// Appends a number as JSON with so many significant digits; NaN and infinity as null.
void add_json_number(std::string& out, double value, int digits = 6);

std::string json_number(const std::optional<double>& value, int digits = 6); ///< nothing: null
std::string json_numbers(const std::vector<double>& values, int digits = 6); ///< as an array

/// An array of the JSON texts that `one` makes of the items.
template <class Items, class One>
std::string json_list(Items&& items, One&& one)
{
    std::string out = "[";
    for (const auto& item : items) out += (out.size() > 1 ? "," : "") + one(item);
    return out + "]";
}

inline constexpr std::size_t brief_lines = 25, brief_columns = 110; ///< of an answer in brief [lines, characters]

/// Where a table of an answer stands.
struct Places {
    bool text = true;    ///< in the full output
    bool brief = false;  ///< in the answer in brief, with the columns that are marked for it
    bool data = true;    ///< in the JSON object and in Python
    std::string file = {};  ///< CSV among the files of --out: "displacements.csv"; empty: none
    std::size_t turned = 0; ///< in the full output by columns, so many lines of headings; 0: by rows
};

/// The output of one command: an ordered list of items, each added once, for terminal, JSON object, CSV files and Python.
///
/// The full output (--full) has all tables and sentences in their order, an empty line between tables. The answer in brief is made of
/// headline, columns marked for it (Column::brief), points and notes. It has at most brief_lines lines of brief_columns characters,
/// numbers of at most four digits, and lengths of one table in one unit. What has no room is counted in the last lines, which say
/// where the rest is.
class Answer {
public:
    /// @param header  begins the JSON object
    explicit Answer(nlohmann::ordered_json header);

    /// Text of the full output alone.
    Answer& operator+=(const std::string& text);
    /// A table; where it has no rows it is in the data alone. @param id  its key in JSON and Python
    void add(const std::string& id, Table table, Places places = {});
    /// A value of the JSON object alone.
    void set(const std::string& id, nlohmann::ordered_json value);
    /// Sentence and verdict; first in brief.
    void headline(const Headline& headline);
    /// The same of an output that has none in full.
    void headline_in_brief(const Headline& headline) { headline_ = headline; }
    /// A line "name: sentence" of the answer in brief alone: what governs, what to look at. An empty name: the sentence.
    void point(const std::string& name, const std::string& sentence);
    /// "note: ..." in both; once in brief, however often it is added.
    void note(const std::string& note);
    /// All of them, and their list as a value of the JSON object.
    void notes(const std::string& id, const std::vector<std::string>& notes);
    /// A note that is on standard error in the full output.
    void note_in_brief(const std::string& note);
    /// The command that answers the next question; in brief alone.
    void next(const std::string& command);

    const std::string& full() const { return full_; }
    nlohmann::ordered_json json() const;
    std::vector<std::pair<std::string, Table>> tables() const; ///< of the data, by id
    /// summary.json, and the tables that have a file. @param comments  of each CSV
    void write(const std::filesystem::path& folder, const std::vector<std::string>& comments) const;
    /// @param files  flags that write the rest: "--out DIR"; empty: none
    std::string brief(const std::string& files) const;
    /// Verdict and slip in one line of at most brief_columns characters.
    std::string line() const;

private:
    struct Room {
        std::size_t rows, notes, note_lines, tables, point_lines;
    };
    std::string in_room(const Room& room, const std::string& files) const;

    std::string full_, next_;
    Headline headline_;
    using Value = std::shared_ptr<const nlohmann::ordered_json>;
    Value header_;                                                        ///< of the JSON object
    std::vector<std::pair<std::string, std::variant<Table, Value>>> data_; ///< by id
    std::vector<std::pair<std::string, Table>> files_;                    ///< by name
    std::vector<Table> tables_; ///< of the answer in brief, with its columns alone
    std::vector<std::string> points_, notes_;
};

} // namespace damslip::pages
