#pragma once

#include "records/read/read_record.hpp"
#include "records/read/record_text.hpp"

namespace damslip::records {

/// Line 1 is "2 CORRECTED ACCELEROGRAM" or another volume of the format, or a lone "*" with the header blocks below.
bool looks_like_smc(const RecordText& text);

/// SMC format of the U.S. Geological Survey: 11 text lines, 48 integers (8I10), 50 reals (5E15.7), as many comment lines
/// as the integer header says, samples in cm/s^2 (8 fields of 10). Header values from 0, row by row: integer 0 code of
/// missing integers, 12 and 13 vertical and horizontal orientation, 15 comment lines, 16 samples, 17 problem flag,
/// 18 kind of structure (3: dam), 27 place on a dam; real 0 code of missing reals, 1 samples per second.
/// USGS Open-File Report 92-296-A (Converse 1992: BAP), appendix.
/// @throws InputError: velocity, displacement, spectra, no volume stated, an impossible sampling rate, gaps.
std::vector<Record> read_smc(const RecordText& text, const ReadOptions& options);

} // namespace damslip::records
