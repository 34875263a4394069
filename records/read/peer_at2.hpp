#pragma once

#include "records/read/read_record.hpp"
#include "records/read/record_text.hpp"

namespace damslip::records {

/// One of the first ten lines (not a # comment) names NPTS and DT.
bool looks_like_peer_at2(const RecordText& text);

/// PEER strong-motion text file: some lines of title, one naming quantity and unit, one with the number of samples and
/// the time step as "NPTS=  3930, DT= .00500 SEC" or "3930 0.00500 NPTS, DT", then samples, any number to a line,
/// negatives possibly stuck together. An older header repeated on top holds another DT: the last such line of the first
/// ten counts.
/// @throws InputError: velocity or displacement, NPTS that is not the number of values, anything that is no number.
std::vector<Record> read_peer_at2(const RecordText& text, const ReadOptions& options);

} // namespace damslip::records
