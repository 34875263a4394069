#pragma once

#include "analysis/prepare/rigid_model.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "pages/fe/contact_tables.hpp"
#include "pages/report/page.hpp"
#include "scene/effect_plan.hpp"

namespace damslip::pages {

/// The earthquake of one record on few modes of the dam.
struct ReducedRecord {
    std::string record;
    fe2d::ReducedResult result;
    GroundMotion motion;
    int polarity = 1;  ///< -1: the record's horizontal component is flipped
    bool both = false; ///< the other polarity was run, too
    MeshError mesh;
    std::optional<sliding::SlideResult> rigid; ///< none where the block slides statically
};

/// What a reduced run knows, in the form of a full one; the step's part of its error holds that of the modes left out, too.
ContactRun as_contact_run(const ReducedRecord& run);
std::vector<ContactRun> as_contact_runs(const std::vector<ReducedRecord>& runs);

/// What the page of reduced runs is made from.
struct ReducedReportInput {
    const Scene& scene; ///< as the plan calls for it
    const EffectPlan& plan;
    const std::vector<RecordPair>& records;
    const fe2d::EarthquakeRun& full;
    const RigidModel& rigid;
    const Polyline& uplift; ///< along the base before the earthquake [m, Pa]
    const std::vector<ReducedRecord>& runs;
    const Table& table; ///< one row a run
    const std::vector<std::string>& messages;
};

/// Slip beside the rigid block's, crest and forces of each record; errors by modes and step.
Page reduced_page(const ReducedReportInput& input);

} // namespace damslip::pages
