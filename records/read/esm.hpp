#pragma once

#include "records/read/read_record.hpp"
#include "records/read/record_text.hpp"

namespace damslip::records {

/// Line 1 starts with "EVENT_NAME:".
bool looks_like_esm(const RecordText& text);

/// ESM and ITACA ASCII (header format DYNA): lines "KEY: value", split at the first colon, many of them empty; then one
/// sample a line. NDATA, SAMPLING_INTERVAL_S, UNITS and DATA_TYPE count; STREAM is the component.
/// Luzi et al. (2016), Engineering Strong Motion Database.
/// @throws InputError: velocity, displacement, spectra (the same header), a missing key, NDATA that is not the number of
/// values.
std::vector<Record> read_esm(const RecordText& text, const ReadOptions& options);

} // namespace damslip::records
