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

std::shared_ptr<const SpectrumLevel> find_spectrum_level(const SpectrumArguments& a, const Ready& ready)
{
    if (!a.wanted) return nullptr;
    check_spectrum_level(a, !ready.records().empty());
    std::vector<LevelSpectrum> given;
    if (!a.horizontal.empty()) {
        const records::TargetSpectrum shape = records::read_target_spectrum(a.horizontal);
        given.push_back({shape.name, ratio_of_files, scaled(shape, *a.pga)});
        if (!a.vertical.empty())
            given.back().vertical = scaled(records::read_target_spectrum(a.vertical), *a.vertical_pga);
    }
    return std::make_shared<const SpectrumLevel>(spectrum_level(ready, given));
}

} // namespace damslip::cli
