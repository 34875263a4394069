#pragma once

#include <cstddef>

namespace damslip::cli {

/// Sections of records that a report shows unfolded.
inline constexpr std::size_t open_records = 3;

} // namespace damslip::cli
