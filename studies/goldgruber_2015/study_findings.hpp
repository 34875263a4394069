#pragma once

#include "studies/goldgruber_2015/study_block.hpp"
#include "studies/goldgruber_2015/study_modes.hpp"
#include "studies/goldgruber_2015/study_rows.hpp"

/// What Goldgruber (2015), chapter 4, found, and whether it came out here.
namespace damslip::study {

enum class Holds { yes, partly, no };
const char* word(Holds holds);

/// What the study's own numbers say of a finding.
struct Judged {
    std::string numbers;
    Holds holds = Holds::no;
};

struct Finding {
    std::string where;               ///< "4.5.2.1, fig. 4-15"
    std::string printed;             ///< the source's sentence, shortened
    std::optional<Judged> here;      ///< by the most accurate method of the study, or by the rigid block
    std::optional<Judged> as_source; ///< by FE with the source's own settings; none: no FE finding, or not run
    std::string why;                 ///< why it does not hold, where the numbers themselves do not say
};

struct StudyFacts {
    const Scene& scene;
    const StudyRows& rows;
    const std::vector<StudyUplift>& uplifts;
    const std::vector<ModelModes>& modes;
    const RegressionsBeside& regressions;
    double pga = 0.0; ///< of the record's horizontal component [m/s²]
};

std::vector<Finding> study_findings(const StudyFacts& facts);

Table findings_table(const std::vector<Finding>& findings);
std::string findings_text(const std::vector<Finding>& findings);

/// Findings of the finite elements (4.5.2, 4.5.3), judged by the most accurate method and by the source's settings.
std::vector<Finding> fe_findings(const StudyRows& rows);

/// "6.4, 18, 50, 127, 464, 908 mm"; a dash where the dam slides statically.
std::string slip_list(const std::vector<double>& slips);

/// The friction from which the slip grows by more than 5 mm for each hundredth of friction; NaN: nowhere.
double progressive_from(const std::vector<double>& slips);

} // namespace damslip::study
