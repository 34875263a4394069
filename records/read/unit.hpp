#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace damslip::records {

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
