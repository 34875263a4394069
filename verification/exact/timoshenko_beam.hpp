#pragma once

#include <vector>

/// Clamped-free Timoshenko beam of rectangular section, unit width.
namespace damslip::exact {

struct TimoshenkoCantilever {
    double length = 0.0;             ///< L [m]
    double depth = 0.0;              ///< h of the section [m]
    double young_modulus = 0.0;      ///< E of the beam: for plane strain E/(1 - nu^2) [Pa]
    double shear_modulus = 0.0;      ///< G [Pa]
    double density = 0.0;            ///< [kg/m^3]
    double shear_factor = 5.0 / 6.0; ///< kappa [-]

    /// Tip deflection under a tip force P [N per m width]: P L^3 / (3 E I) + P L / (kappa G A) [m].
    double tip_deflection(double force) const;

    /// First `count` bending frequencies [Hz]: roots of the frequency equation of T. C. Huang, J. Appl. Mech. 28 (1961)
    /// 579-584,
    ///     2 + [b^2 (r^2 - s^2)^2 + 2] cosh(b a) cos(b c) - b (r^2 + s^2) / sqrt(1 - b^2 r^2 s^2) sinh(b a) sin(b c) =
    ///     0
    /// with b^2 = rho A w^2 L^4 / (E I), r^2 = I / (A L^2), s^2 = E I / (kappa A G L^2) and
    /// (a, c) = 1/sqrt 2 { -+(r^2 + s^2) + [(r^2 - s^2)^2 + 4/b^2]^1/2 }^1/2. r = s = 0 gives 1 + cosh cos = 0, the
    /// Euler beam. Valid below the cut-off b r s = 1.
    std::vector<double> frequencies(int count) const;
};

} // namespace damslip::exact
