#pragma once

#include "records/read/read_record.hpp"
#include "records/read/record_text.hpp"

namespace damslip::records {

/// Line 1 starts with "Origin Time".
bool looks_like_k_net(const RecordText& text);

/// K-NET and KiK-net ASCII of NIED, Japan: 17 lines with labels in their first 18 columns, then counts of the recorder.
/// Acceleration [gal] = count * "Scale Factor 3920(gal)/6182761" minus the offset of the sensor, which is the mean of
/// the first 10 s: the recorder keeps 15 s from before the trigger. Records under 20 s: the mean of all.
/// Directions: N-S, E-W, U-D positive north, east, up; 1 to 3 the same in the borehole, 4 to 6 at the surface.
/// @throws InputError: a missing line, a factor that is not understood, a number of samples that is not frequency times
/// duration.
std::vector<Record> read_k_net(const RecordText& text, const ReadOptions& options);

} // namespace damslip::records
