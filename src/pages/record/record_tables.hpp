#pragma once

#include "core/table.hpp"
#include "records/measure/response_spectrum.hpp"
#include "records/record.hpp"

namespace damslip::pages {

/// Format, samples and measures of records, one each row.
Table record_info_table(const std::vector<Record>& records);

/// The same for people, whom 64 digits do not help.
Table without_checksums(Table info_table);

/// @param ratio  damping [-]
Table spectrum_table(const Record& record, const records::ResponseSpectrum& spectrum, double ratio);

} // namespace damslip::pages
