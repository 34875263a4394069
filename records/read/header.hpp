#pragma once

#include "records/read/record_text.hpp"

#include <optional>
#include <string>

namespace damslip::records {

/// A value and the line that states it.
template <class T>
struct Stated {
    T value;
    std::size_t line = 0;
};

/// What the comment lines "# key: value" of a text file say.
struct TextHeader {
    std::optional<Stated<std::string>> unit;    ///< "units", "unit": as written
    std::optional<Stated<double>> dt;           ///< "dt", "time step" [s]
    std::optional<Stated<std::size_t>> samples; ///< "n", "npts", "samples"
    std::string component;                      ///< "component", "channel"
    std::string name;                           ///< "name"
    std::string title; ///< "title", "event"; else the first comment line that is no "key: value" known here
};

/// A line that starts with # or %.
bool is_comment(std::string_view line);

/// Reads all comment lines. @throws InputError for a known key with an unreadable value, or stated twice with different
/// values.
TextHeader read_text_header(const RecordText& text);

} // namespace damslip::records
