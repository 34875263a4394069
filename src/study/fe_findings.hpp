#pragma once

#include "study/study_findings.hpp"

namespace damslip::study {

/// Findings of the finite elements (4.5.2, 4.5.3), judged by the most accurate method and by the source's settings.
std::vector<Finding> fe_findings(const StudyRows& rows);

/// "6.4, 18, 50, 127, 464, 908 mm"; a dash where the dam slides statically.
std::string slip_list(const std::vector<double>& slips);

/// The friction from which the slip grows by more than 5 mm for each hundredth of friction; NaN: nowhere.
double progressive_from(const std::vector<double>& slips);

} // namespace damslip::study
