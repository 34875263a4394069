#include "scene/rock_slope.hpp"

#include <cmath>

namespace damslip {

namespace {

/// Horizontal distance from the toe back to the crest [m].
double crest_distance(const RockSlope& s)
{
    return s.height / std::tan(s.face_dip);
}

/// Height of the ground above the toe at the crack [m].
double ground_at_crack(const RockSlope& s)
{
    return s.crack_distance >= 0.0 ? s.height + s.crack_distance * std::tan(s.upper_dip)
                                   : (crest_distance(s) + s.crack_distance) * std::tan(s.face_dip);
}

double heel_height(const RockSlope& s)
{
    return (crest_distance(s) + s.crack_distance) * std::tan(s.plane_dip);
}

} // namespace

double crack_depth(const RockSlope& slope)
{
    return ground_at_crack(slope) - heel_height(slope);
}

Polyline sliding_block(const RockSlope& slope)
{
    const double fall = heel_height(slope);
    Polyline p{{0.0, 0.0}, {crest_distance(slope) + slope.crack_distance, -fall}};
    if (slope.crack_distance > 0.0) p.push_back({slope.crack_distance, slope.height - fall});
    p.push_back({0.0, crack_depth(slope)});
    return p;
}

} // namespace damslip
