#pragma once

#include "analysis/sweep/slip_history.hpp"
#include "pages/report/chart.hpp"
#include "pages/sweep/sweep_rows_view.hpp"

/// Charts of a sweep. Slips are the largest on the way; of the polarities of a record the worse counts.
namespace damslip::pages {

/// Slip over friction of one variant, a curve for each method: the largest of up to three records, of more the median, with
/// a band from the least to the largest of the main method. Where the dam does not stand without an earthquake there is no
/// value, and a line marks the critical friction.
Chart slip_over_friction(const SweepView& view, std::size_t variant, const std::optional<double>& allowable);

/// Slip over time of one variant and method under the first record and polarity, a curve for each friction (of more than
/// eight every n-th); nothing where there is no history.
/// @param histories  of the view's rows, in their order
std::optional<Chart> slip_histories(const SweepView& view, std::size_t variant, const std::string& method,
                                    const std::vector<SlipHistory>& histories);

/// A history as a curve [s, mm].
Curve history_curve(const std::string& name, const SlipHistory& history);

/// The method a reader looks at first: FE, else the rigid block with the vertical component.
std::string main_method(const SweepView& view);

/// The same of one method, a curve for each of the first eight variants.
Chart slip_by_variant(const SweepView& view, const std::string& method, const std::optional<double>& allowable);

/// Slip of every row over a_y/PGA.
Chart slip_over_yield_ratio(const SweepView& view);

/// FE slip over the rigid block's, with the vertical component where both have it; nothing without both methods.
std::optional<Chart> fe_over_rigid(const SweepView& view);

/// Yield acceleration over friction of the variants.
Chart yield_over_friction(const SweepView& view);

} // namespace damslip::pages
