#pragma once

#include "records/read/record_text.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip::records {

/// A value and the line that states it.
template <class T>
struct Stated {
    T value;
    std::size_t line = 0;
};

/// What the labelled lines of a text file say: comment lines "# key: value", and lines of words above the numbers, "Label : value",
/// "label = value", or a known label and a number. The labels: `labels` in header.cpp.
struct TextHeader {
    std::optional<Stated<std::string>> unit;    ///< as written; of a sentence the word ("Acceleration in units of g")
    std::optional<Stated<double>> dt;           ///< [s]
    std::optional<Stated<std::size_t>> samples; ///< of each component
    std::optional<Stated<double>> peak;         ///< where its label names the unit [m/s^2]
    std::optional<Stated<std::string>> columns; ///< the names of the columns, in their order
    std::string component;
    std::string name;
    std::string title; ///< "title", "event"; else the first comment line that is no "key: value" known here
    std::vector<std::size_t> understood; ///< lines of words that said one of these
};

/// A line that starts with # or %.
bool is_comment(std::string_view line);

/// Reads all comment lines, and the lines of words above `first_number_line`. @throws InputError for a known key of a comment with an
/// unreadable value, or stated twice with different values.
TextHeader read_text_header(const RecordText& text, std::size_t first_number_line);

} // namespace damslip::records
