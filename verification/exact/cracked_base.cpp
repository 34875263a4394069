#include "verification/exact/cracked_base.hpp"

namespace damslip::exact {

double linear_uplift_crack(double normal, double moment_about_toe, double pressure, double length)
{
    return (normal * length + 0.5 * pressure * length * length - 3.0 * moment_about_toe) / (normal - pressure * length);
}

double dry_crack(double normal, double moment_about_toe, double length)
{
    return length - 3.0 * moment_about_toe / normal;
}

} // namespace damslip::exact
