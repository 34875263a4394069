#pragma once

#include "analysis/fe/contact_run.hpp"
#include "analysis/prepare/rigid_model.hpp"
#include "pages/fe/fe_output.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

namespace damslip::pages {

/// What answer and page of reduced runs are made from.
struct ReducedReportInput {
    const Scene& scene; ///< as the plan calls for it
    const EffectPlan& plan;
    const std::vector<RecordPair>& records;
    const fe2d::EarthquakeRun& full;
    const RigidModel& rigid;
    const PressureProfile& uplift; ///< under the base before the earthquake
    const std::vector<ReducedRecord>& runs;
    const std::vector<std::string>& messages;
    std::vector<sliding::Equilibrium> combinations = {}; ///< Ready::combinations()
};

/// What has to be said of scene and runs beside the tables.
std::vector<std::string> reduced_messages(const Scene& scene, const std::vector<ReducedRecord>& runs);

FeAnswer reduced_answer(const ReducedReportInput& input);

/// The history of one run as a CSV file. @param hash  of the scene (EffectPlan::scene_hash)
void write_reduced_history(const std::filesystem::path& folder, const Scene& scene, const std::string& hash,
                           const ReducedRecord& run);

/// Slip beside the rigid block's, crest and forces of each record; errors by modes and step.
Page reduced_page(const ReducedReportInput& input);

} // namespace damslip::pages
