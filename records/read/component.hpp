#pragma once

#include <string_view>

/// Which component of the motion a word names, in headers, headings and names of files.
namespace damslip::records {

enum class Component { none, horizontal, vertical }; ///< none: the words do not say

/// "UP", "U-D", "V", "HNZ", "vertical, sense unknown"; "90 DEG", "090", "N10E", "N-S", "HN1", "L1", "accel_ns": the first word, else the last
/// part of the words that names one. Codes of channels are those of SEED for accelerometers (band, N or L or G or H, orientation).
Component component_in(std::string_view words);

/// The same of one word without blanks and signs, in lower case: a part of a file's name. A number is none: names hold others, too.
Component component_in_part(std::string_view part);

/// "down", "DWN", "DN": a vertical component that is positive downwards.
bool is_downwards(std::string_view words);

} // namespace damslip::records
