#pragma once

#include <sstream>
#include <string>

namespace damslip {

/// A text with each run of blanks and line ends as one blank: sentences of the terminal break at its width.
inline std::string without_breaks(const std::string& text)
{
    std::istringstream words(text);
    std::string all;
    for (std::string word; words >> word;) all += (all.empty() ? "" : " ") + word;
    return all;
}

} // namespace damslip
