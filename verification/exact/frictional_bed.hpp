#pragma once

namespace damslip::exact {

/// Long elastic bar on a bed that resists with at most tau per length, pulled at its end x = 0 by P; x goes into the
/// bar, displacements are positive along the pull. Where it slips EA u'' = tau; slip and strain are zero at the tip of
/// the slip zone x = P/tau:
///
///     u = tau/(2 EA) (P/tau - x)^2,   at the end P^2/(2 EA tau)
///
/// A change of the pull by d against the former slip has twice the strength to overcome (from +tau to -tau), so it adds
/// -2 u(d/2, x), as long as it does not go past the former extreme (Masing 1926). Unloaded, P^2/(4 EA tau) remains.
struct FrictionalBed {
    double stiffness; ///< EA [N]
    double strength;  ///< tau [N/m]

    double loaded(double pull, double x) const; ///< first loading to P >= 0 [m]
    /// Then to Q, -P <= Q <= P [m].
    double unloaded(double pull, double to, double x) const;
    /// Then to R, Q <= R <= P [m].
    double reloaded(double pull, double to, double again, double x) const;
};

} // namespace damslip::exact
