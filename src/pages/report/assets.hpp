#pragma once

#include <string_view>

/// Script and style that every page carries, embedded at build (assets.S).
namespace damslip::pages {

std::string_view uplot_script(); ///< uPlot 1.6.32 (MIT), minified; readable twin and checksums: vendor/uplot
std::string_view uplot_style();
std::string_view uplot_license(); ///< goes with every copy of the two
std::string_view page_script();   ///< page.js
std::string_view state_map_script();
std::string_view mesh_view_script();
std::string_view page_style(); ///< page.css

} // namespace damslip::pages
