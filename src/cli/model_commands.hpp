#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace damslip {
struct LevelSpectrum;
struct Ready;
struct SpectrumLevel;
} // namespace damslip

namespace damslip::cli {

/// --response-spectrum and its spectra, in place of the records' ones.
struct SpectrumArguments {
    bool wanted = false;
    std::filesystem::path horizontal;   ///< file; empty: the records' spectra
    std::optional<double> pga;          ///< of that spectrum [m/s^2]
    std::filesystem::path vertical;     ///< file of the vertical component; empty: none
    std::optional<double> vertical_pga; ///< [m/s^2]
};

/// Refuses what cannot be answered, before anything is computed.
/// @throws UsageError without a record and without a spectrum
void check_spectrum_level(const SpectrumArguments& a, bool has_records);

/// The spectra of the files, read before anything is computed; empty: those of the records. @throws InputError
std::vector<LevelSpectrum> given_spectra(const SpectrumArguments& a);

/// @param given  given_spectra() @param ready  for finite elements @returns null: not asked for
/// @throws InputError, UsageError, NotConverged, Interrupted
std::shared_ptr<const SpectrumLevel> find_spectrum_level(const SpectrumArguments& a,
                                                         const std::vector<LevelSpectrum>& given, const Ready& ready);

} // namespace damslip::cli
