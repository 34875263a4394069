#pragma once

#include "analysis/accuracy/judge.hpp"
#include "analysis/prepare/records.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

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

nlohmann::ordered_json accuracy_json(const AccuracyReportInput& input);
std::string accuracy_text(const AccuracyReportInput& input);

/// The rungs as a CSV file, with what is finished.
std::string accuracy_csv(const Scene& scene, const std::vector<RungResult>& results, const Judgement& judgement);

/// One rung alone.
nlohmann::ordered_json one_rung_json(const RungResult& result, const std::vector<RecordPair>& records);
std::string one_rung_text(const RungResult& result, const std::vector<RecordPair>& records);

/// The ladder as a page: the answer, error against seconds, convergence of each model, the tables.
Page accuracy_page(const AccuracyReportInput& input);

/// What a figure of this scene is called.
std::string figure_title(const Scene& scene, const std::vector<RecordPair>& records);

} // namespace damslip::pages
