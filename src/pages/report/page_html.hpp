#pragma once

#include "pages/report/page.hpp"

namespace damslip::pages {

/// The page as one HTML file that needs nothing else: style, script and data inside, no reference to any network.
/// The same page gives the same bytes.
std::string page_html(const Page& page);

/// The table with its title and notes as HTML; numbers right-aligned with the column's digits, PASS / FAIL marked.
/// @param section  title of the section it stands in; a table of the same title shows it only once
std::string table_html(const TablePart& part, const std::string& section = "");

} // namespace damslip::pages
