#pragma once

#include "core/csv.hpp"
#include "verification/cases/registry.hpp"
#include "verification/hard/hard_case.hpp"
#include "verification/second_solver/second_solver.hpp"

#include <string>
#include <vector>

/// What `verify` and `verify --hard` found, as tables and as docs/verification.md.
namespace damslip::pages {

struct CaseOutcome {
    const verification::Case* subject;
    std::vector<verification::Check> checks;
    double seconds = 0.0;
};

struct HardOutcome {
    const hard::HardCase* subject;
    hard::HardResult result;
    double seconds = 0.0;
    bool passed() const { return hard::passed(*subject, result); }
};

std::string tolerance_text(const verification::Check& check); ///< "1e-09 rel", "0.001 abs", "at most", "at least"
Table check_table(const std::vector<CaseOutcome>& outcomes);
Table hard_table(const std::vector<HardOutcome>& outcomes);

/// The claims and tolerances, which do not depend on the machine, and what is expected.
std::string markdown_of(const std::vector<CaseOutcome>& outcomes);
/// The table of the hard cases, without figures: nothing is run.
std::string hard_markdown();

/// Our results beside those of CalculiX.
Table second_solver_table(const std::vector<SecondResult>& results);

} // namespace damslip::pages
