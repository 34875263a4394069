#pragma once

#include "pages/report/page.hpp"

namespace damslip::pages {

/// The page as one HTML file that needs nothing else: style, script and data inside, no reference to any network.
/// The same page gives the same bytes.
std::string page_html(const Page& page);

} // namespace damslip::pages
