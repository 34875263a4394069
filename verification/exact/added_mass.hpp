#pragma once

/// Closed forms of the added-mass formulas on a vertical face, per rho h^2 (totals), rho h (values) and h (heights).
namespace damslip::exact {

/// sum over odd n of sin(n pi zeta/2)/(n sqrt(n^2 - tau)). For tau = 0 it is Cl2(x) - Cl2(2x)/4, x = pi zeta/2, Cl2
/// Clausen's integral (all n less the even ones, sin(2kx)/(4k^2)); the difference to tau > 0 falls like tau/(2 n^4) and
/// is summed to n = 40001, which leaves less than tau/12 40001^-3 = 1.3e-15.
double westergaard_sine_sum(double zeta, double tau);

/// Total of the series, infinite period: (16/pi^3) sum 1/n^3 = 14 zeta(3)/pi^3 = 0.542754...
double westergaard_total();

/// Acting height of the same above the base over h: with k = n pi/2 the integral of (1 - zeta) sin(k zeta) is 1/k -
/// sin(k)/k^2, so the first moment is (8/pi^2) [(2/pi)(7/8) zeta(3) - (4/pi^2) beta(4)].
double westergaard_height();

/// Value at the base: (8/pi^2) (1 - 1/9 + 1/25 - ...) = 8 G/pi^2 = 0.742453..., G Catalan's constant.
double westergaard_base();

/// Zangar, vertical face: (0.73/2)(2/3 + pi/4).
double zangar_total();

/// Goldgruber & Feldbacher, vertical face: 0.707 integral of sin^0.6(pi zeta/2) = 0.707 Gamma(0.8)/(sqrt(pi)
/// Gamma(1.3)).
double goldgruber_total();

} // namespace damslip::exact
