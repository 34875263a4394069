#include "records/generate/envelope.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace damslip::records {

std::vector<double> envelope_samples(const Envelope& envelope, std::size_t n)
{
    assert(envelope.rise > 0.0 && envelope.level >= envelope.rise && envelope.level < 1.0 && n >= 2);
    constexpr double end_value = 0.05, taper = 0.025;
    const bool compound = envelope.shape == EnvelopeShape::compound;
    std::vector<double> values(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = static_cast<double>(k) / static_cast<double>(n - 1);
        double value = 1.0;
        if (x < envelope.rise) value = compound ? (x / envelope.rise) * (x / envelope.rise) : x / envelope.rise;
        if (x > envelope.level) {
            const double part = (x - envelope.level) / (1.0 - envelope.level);
            value = compound ? std::pow(end_value, part) : 1.0 - part;
        }
        if (x > 1.0 - taper) value *= 0.5 * (1.0 + std::cos(std::numbers::pi * (x - 1.0 + taper) / taper));
        values[k] = value;
    }
    values.back() = 0.0;
    return values;
}

} // namespace damslip::records
