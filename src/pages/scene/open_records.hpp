#pragma once

#include <cstddef>

namespace damslip::pages {

/// Sections of records that a report shows unfolded.
inline constexpr std::size_t open_records = 3;

} // namespace damslip::pages
