#pragma once

#include "analysis/fe/contact_run.hpp"
#include "analysis/prepare/records.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "pages/report/page.hpp"
#include "scene/effect_plan.hpp"

/// What the pages of all FE runs have in common.
namespace damslip::pages {

struct FePageFrame {
    const Scene& scene; ///< as the plan calls for it
    const EffectPlan& plan;
    const std::vector<RecordPair>& records;
    const fe2d::Model& model;
    const fe2d::FluidModel* water; ///< acoustic; null: none
    PressureProfile uplift;        ///< under the base before the earthquake; empty: none
    std::string kind;              ///< for the subtitle: "finite elements with contact"
    std::string method;            ///< for the provenance
    bool slides = true;            ///< false: the base is bonded
};

/// Title, what the records say of themselves, the section with its mesh.
Page begin_fe_page(const FePageFrame& frame);

/// The sections of the worse polarity of each record, as many open as on every page. @param sections  one for each run
/// @returns  those of the other polarity, folded: the appendix
std::vector<Section> add_worse_polarities(const std::vector<ContactRun>& runs, std::vector<Section> sections,
                                          Page& page);

/// Records with spectra, effects, the model's counts and further tables, scene and provenance.
void end_fe_page(const FePageFrame& frame, const std::vector<GroundMotion>& motions, const std::vector<Table>& tables,
                 Page& page);

/// A table of runs without its seconds, which would make every report of the same scene another file.
Table without_seconds(Table table);

} // namespace damslip::pages
