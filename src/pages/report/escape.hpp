#pragma once

#include "core/text.hpp"

#include <string>
#include <string_view>

namespace damslip::pages {

/// For text and double-quoted attributes of HTML and SVG: & < > " ' as entities, control characters other than tab and
/// newline left out.
std::string html_text(std::string_view text);

/// A JSON string, quoted; "<" as \u003c so that no text can end a <script>; bytes that are not UTF-8 as U+FFFD.
std::string json_text(std::string_view text);

} // namespace damslip::pages
