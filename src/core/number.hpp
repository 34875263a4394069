#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace damslip {

/// A finite decimal number at the start of `text`, locale-free: leading blanks and `+` skipped, Fortran `D` exponents
/// read as `E`.
/// @param used  characters consumed, blanks included; untouched when nothing is found.
/// @returns nothing for no number, NaN, infinity, overflow or `****`.
std::optional<double> parse_number(std::string_view text, std::size_t* used = nullptr);

/// The whole of `text`, blanks around it allowed, as one finite number.
std::optional<double> parse_whole_number_text(std::string_view text);

/// Shortest text that reads back as the same double ("0.1", "1e-05"); "nan" and "inf" as such.
std::string shortest(double value);

/// A factor of safety in a sentence: three digits; "∞ (no thrust)" where nothing drives.
std::string factor_text(double factor);

} // namespace damslip
