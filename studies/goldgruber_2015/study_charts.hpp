#pragma once

#include "pages/report/chart.hpp"
#include "studies/goldgruber_2015/study_rows.hpp"

/// Slips of the study as charts (Goldgruber 2015, figs 4-11 and 4-13 ... 4-19).
namespace damslip::study {

/// Slip over time of the rigid block, a colour for each friction, dashed with the vertical motion.
pages::Chart block_histories(const StudyRows& rows, const std::string& uplift);

/// Slip over time by one FE method, a colour for each friction, acoustic water and, dashed, rigorous Westergaard.
pages::Chart fe_histories(const StudyRows& rows, const std::string& uplift, double size, const std::string& method);

/// One curve of a chart over friction; `at.friction` does not matter.
struct FrictionCurve {
    std::string name;
    StudyCase at;
    pages::Mark mark = pages::Mark::line_and_points;
    int colour = -1;
};

/// Largest slip over friction; a line marks each friction below which a curve's dam does not stand.
pages::Chart over_friction(const StudyRows& rows, const std::string& title, const std::vector<FrictionCurve>& curves);

} // namespace damslip::study
