#pragma once

#include "pages/report/page.hpp"
#include "pages/sweep/sweep_pages.hpp"
#include "studies/goldgruber_2015/study_findings.hpp"
#include "studies/goldgruber_2015/study_settings.hpp"

#include <nlohmann/json_fwd.hpp>

namespace damslip::study {

struct StudyPageInput {
    const Scene& scene; ///< as given
    const StudyRows& rows;
    const Table& table; ///< all rows
    const pages::SweepView& view; ///< of them
    const std::vector<RecordPair>& records;
    const std::vector<StudyUplift>& uplifts;
    const std::vector<ModelModes>& modes;
    const RegressionsBeside& regressions;
    const std::vector<Finding>& findings;
    const std::vector<SettingsStep>& settings; ///< empty: no FE
};

/// Chapter 4 of Goldgruber (2015) with our numbers: findings, figures 4-2, 4-6, 4-7, 4-11 ... 4-19, tables 4-3 and 4-4.
pages::Page study_page(const StudyPageInput& input);

nlohmann::ordered_json study_json(const StudyPageInput& input);

} // namespace damslip::study
