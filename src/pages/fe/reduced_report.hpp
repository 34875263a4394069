#pragma once

#include "analysis/prepare/rigid_model.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "pages/fe/contact_tables.hpp"
#include "pages/report/page.hpp"
#include "scene/effect_plan.hpp"

namespace damslip::pages {

/// What the page of reduced runs is made from.
struct ReducedReportInput {
    const Scene& scene; ///< as the plan calls for it
    const EffectPlan& plan;
    const std::vector<RecordPair>& records;
    const fe2d::EarthquakeRun& full;
    const RigidModel& rigid;
    const PressureProfile& uplift; ///< along the base before the earthquake [m, Pa]
    const std::vector<ReducedRecord>& runs;
    const Table& table; ///< one row a run
    const std::vector<std::string>& messages;
};

/// Slip beside the rigid block's, crest and forces of each record; errors by modes and step.
Page reduced_page(const ReducedReportInput& input);

} // namespace damslip::pages
