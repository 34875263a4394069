#include "sliding/block/slide_batch.hpp"

#include "sliding/block/slide_batch.hpp"

#include <algorithm>

namespace damslip::sliding {

std::optional<double> yield_for_slip(const SkippingMotion& motion, double slip, int polarity)
{
    const AccelRange& whole = motion.whole();
    const double peak = std::max(0.0, polarity > 0 ? whole.h_max : -whole.h_min);
    if (slip <= 0.0) return peak;
    FixedYieldOptions options;
    options.polarity = polarity;
    const auto slips_more = [&](double yield) {
        return slide_fixed_yield(motion, fixed_yield(yield), options).downstream_slip > slip;
    };
    double more = 1e-12 * peak, less = peak;
    if (!slips_more(more)) return std::nullopt;
    while (less - more > 1e-12 * peak) {
        const double middle = 0.5 * (more + less);
        (slips_more(middle) ? more : less) = middle;
    }
    return 0.5 * (more + less);
}

} // namespace damslip::sliding
