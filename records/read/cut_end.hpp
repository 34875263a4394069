#pragma once

#include "records/read/record_text.hpp"

#include <cstddef>
#include <string>

namespace damslip::records {

/// A file that was cut within its last number still holds a number, and a count that fits: "4.8E-17" becomes "4.8E-1",
/// "-0.01234" becomes "-0.01". Signs of it, from the 50 lines before the end: the exponent has fewer digits than all
/// others have; and, where the file does not end with a line end, fewer decimals than all others have, or an end before
/// the column in which this number of all lines before ends. Files whose numbers differ in length and that have no last
/// line end leave it open: that is a remark.
/// @param first_line  of the numbers
/// @returns the remark; empty where the number is whole
/// @throws InputError at the last number
std::string refuse_cut_end(const RecordText& text, std::size_t first_line);

} // namespace damslip::records
