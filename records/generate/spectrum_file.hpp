#pragma once

#include "records/generate/target_spectrum.hpp"

#include <filesystem>
#include <optional>
#include <string_view>

namespace damslip::records {

/// A user's target spectrum: two columns, period [s] and spectral acceleration at 5 % damping in any unit (only its shape counts), the
/// first row being the PGA. A heading line may say so in other words and units, and in another order: "T [ms];Sa [%g]", "frequency_hz,psa_m_s2"; of
/// frequencies the highest is the PGA. Named after the file.
/// @throws InputError for anything else than two columns of numbers, headings that are neither, velocities and displacements, and as
///         table_spectrum does
TargetSpectrum read_target_spectrum(const std::filesystem::path& path);
TargetSpectrum parse_target_spectrum(std::string_view content, std::string_view file_name);

/// The spectrum that a word names: rock, ec8-1, ec8-2, or the user's of `file`. @param ground, component  of ec8
/// @returns nothing where the word is none of these and the file is not there @throws InputError as read_target_spectrum()
std::optional<TargetSpectrum> find_target_spectrum(std::string_view word, const std::filesystem::path& file,
                                                   GroundType ground, MotionComponent component);

} // namespace damslip::records
