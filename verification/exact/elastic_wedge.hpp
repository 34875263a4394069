#pragma once

/// Levy's triangular dam (M. Levy, Comptes Rendus 127, 1898, 10-15; Timoshenko & Goodier, Theory of Elasticity, art.
/// 45).
///
/// Section: heel (0, 0), toe (B, 0), apex (0, H); water to the apex on the vertical upstream face, own weight,
/// downstream face free. With d = H - y the depth below the apex and t = B / H the stresses are linear, here re-derived
/// from equilibrium and the face tractions: upstream x = 0: sigma_xx = -gamma d, tau = 0; downstream x = t d: traction
/// zero. Equilibrium d(tau)/dx + d(sigma_yy)/dy = w closes it:
///     sigma_xx = -gamma d
///     sigma_xy =  gamma x / t^2
///     sigma_yy = (w / t - 2 gamma / t^3) x + (gamma / t^2 - w) d
/// Linear stresses are compatible. Plane strain gives linear strains e_xx = a1 x + b1 y + c1, e_yy = a2 x + b2 y + c2,
/// g_xy = a3 x + b3 y + c3 and, up to a rigid motion, the displacement
///     u = a1 x^2/2 + b1 x y + c1 x + (b3 - a2) y^2/2 + c3 y,     v = b2 y^2/2 + a2 x y + c2 y + (a3 - b1) x^2/2.
namespace damslip::exact {

struct ElasticWedge {
    double height = 0.0;        ///< H [m]
    double base = 0.0;          ///< B [m]
    double young_modulus = 0.0; ///< [Pa]
    double poisson_ratio = 0.0; ///< [-]
    double unit_weight = 0.0;   ///< w of the dam [N/m^3]
    double water_weight = 0.0;  ///< gamma of the water [N/m^3]

    struct Stress {
        double xx, yy, xy; ///< [Pa], tension positive
    };
    struct Displacement {
        double x, y; ///< [m]
    };
    Stress stress(double x, double y) const;
    Displacement displacement(double x, double y) const;
};

} // namespace damslip::exact
