// Target spectra: any bytes give a shape that is finite and positive at every period, or an InputError.
#include "core/input_error.hpp"
#include "records/generate/wavelet_match.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        const auto target = damslip::records::parse_target_spectrum(
            std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
        for (const double period : {0.0, 0.01, 0.05, 0.3, 1.0, 2.0, 9.0}) {
            const double value = target.amplification(period);
            if (!(std::isfinite(value) && value > 0.0)) std::abort();
        }
    } catch (const damslip::InputError&) {
    }
    return 0;
}
