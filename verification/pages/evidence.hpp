#pragma once

#include "core/csv.hpp"
#include "verification/external/external.hpp"

#include <string>
#include <vector>

/// What `verify --external` found, as tables, a page and a scatter plot.
namespace damslip::pages {

struct SourceOutcome {
    const external::Source* subject;
    std::vector<external::Result> results; ///< empty: its folder is not there
    double seconds = 0.0;
};

/// A line for each group of each source: how many, how many within the source's accuracy, ours over theirs.
Table evidence_table(const std::vector<SourceOutcome>& outcomes);

/// The numbers that lie outside, with the reason of each.
Table missed_table(const std::vector<SourceOutcome>& outcomes);

/// docs/evidence.md. @param figure  path of the scatter plot from the page; empty: none
std::string evidence_markdown(const std::vector<SourceOutcome>& outcomes, const std::string& figure);

/// Ours over theirs of all slips, logarithmic, as an <svg>; empty without slips.
std::string evidence_figure(const std::vector<SourceOutcome>& outcomes);

} // namespace damslip::pages
