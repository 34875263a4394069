#pragma once

#include "analysis/fe/tied_runs.hpp"
#include "pages/fe/fe_output.hpp"

namespace damslip::pages {

FePageFrame tied_frame(const Scene& scene, const EffectPlan& plan, const std::vector<RecordPair>& records,
                       const fe2d::Model& model, const fe2d::FluidModel* water);

FeAnswer tied_answer(const FePageFrame& frame, const fe2d::StaticSolution& statics, const std::vector<TiedRun>& runs);

/// The history of one run as a CSV file. @param hash  of the scene (EffectPlan::scene_hash)
void write_tied_history(const std::filesystem::path& folder, const Scene& scene, const std::string& hash,
                           const TiedRun& run);

/// Histories of crest, base forces and energies of runs that cannot slide.
Page tied_page(const FePageFrame& frame, const fe2d::StaticSolution& statics, const std::vector<TiedRun>& runs);

} // namespace damslip::pages
