#pragma once

namespace damslip::exact {

/// Oscillator u'' + 2 zeta w u' + w^2 u = -(a0 + slope t) from u(0) = u0, u'(0) = v0, 0 <= zeta < 1. With u_p = p + q
/// t: q = -slope/w^2, p = -a0/w^2 + 2 zeta slope/w^3 (put it in), and the free part e^(-zeta w t)(C cos w_d t + S sin
/// w_d t) with C = u0 - p, S = (v0 - q + zeta w C)/w_d, w_d = w sqrt(1 - zeta^2).
struct RampedOscillator {
    double w, zeta, a0, slope, u0 = 0.0, v0 = 0.0;
    double displacement(double t) const;
    double velocity(double t) const;
};

/// Peak of w^2 |u| of an oscillator at rest on which the constant ground acceleration A is put at t = 0:
/// u = -(A/w^2)(1 - e^(-zeta w t)(cos w_d t + zeta/sqrt(1 - zeta^2) sin w_d t)), first extreme at w_d t = pi:
/// A (1 + exp(-pi zeta / sqrt(1 - zeta^2))).
double step_pseudo_acceleration(double acceleration, double zeta);

} // namespace damslip::exact
