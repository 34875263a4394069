#pragma once

#include "records/read/read_record.hpp"
#include "records/read/record_text.hpp"

namespace damslip::records {

/// Line 1 has "(Format v".
bool looks_like_cosmos(const RecordText& text);

/// COSMOS strong-motion format 1.20, volumes 1 and 2: for each channel text lines, integer and real header and comments
/// with their counts and Fortran formats, then acceleration (volume 2: and velocity, displacement, which are passed over).
/// Read by the widths of the formats, not by blanks. Numbering of header values from 0, as in the sources:
/// integer 0 volume, 1 quantity (1: acceleration), 2 unit, 18 kind of structure, 53 azimuth, 75 problem; real 61 time
/// step of the samples in ms (33, in s, is the recorder's), 62 length in s. "COSMOS Strong Motion Data Format" (2001);
/// Consortium of Organizations for Strong-Motion Observation Systems, tables.
/// @throws InputError: raw counts (volume 0), no channel of acceleration, unknown unit, unit code of header and data
/// line that differ, gaps ("unknown" of text line 13), a number of samples that is not the stated one.
std::vector<Record> read_cosmos(const RecordText& text, const ReadOptions& options);

} // namespace damslip::records
