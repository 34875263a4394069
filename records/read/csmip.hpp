#pragma once

#include "records/read/read_record.hpp"
#include "records/read/record_text.hpp"

namespace damslip::records {

/// One of the first three lines names an (un)corrected accelerogram.
bool looks_like_csmip(const RecordText& text);

/// CSMIP/CDMG volumes 1 (uncorrected) and 2 (corrected), any number of channels a file: for each text lines (13 or 25),
/// 100 integers (16I5), 50 or 100 reals (8F10), then "3251 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC. (UNITS:
/// CM/SEC/SEC)" and the samples; volume 2 goes on with velocity and displacement, which are passed over. Where no
/// format is named the field width follows from the length of a full line (9 or 10 characters).
/// Volume 1 of digitised film has no such line: pairs of time and acceleration (10 fields of 7), as a rule uneven in
/// time, in the unit that the text lines name ("G/10" is a tenth of g).
/// Up to 7 samples fewer than stated, with a blank rest of the last line, are a warning.
/// Shakal & Huang (1985), CDMG; Converse & Brady (1992), USGS Open-File Report 92-296-A.
/// @throws InputError: response spectra (volume 3), an unknown unit, uneven times unless options.uneven is resample.
std::vector<Record> read_csmip(const RecordText& text, const ReadOptions& options);

} // namespace damslip::records
