#pragma once

#include "analysis/fe/tied_runs.hpp"
#include "pages/fe/fe_page.hpp"

namespace damslip::pages {

/// Histories of crest, base forces and energies of runs that cannot slide.
/// @param stages, table  of the static stages and of the runs
Page tied_page(const FePageFrame& frame, const std::vector<TiedRun>& runs, const Table& stages, const Table& table);

} // namespace damslip::pages
