#include "verification/exact/frictional_bed.hpp"

#include <algorithm>

namespace damslip::exact {

double FrictionalBed::loaded(double pull, double x) const
{
    const double to_tip = std::max(pull / strength - x, 0.0);
    return strength / (2.0 * stiffness) * to_tip * to_tip;
}

double FrictionalBed::unloaded(double pull, double to, double x) const
{
    return loaded(pull, x) - 2.0 * loaded(0.5 * (pull - to), x);
}

double FrictionalBed::reloaded(double pull, double to, double again, double x) const
{
    return unloaded(pull, to, x) + 2.0 * loaded(0.5 * (again - to), x);
}

} // namespace damslip::exact
