#pragma once

#include "pages/fe/contact_tables.hpp"
#include "pages/report/page.hpp"

/// Histories of an FE contact run as charts over time.
namespace damslip::pages {

/// What the charts of one run are made from.
struct RunView {
    const ContactRun& run;
    const sliding::SlideResult* rigid = nullptr; ///< with its history; null: the block slides statically
    std::optional<double> allowable;             ///< slip [m]
    std::string together;                        ///< charts over time share cursor and zoom
    std::size_t records = 1;                     ///< runs in the report: the more, the fewer samples each chart keeps
};

/// Ground acceleration, slip beside the rigid block's, crest, forces on the base, rocking and opening, energy ledger. All
/// since the static state.
std::vector<Chart> history_charts(const RunView& view);

/// The row of the history where the mean slip changes fastest; nothing where the dam does not slide.
std::optional<std::size_t> fastest_row(const fe2d::RunHistory& history);

/// Contact pressure and shear from heel to toe: at the start, when the dam slides fastest, at the end, and at any of about
/// 150 instants by a slider.
std::vector<Chart> base_charts(const RunView& view);

/// Damage of the base's bond from heel to toe at the end, 0 intact, 1 broken; nothing where the base has no bond that breaks by
/// energy.
std::optional<Chart> bond_chart(const RunView& view, const Scene& scene);

/// Which part of the base sticks, slips and opens at every row of the history.
StateMap base_states(const RunView& view);

} // namespace damslip::pages
