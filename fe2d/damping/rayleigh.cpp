#include "fe2d/damping/rayleigh.hpp"

#include <cassert>

namespace damslip::fe2d {

RayleighConstants rayleigh_constants(double ratio, double first_frequency, double second_frequency)
{
    assert(ratio >= 0.0 && first_frequency > 0.0 && second_frequency > 0.0);
    const double sum = first_frequency + second_frequency;
    return {2.0 * ratio * first_frequency * second_frequency / sum, 2.0 * ratio / sum};
}

double damping_ratio(const RayleighConstants& constants, double frequency)
{
    return 0.5 * (constants.mass / frequency + constants.stiffness * frequency);
}

} // namespace damslip::fe2d
