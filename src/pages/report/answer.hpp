#pragma once

#include "core/csv.hpp"
#include "pages/report/page.hpp"

#include <string>
#include <vector>

/// What a command prints: an ordered list of items, of which some are the answer and the others are there to check it.
namespace damslip::pages {

inline constexpr std::size_t brief_lines = 25, brief_columns = 110; ///< of an answer in brief [lines, characters]

/// Which part of a table is the answer.
struct InBrief {
    /// Keys, in this order, those that the table does not have left out; "key=heading" where the table's own heading is long.
    std::vector<std::string> columns;
    std::string largest = {};         ///< key: where not all rows fit, those with the largest numbers stay; empty: the first
};

/// The output of one command, in full (--full) and in brief. Each item is added once; the answer in brief is made of the items marked for
/// it: headline, tables, sentences, then notes. It has at most brief_lines lines of brief_columns characters, numbers of at most four
/// digits, and lengths of one table in one unit. What has no room is counted in the last lines, which say where the rest is.
class Answer {
public:
    /// Text of the full output alone.
    Answer& operator+=(const std::string& text);
    /// The table with an empty line below it in full, nothing in brief.
    void add(const Table& table);
    /// A table that is part of the answer, if it has rows. @param text  in the full output; the other form: as add(table)
    void add(const Table& table, InBrief brief, std::string text);
    void add(const Table& table, InBrief brief);
    /// Sentence and verdict; first in brief.
    void headline(const Headline& headline);
    /// The same of an output that has none in full.
    void headline_in_brief(const Headline& headline) { headline_ = headline; }
    /// A line "name: sentence" of the answer in brief alone: what governs, what to look at. An empty name: the sentence.
    void point(const std::string& name, const std::string& sentence);
    /// "note: ..." in both; once in brief, however often it is added.
    void note(const std::string& note);
    /// A note that is on standard error in the full output.
    void note_in_brief(const std::string& note);
    /// The command that answers the next question; in brief alone.
    void next(const std::string& command);

    const std::string& full() const { return full_; }
    /// @param files  flags that write the rest: "--out DIR"; empty: none
    std::string brief(const std::string& files) const;
    /// Verdict and slip in one line of at most brief_columns characters.
    std::string line() const;

private:
    struct BriefTable {
        Table table; ///< with the columns of the answer
        std::size_t rows = 0;
        std::string largest;
    };
    struct Room {
        std::size_t rows, notes, note_lines, tables, point_lines;
    };
    std::string in_room(const Room& room, const std::string& files) const;

    std::string full_, next_;
    Headline headline_;
    std::vector<BriefTable> tables_;
    std::vector<std::string> points_, notes_;
};

} // namespace damslip::pages
