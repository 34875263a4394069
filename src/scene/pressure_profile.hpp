#pragma once

#include <vector>

namespace damslip {

/// One corner of a pressure profile.
struct ProfilePoint {
    double distance = 0.0; ///< along the base from the heel [m]
    double pressure = 0.0; ///< water pressure [Pa]
    friend bool operator==(const ProfilePoint&, const ProfilePoint&) = default;
};

/// Water pressure under the base, piecewise linear from heel to toe; a repeated distance is a jump. In a lift joint the same
/// from its upstream end.
struct PressureProfile {
    std::vector<ProfilePoint>
        points; ///< distances ascending, first 0, last the base length; empty: no pressure anywhere
    bool empty() const { return points.empty(); }
};

/// Resultant of a profile: normal to the base, lifts the dam.
struct UpliftResultant {
    double force = 0.0;             ///< U = integral of p ds [N/m]
    double moment_about_heel = 0.0; ///< integral of p s ds [N m/m], counter-clockwise, whatever the base inclination
};

/// Exact integrals.
UpliftResultant resultant(const PressureProfile& profile);

/// Pressure at a distance from the heel [Pa]; at a jump the value on the heel's side; 0 outside the profile.
double pressure_at(const PressureProfile& profile, double distance);

/// The part of the profile beyond `from` and up to `to`, both ends included as points; a jump at `from` is left out,
/// one at `to` too.
std::vector<ProfilePoint> part(const PressureProfile& profile, double from, double to);

} // namespace damslip
