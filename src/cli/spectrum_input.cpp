#include "cli/spectrum_input.hpp"

#include "analysis/spectrum/spectrum_level.hpp"
#include "core/usage_error.hpp"
#include "records/generate/spectrum_file.hpp"

namespace damslip::cli {

namespace {

constexpr double ratio_of_files = 0.05; ///< damping that the spectra of files are for [-]

std::function<double(double)> scaled(const records::TargetSpectrum& shape, double pga)
{
    return [shape, pga](double period) { return pga * shape.amplification(period); };
}

} // namespace

void check_spectrum_level(const SpectrumArguments& a, bool has_records)
{
    if (a.wanted && a.horizontal.empty() && !has_records)
        refuse_usage("--response-spectrum without a record.", "a record, or a spectrum",
                     "add  --record FILE , or  --spectrum FILE --spectrum-pga 1.0");
}

std::vector<LevelSpectrum> given_spectra(const SpectrumArguments& a)
{
    if (!a.wanted || a.horizontal.empty()) return {};
    const records::TargetSpectrum shape = records::read_target_spectrum(a.horizontal);
    LevelSpectrum spectrum{shape.name, ratio_of_files, scaled(shape, *a.pga)};
    if (!a.vertical.empty()) spectrum.vertical = scaled(records::read_target_spectrum(a.vertical), *a.vertical_pga);
    return {std::move(spectrum)};
}

std::shared_ptr<const SpectrumLevel> find_spectrum_level(const SpectrumArguments& a,
                                                         const std::vector<LevelSpectrum>& given, const Ready& ready)
{
    if (!a.wanted) return nullptr;
    check_spectrum_level(a, !ready.records().empty());
    return std::make_shared<const SpectrumLevel>(spectrum_level(ready, given));
}

} // namespace damslip::cli
