#include "verification/exact/free_field.hpp"

#include <cmath>

namespace damslip::exact {

double SurfacePulse::displacement(double time) const
{
    const double s = (time - middle) / width;
    return amplitude * std::exp(-s * s);
}

double SurfacePulse::velocity(double time) const
{
    const double s = (time - middle) / width;
    return -2.0 * s / width * displacement(time);
}

double SurfacePulse::acceleration(double time) const
{
    const double s = (time - middle) / width;
    return (4.0 * s * s - 2.0) / (width * width) * displacement(time);
}

double FreeField::displacement(double y, double time) const
{
    return 0.5 * (surface.displacement(time - y / speed) + surface.displacement(time + y / speed));
}

double FreeField::velocity(double y, double time) const
{
    return 0.5 * (surface.velocity(time - y / speed) + surface.velocity(time + y / speed));
}

double FreeField::gradient(double y, double time) const
{
    return 0.5 * (surface.velocity(time + y / speed) - surface.velocity(time - y / speed)) / speed;
}

} // namespace damslip::exact
