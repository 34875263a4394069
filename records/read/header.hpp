#pragma once

#include "records/read/read_record.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
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

/// Which component of the motion a word names, in headers, headings and names of files.

enum class Component { none, horizontal, vertical }; ///< none: the words do not say

/// "UP", "U-D", "V", "HNZ", "vertical, sense unknown"; "90 DEG", "090", "N10E", "N-S", "HN1", "L1", "accel_ns": the first word, else the last
/// part of the words that names one. Codes of channels are those of SEED for accelerometers (band, N or L or G or H, orientation).
Component component_in(std::string_view words);

/// The same of one word without blanks and signs, in lower case: a part of a file's name. A number is none: names hold others, too.
Component component_in_part(std::string_view part);

/// "down", "DWN", "DN": a vertical component that is positive downwards.
bool is_downwards(std::string_view words);

/// A unit of acceleration: its name here and the factor to m/s^2.
struct AccelerationUnit {
    std::string_view name; ///< "g", "m/s2", "cm/s2", "gal", "mg", "mm/s2"
    double factor;         ///< 1 unit = factor m/s^2; "g" is 9.80665
};

/// The unit a text names, in any of its usual spellings ("M/S/S", "cm/sec^2", "m_s2", "m/s²"); nothing for others.
std::optional<AccelerationUnit> acceleration_unit(std::string_view text);

/// Takes the unit off the end of a heading: "[m/s2]" of "Sa(0.5s) [m/s2]", "_m_s2", " g". @param known  whether a text is a unit
/// @returns the unit as written; nothing, and the heading as it was, where there is none
std::optional<std::string> take_unit(std::string& heading, const std::function<bool(std::string_view)>& known);

/// The unit that a sentence names: "UNITS OF UNCOR ACCEL ARE SEC AND G/10.", "(UNITS: CM/SEC/SEC)", "in units of g.", "peak 20.1 mm/s/s at".
/// Where no word after these keys is a unit of acceleration: the first of those words, for a message.
std::optional<std::string> unit_in_words(std::string_view line);

/// For messages: "g, m/s2, cm/s2, gal, mg or mm/s2".
inline constexpr std::string_view known_units = "g, m/s2, cm/s2, gal, mg or mm/s2";

} // namespace damslip::records
