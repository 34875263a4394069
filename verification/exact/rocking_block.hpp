#pragma once

namespace damslip::exact {

/// A dry rectangular block of half-diagonal R and slenderness alpha = atan(width / height) that rocks on a rigid base without
/// sliding. Housner (1963), Bull. Seism. Soc. Am. 53, 403-417.
struct Rocker {
    double width = 0.0, height = 0.0; ///< [m]
    double gravity = 9.81;            ///< [m/s^2]

    double slenderness() const; ///< alpha [rad]
    double frequency() const;   ///< p = sqrt(3 g / (4 R)) [1/s]

    /// Period of free rocking released at theta_0 = share alpha: 4/p acosh(1 / (1 - share)) [s]. Of small angles and
    /// a slender block: sin x = x.
    double linear_period(double share) const;
    /// A quarter of the period without that, from energy: the integral over theta from 0 to theta_0 of
    /// 1 / (p sqrt(2 (cos(alpha - theta_0) - cos(alpha - theta)))), by Simpson's rule, the root at theta_0 taken out [s].
    double quarter_period(double share) const;
    /// Angular rate after a landing over that before: 1 - 1.5 sin^2 alpha [-], the root of his ratio of energies.
    double landing_ratio() const;
    /// Uniform a_h that starts to rock it: g width / height [m/s^2].
    double starts() const;
};

} // namespace damslip::exact
