#pragma once

#include "scene/key_table.hpp"

#include <span>
#include <string_view>

/// Ranges of real dams: what a number of the scene usually is, and who says so. They are rounded outward from what the source
/// gives, so that a value outside is worth a second look, not wrong.
namespace damslip {

/// Puts the usual range beside each number of the table. Every number has one, or a reason for having none (no_usual_range).
void add_usual_ranges(std::vector<KeyGroup>& groups);

/// A number without a usual range.
struct NoUsualRange {
    std::string_view key;    ///< "force.x"
    std::string_view reason; ///< "a place"
};
std::span<const NoUsualRange> no_usual_range();

/// What a short source of Usual::source stands for.
struct UsualSource {
    std::string_view name; ///< as in Usual::source, where several are parted by "; "
    std::string_view full; ///< author, year, title, number
};
std::span<const UsualSource> usual_sources();

} // namespace damslip
