#pragma once

#include "analysis/accuracy/judge.hpp"
#include "analysis/prepare/records.hpp"
#include "pages/report/page.hpp"

namespace damslip::pages {

struct AccuracyReportInput {
    const Scene& scene;
    const std::vector<RecordPair>& records;
    const std::vector<RungResult>& results;
    const Judgement& judgement;
    double tolerance;
    std::string command;               ///< that runs the chosen rung; empty: none is chosen
    std::vector<std::string> messages; ///< what is left out and why
};

/// The ladder as a page: the answer, error against seconds, convergence of each model, the tables.
Page accuracy_page(const AccuracyReportInput& input);

/// What a figure of this scene is called.
std::string figure_title(const Scene& scene, const std::vector<RecordPair>& records);

} // namespace damslip::pages
