#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace damslip::fe2d {

/// The lines of a Gmsh file one after the other; blank ones are passed over.
class GmshLines {
public:
    GmshLines(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

    /// Goes to the next line. @returns false at the end of the file
    bool next();
    /// Goes to the next line. @throws InputError at the end of the file, naming the section that is cut off
    void need(const std::string& section);

    std::string_view line() const { return line_; } ///< without blanks at its ends
    int number() const { return number_; }          ///< from 1
    const std::string& file() const { return file_; }

    /// @throws InputError at the current line
    [[noreturn]] void refuse(std::string problem, std::string expected, std::string fix) const;

private:
    std::string_view rest_, line_;
    std::string file_;
    int number_ = 0;
};

/// The words of the current line, taken from the left. `what` names the entry in messages: "node tag".
class GmshWords {
public:
    explicit GmshWords(const GmshLines& lines) : lines_(lines), rest_(lines.line()) {}

    std::int64_t whole(const char* what, std::int64_t low, std::int64_t high);
    double number(const char* what);      ///< finite
    std::string quoted(const char* what); ///< "text in quotes"
    void end() const;                     ///< @throws InputError where words are left

private:
    std::string_view word(const char* what);
    const GmshLines& lines_;
    std::string_view rest_;
};

} // namespace damslip::fe2d
