#pragma once

#include "pages/report/page.hpp"
#include "verification/pages/evidence.hpp"
#include "verification/pages/verify_tables.hpp"

#include <string>
#include <vector>

/// The verification manual of a release: what the program was held against, for a reviewer who has only the paper.
namespace damslip::pages {

/// What a case rests on. Cases of another method of ours are no outside evidence and are counted apart.
enum class Basis { closed, published, own };
Basis basis_of(const verification::Case& subject);
const char* word(Basis basis); ///< "closed form"

/// Ids of the cases that have a sheet of their own, in the order of the manual.
const std::vector<std::string>& cases_with_sheet();

/// SHA-256 of references, tolerances and verdicts of all checks: the same on every machine where every check passes.
/// It is built into the program (program_verification()), so that a report names the record of its build.
std::string record_digest(const std::vector<CaseOutcome>& outcomes);

/// Classes, cases with reference and tolerance, sheets, hard cases, results of others, errata, and, kept apart, the values of this build.
/// @param errata  text of ERRATA.md
Page manual_page(const std::vector<CaseOutcome>& outcomes, const std::vector<HardOutcome>& hard,
                 const std::vector<SourceOutcome>& external, const std::string& errata);

} // namespace damslip::pages
