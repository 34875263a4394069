#pragma once

#include "records/record.hpp"

#include <string>

namespace damslip::records {

/// The project's own text: "# key: value" lines (title, component, source, units, dt, n), the heading accel_m_s2, one
/// sample a line in m/s^2 as the shortest text of the double. Reading it gives the same samples and step, bit for bit.
std::string record_csv(const Record& record);

/// The same with a time column: time_s,accel_m_s2. For plotting programs; reads back bit for bit too.
std::string record_csv_with_time(const Record& record);

/// PEER AT2: four header lines, samples in g, five a line with 8 significant digits (relative rounding 5e-8).
std::string record_at2(const Record& record);

} // namespace damslip::records
