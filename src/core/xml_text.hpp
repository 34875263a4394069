#pragma once

#include <string>
#include <string_view>

namespace damslip {

/// For text and double-quoted attributes of XML: & < > " as entities; control characters other than tab and newline, which XML does not allow, as
/// their pictures (U+2400 ... U+2421: "␛").
std::string xml_text(std::string_view text);

} // namespace damslip
