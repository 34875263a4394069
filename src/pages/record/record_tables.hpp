#pragma once

#include "analysis/suite/record_suite.hpp"
#include "core/csv.hpp"
#include "records/measure/measures.hpp"
#include "records/record.hpp"

#include <span>

namespace damslip::pages {

/// Format, samples and measures of records, one each row.
enum class Checksums { shown, left_out };
Table record_info_table(const std::vector<Record>& records, Checksums checksums);

/// @param ratio  damping [-]
Table spectrum_table(const Record& record, const records::ResponseSpectrum& spectrum, double ratio);

/// PGA, PGV, I_A, CAV, D5-95, T_m of records as they are in their files, one each row.
Table suite_index_table(const std::vector<SuiteRow>& rows);

/// What was selected: factor, misfit, and the measures after scaling.
Table suite_selection_table(const std::vector<SuiteRow>& rows, const records::SuiteSelection& selection);

/// The target, and the geometric mean of the scaled spectra with their smallest and largest, at some of the periods.
/// @param spectra  of all candidates [m/s^2]
Table suite_spectrum_table(std::span<const double> periods, std::span<const double> target,
                           const std::vector<std::vector<double>>& spectra, const records::SuiteSelection& selection);

} // namespace damslip::pages
