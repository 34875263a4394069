#pragma once

#include <optional>
#include <string>
#include <vector>

namespace damslip::pages {

/// Appends a number as JSON with so many significant digits; NaN and infinity as null.
void add_json_number(std::string& out, double value, int digits = 6);

std::string json_number(const std::optional<double>& value, int digits = 6); ///< nothing: null
std::string json_numbers(const std::vector<double>& values, int digits = 6); ///< as an array

} // namespace damslip::pages
