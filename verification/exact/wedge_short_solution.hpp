#pragma once

/// Hoek & Bray (1981), Rock Slope Engineering, 3rd ed., ch. 8: factor of safety of a wedge on planes A and B with cohesion and
/// water, from angles read from a stereonet; Wyllie & Mah (2004), 4th ed., ch. 7. The planes are full of water that seeps out of
/// the face: pressure gamma_w H/2 half-way down the line of intersection, zero at the surfaces.
///
///     FS = 3/(gamma H) (c_A X + c_B Y) + (A - gamma_w X/(2 gamma)) tan phi_A + (B - gamma_w Y/(2 gamma)) tan phi_B
///     X = sin t24/(sin t45 cos t2nA),  Y = sin t13/(sin t35 cos t1nB)
///     A = (cos psi_a - cos psi_b cos nAnB)/(sin psi_5 sin^2 nAnB),  B likewise
///
/// Lines: 1 = A and face, 2 = B and face, 3 = A and upper ground, 4 = B and upper ground, 5 = A and B; t24 is the angle between
/// lines 2 and 4, t2nA that between line 2 and the normal of A.
namespace damslip::exact {

struct WedgeAngles {
    double psi_a, psi_b, psi_5, na_nb, t24, t45, t2na, t13, t35, t1nb; ///< [rad]
};

struct DipAndDirection {
    double dip, direction; ///< [rad]
};

/// The angles without rounding.
WedgeAngles wedge_angles(DipAndDirection a, DipAndDirection b, DipAndDirection face, DipAndDirection upper);

struct ShortSolution {
    double x, y, a, b; ///< [-]

    /// Weights per volume and cohesions in any one system of units; friction angles in rad.
    double factor(double height, double rock, double water, double c_a, double phi_a, double c_b, double phi_b) const;
};

ShortSolution short_solution(const WedgeAngles& angles);

} // namespace damslip::exact
