#include "records/measure/mean_period.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gsl/gsl_fft_real.h>
#include <vector>

namespace damslip::records {

std::optional<double> mean_period(std::span<const double> accel, double dt)
{
    constexpr double lowest = 0.25, highest = 20.0, widest_step = 0.05; // [Hz]
    const auto samples_for_step = static_cast<std::size_t>(std::min(std::ceil(1.0 / (widest_step * dt)), 1e8));
    const std::size_t n = std::bit_ceil(std::max({accel.size(), samples_for_step, std::size_t{4}}));
    std::vector<double> spectrum(n, 0.0);
    std::copy(accel.begin(), accel.end(), spectrum.begin());
    gsl_fft_real_radix2_transform(spectrum.data(), 1, n); // half-complex: real part k at k, imaginary part at n - k

    double weighted = 0.0, total = 0.0;
    for (std::size_t k = 1; k < n / 2; ++k) {
        const double frequency = static_cast<double>(k) / (static_cast<double>(n) * dt);
        if (frequency < lowest) continue;
        if (frequency > highest) break;
        const double squared = spectrum[k] * spectrum[k] + spectrum[n - k] * spectrum[n - k];
        weighted += squared / frequency;
        total += squared;
    }
    if (!(total > 0.0)) return std::nullopt;
    return weighted / total;
}

} // namespace damslip::records
