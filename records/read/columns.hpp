#pragma once

#include "records/read/read_record.hpp"
#include "records/read/record_text.hpp"

namespace damslip::records {

/// The file has lines of numbers.
bool looks_like_columns(const RecordText& text);

/// Plain text: comment lines "# key: value" (units, dt, n, component, title), perhaps a heading line, then numbers
/// separated by blanks, tabs, commas or semicolons, with decimal points or commas.
///   - with headings (time_s, accel_m_s2, "acc [g]", ...): columns by name; a time column or a stated dt; one record
///   per acceleration column
///   - without: two numbers a line are time and acceleration, unless dt is stated and the first is no time; with dt
///   stated, all numbers
///     in reading order are samples, any number to a line
std::vector<Record> read_columns(const RecordText& text, const ReadOptions& options);

} // namespace damslip::records
