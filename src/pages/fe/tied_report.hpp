#pragma once

#include "fe2d/time/history.hpp"
#include "pages/fe/fe_page.hpp"

namespace damslip::pages {

/// The earthquake of one record on a bonded base.
struct TiedRun {
    std::string record;
    fe2d::History history;
    std::vector<std::string> notes;
    double seconds = 0.0;
    GroundMotion motion;
    int polarity = 1; ///< -1: the record's horizontal component is flipped
};

/// Histories of crest, base forces and energies of runs that cannot slide.
/// @param stages, table  of the static stages and of the runs
Page tied_page(const FePageFrame& frame, const std::vector<TiedRun>& runs, const Table& stages, const Table& table);

} // namespace damslip::pages
