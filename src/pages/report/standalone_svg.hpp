#pragma once

#include <string>

namespace damslip::pages {

/// A drawing of the report as a file of its own: the page's colours of drawings go with it, on white paper.
/// @param svg  an <svg> element as Sketch::svg gives it
std::string standalone_svg(const std::string& svg);

} // namespace damslip::pages
