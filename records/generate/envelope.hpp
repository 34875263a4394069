#pragma once

#include <cstddef>
#include <vector>

namespace damslip::records {

enum class EnvelopeShape {
    compound, ///< quadratic rise, level, exponential decay to 5 % at the end: Jennings, Housner & Tsai (1968)
    trapezoid ///< linear rise, level, linear fall to zero at the end
};

/// How the strength of shaking varies over the record, between 0 and 1.
struct Envelope {
    EnvelopeShape shape = EnvelopeShape::compound;
    double rise = 0.1;  ///< end of the rise, fraction of the duration, > 0
    double level = 0.5; ///< end of the strong part, fraction of the duration, rise <= level < 1
};

/// Values at n samples. The last 2.5 % are brought to zero (half a cosine), so that both ends are exactly zero.
std::vector<double> envelope_samples(const Envelope& envelope, std::size_t n);

} // namespace damslip::records
