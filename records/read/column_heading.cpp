#include "records/read/column_heading.hpp"

#include "records/read/record_text.hpp"
#include "records/read/unit.hpp"

#include <array>

namespace damslip::records {

namespace {

/// Splits "name [unit]", "name (unit)", "name_unit" and "name unit".
ColumnHeading split(std::string_view heading)
{
    ColumnHeading out;
    const std::size_t open = heading.find_first_of("[(");
    if (open != std::string_view::npos && heading.size() > open + 1 &&
        (heading.back() == ']' || heading.back() == ')')) {
        out.name = trimmed(heading.substr(0, open));
        out.unit = std::string(trimmed(heading.substr(open + 1, heading.size() - open - 2)));
        return out;
    }
    static constexpr std::array<std::string_view, 9> suffixes{"_mm_s2", "_cm_s2", "_m_s2", "_gal", "_mg",
                                                              "_ms",    "_g",     "_s",    "_sec"};
    const std::string low = lower(heading);
    for (const std::string_view suffix : suffixes)
        if (low.size() > suffix.size() && low.ends_with(suffix)) {
            out.name = heading.substr(0, heading.size() - suffix.size());
            out.unit = std::string(suffix.substr(1));
            return out;
        }
    const std::size_t blank = heading.find_last_of(" \t");
    if (blank != std::string_view::npos && acceleration_unit(heading.substr(blank + 1))) {
        out.name = trimmed(heading.substr(0, blank));
        out.unit = std::string(heading.substr(blank + 1));
        return out;
    }
    out.name = heading;
    return out;
}

} // namespace

ColumnHeading read_heading(std::string_view heading)
{
    ColumnHeading out = split(trimmed(heading));
    const std::string name = lower(out.name);
    const std::string unit = out.unit ? lower(*out.unit) : "";
    const bool time_unit = unit.empty() || unit == "s" || unit == "sec" || unit == "ms";
    if ((name == "t" || name.starts_with("time")) && time_unit) {
        out.kind = ColumnKind::time;
        return out;
    }
    const bool motion = name.starts_with("vel") || name.starts_with("dis") || name.starts_with("slip");
    const bool named = name == "a" || name.starts_with("a_") || name.starts_with("acc") || contains(name, "accel");
    const bool by_unit = out.unit && acceleration_unit(*out.unit);
    if (!motion && (named || by_unit)) out.kind = ColumnKind::acceleration;
    return out;
}

} // namespace damslip::records
