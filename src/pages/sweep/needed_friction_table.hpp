#pragma once

#include "pages/sweep/sweep_rows_view.hpp"

namespace damslip::pages {

/// The friction from which on no slip of a sweep is above the allowable one, of one variant by one method.
struct NeededFriction {
    std::string variant, method;
    std::optional<double> more;    ///< highest friction of the grid that slips more; none: all hold
    std::optional<double> holds;   ///< the next one; none: even the highest slips more
    std::optional<double> between; ///< where the slip, linear in friction between the two, is the allowable one
    std::string record;            ///< that slips most at `more`
    std::optional<int> polarity;   ///< of that record

    /// Between the two; none where the grid does not bracket it.
    std::optional<double> friction() const { return !more || !holds ? std::nullopt : between ? between : holds; }
};

/// For every variant and method, between the two frictions of the grid that bracket it. Empty where there is no allowable slip or
/// only one friction. An FE slip counts with its error of the step added; a row without a slip, or without an answer, slips
/// more than any. @param allowable  [m]
std::vector<NeededFriction> needed_frictions(const SweepView& view, const std::optional<double>& allowable);

/// The same as a table.
Table needed_friction_table(const SweepView& view, const std::optional<double>& allowable);

} // namespace damslip::pages
