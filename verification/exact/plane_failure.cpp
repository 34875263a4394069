#include "verification/exact/plane_failure.hpp"

#include <cmath>

namespace damslip::exact {

double plane_area(const PlaneFailure& p)
{
    return (p.height - p.crack_depth) / std::sin(p.plane_dip);
}

double plane_weight(const PlaneFailure& p)
{
    const double half = 0.5 * p.unit_weight * p.height * p.height, cot_p = 1.0 / std::tan(p.plane_dip);
    const double z = p.crack_depth / p.height;
    if (p.crack_in_face) return half * (1.0 - z) * (1.0 - z) * cot_p * (cot_p * std::tan(p.face_dip) - 1.0);
    return half * ((1.0 - z * z) * cot_p - 1.0 / std::tan(p.face_dip));
}

double plane_uplift(const PlaneFailure& p)
{
    return 0.5 * p.water_weight * p.water_depth * plane_area(p);
}

double crack_thrust(const PlaneFailure& p)
{
    return 0.5 * p.water_weight * p.water_depth * p.water_depth;
}

namespace {

double strength(const PlaneFailure& p, double k)
{
    const double s = std::sin(p.plane_dip), c = std::cos(p.plane_dip), w = plane_weight(p);
    return p.cohesion * plane_area(p) +
           (w * (c - k * s) - plane_uplift(p) - crack_thrust(p) * s) * std::tan(p.friction_angle);
}

double drive(const PlaneFailure& p, double k)
{
    const double s = std::sin(p.plane_dip), c = std::cos(p.plane_dip);
    return plane_weight(p) * (s + k * c) + crack_thrust(p) * c;
}

} // namespace

double plane_factor(const PlaneFailure& p, double k)
{
    return strength(p, k) / drive(p, k);
}

double plane_yield_coefficient(const PlaneFailure& p)
{
    const double per_k = plane_weight(p) * (std::cos(p.plane_dip) + std::sin(p.plane_dip) * std::tan(p.friction_angle));
    return (strength(p, 0.0) - drive(p, 0.0)) / per_k;
}

} // namespace damslip::exact
