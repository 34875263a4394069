#pragma once

#include "records/read/record_text.hpp"

#include <cstddef>

namespace damslip::records {

/// A file that was cut within its last number still holds a number, and a count that fits: "4.8E-17" becomes "4.8E-1",
/// "-0.01234" becomes "-0.01". Signs of it, from the 50 lines before the end: the exponent has fewer digits than all
/// others have; and, where the file does not end with a line end, fewer decimals than all others have, or an end before
/// the column in which this number of all lines before ends. What is left is a number that cannot be told from a whole
/// one: files whose numbers differ in length.
/// @param first_line  of the numbers
/// @throws InputError at the last number
void refuse_cut_end(const RecordText& text, std::size_t first_line);

} // namespace damslip::records
