#pragma once

#include "core/csv.hpp"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
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

} // namespace damslip::pages
