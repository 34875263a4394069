#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace damslip::records {

enum class ColumnKind { time, acceleration, other };

/// What a heading such as "time_s", "acc [cm/s2]", "a_h (g)", "NS" says.
struct ColumnHeading {
    ColumnKind kind = ColumnKind::other; ///< `other`: velocity, displacement, or a name without a unit of acceleration
    std::string name;                    ///< without the unit
    std::optional<std::string> unit;     ///< as written; time: "s" or "ms"
};

ColumnHeading read_heading(std::string_view heading);

} // namespace damslip::records
