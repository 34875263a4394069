#pragma once

#include <optional>
#include <string>
#include <vector>

namespace damslip::cli {

/// "1.00,0.84,0.77" or "0.65:1.0:0.05" (first, last, step; the last value is included when the step meets it) or a mix
/// of both.
/// @param flag  for messages: "--friction"
/// @throws UsageError  for anything else, non-finite numbers, a step of the wrong sign, more than 100 000 values
std::vector<double> number_list(const std::string& text, const std::string& flag);

/// "0,7" read with a decimal comma: 0.7. Nothing for any other list than two whole numbers.
std::optional<double> decimal_comma(const std::string& text);

/// "a,b,c" as words; each must be one of `allowed` (empty: any). @throws UsageError with the nearest allowed word.
std::vector<std::string> word_list(const std::string& text, const std::string& flag,
                                   const std::vector<std::string>& allowed);

} // namespace damslip::cli
