#pragma once

#include "analysis/screen/screening.hpp"
#include "pages/report/page.hpp"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace damslip {
struct SpectrumLevel;
}

/// The screening as the report that is handed in.
namespace damslip::pages {

/// What the report is made from.
struct ScreenReportInput {
    const Scene& given; ///< as read, for the resolved scene
    const Scene& scene; ///< as the plan calls for it
    const Screening& screening;
    const std::vector<RecordPair>& records;
    int jobs = 0;                            ///< threads, 0: all cores
    const SpectrumLevel* spectrum = nullptr; ///< --response-spectrum; null: not asked for
    bool mean_polarity = false;              ///< a table with the mean of both polarities
};

/// The whole answer in one sentence with its verdict: FAIL for a block that slides or floats without any earthquake, a
/// slip above the allowable or without end, or a limit-equilibrium check not met; PASS when something was judged and
/// nothing failed; neither where a run has no answer, or an error that is not known.
Headline screen_headline(const Scene& scene, const Screening& s);

/// What is to be known of the scene beside the screening's own warnings. @param ready  with the flexible block's modes
std::vector<std::string> screen_notes(const Ready& ready);

/// Section, effects, limit equilibrium, yield acceleration, slip over friction and records, each record, provenance.
Page screen_page(const ScreenReportInput& input);

/// The page as one HTML file.
std::string screen_report(const ScreenReportInput& input);

nlohmann::ordered_json screen_json(const ScreenReportInput& input);
std::string screen_text(const ScreenReportInput& input);

/// summary.json, displacements.csv, flexible_block.csv of a flexible mass, scene.resolved.toml, report.html.
void write_screening(const std::filesystem::path& folder, const ScreenReportInput& input);

} // namespace damslip::pages
