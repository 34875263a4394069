#pragma once

namespace damslip::exact {

/// Elastic shear column (height H, wave speed c, top free) that moves with the uniform velocity v_0 when friction
/// begins to act on its base. d'Alembert: the base moves as v_b = 2 v_in - T/(rho c), v_in the part of the wave that
/// comes down, T the shear stress on the base; a wave comes back after 2H/c with its sign kept.
///
/// While the base slides T is the strength tau, so with V = tau/(rho c) every 2H/c takes another 2V off:
///
///     v_b = v_0 - (2n + 1) V   for   2nH/c < t < 2(n+1)H/c,   n = 0, 1, ...
///
/// Before the N-th arrival, N the least number with v_0 <= (2N + 1) V, v_b is between 0 and 2V. With it v_in falls to
/// (v_0 - 2NV)/2, and T = rho c (v_0 - 2NV), of size <= tau, holds the base. The waves go up, come back, and ask for -T
/// and T in turn: the base sticks for good. The slip is
///
///     s = (2H/c) N (v_0 - N V),   the rigid block's v_0^2 H/(2 V c) less (2H/(V c)) (v_0/2 - N V)^2,
///
/// what is missing is the energy of the vibration. v_0 <= V: no slip at all.
struct ThrownColumn {
    double height;            ///< H [m]
    double wave_speed;        ///< c [m/s]
    double friction_velocity; ///< V = tau/(rho c) [m/s]
    double velocity;          ///< v_0 [m/s]

    int arrivals() const;        ///< N [-]
    double stop_time() const;    ///< 2NH/c [s]
    double slip(double t) const; ///< [m]
    double final_slip() const;   ///< [m]
    double held_stress() const;  ///< T/tau once it sticks, of the first 2H/c [-]
};

/// Elastic bar (height H, wave speed c, density rho) that falls with v_0 on a rigid base, no weight: the base presses
/// with rho c v_0 for 2H/c, then the unloading wave from the top has taken all of the velocity over into the other
/// direction and the bar leaves with v_0, at rest in itself. Impulse 2 rho H v_0 per area.
struct BarImpact {
    double height;     ///< H [m]
    double wave_speed; ///< c [m/s]
    double density;    ///< rho [kg/m^3]
    double velocity;   ///< v_0 [m/s]

    double stress() const { return density * wave_speed * velocity; } ///< [Pa]
    double duration() const { return 2.0 * height / wave_speed; }     ///< [s]
};

} // namespace damslip::exact
