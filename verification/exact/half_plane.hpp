#pragma once

#include <complex>

/// The surface of an elastic half plane (plane strain) under harmonic loads on a strip of the length 2b, e^{iωt}.
namespace damslip::exact {

/// Lamb (1904), Phil. Trans. R. Soc. A 203, 1-42: a surface traction with the wave number k moves the surface by
///
///     û_v = - α k_s² / (G R),   û_h = - β k_s² / (G R),   R = (2k² - k_s²)² - 4 k² α β,   α² = k² - k_p², β² = k² - k_s²
///
/// so a strip's load with the shape w moves the strip, weighted with w again, by F = (1/2π) ∫ |ŵ|² û dk. Waves go outwards
/// for k on a path above the real axis, where the poles of R (Rayleigh's waves) and the branch points lie: it rises from 0
/// and comes down behind them. Gauss' rule in pieces, and the end of the path beyond the last of them by its limit
/// (1 - ν)/(G k). Accurate to about 1e-8.
struct HalfPlane {
    double shear_modulus = 1.0; ///< G [Pa]
    double poisson_ratio = 0.2; ///< [-]
    double density = 1.0;       ///< [kg/m^3]
    double half_width = 0.5;    ///< b [m]

    double shear_speed() const;       ///< c_s [m/s]
    double compression_speed() const; ///< c_p [m/s]

    /// Mean displacement for a unit force, traction uniform [m^2/N].
    std::complex<double> horizontal(double frequency) const; ///< @param frequency  ω > 0 [rad/s]
    std::complex<double> vertical(double frequency) const;
    /// Rotation ∫ u_v x dx / I for a unit moment, traction x/I, I = 2b³/3 [1/N].
    std::complex<double> rocking(double frequency) const;
};

} // namespace damslip::exact
