#pragma once

#include "core/status.hpp"
#include "core/csv.hpp"
#include "pages/report/chart.hpp"
#include "studies/goldgruber_2015/study_rows.hpp"

namespace damslip::study {

/// The study's slips with some of the source's settings in place of the accurate ones, with curtain, size 1, whole steps.
struct SettingsStep {
    std::string change;                        ///< on top of the steps before
    std::vector<double> acoustic, westergaard; ///< of chapter_4::frictions [mm]; NaN: none
    StatusCount unanswered;                    ///< rows without an answer
};

/// From the accurate settings to the source's, one change after the other: what each of them does to the slip. The last step is the
/// preset. @returns fewer steps when interrupted
std::vector<SettingsStep> settings_steps(const Scene& scene, const Records& records, int jobs, Watch& watch);

Table settings_table(const std::vector<SettingsStep>& steps);

/// Slips of one water over friction, a curve for each step.
pages::Chart settings_chart(const std::vector<SettingsStep>& steps, const std::string& water);

} // namespace damslip::study
