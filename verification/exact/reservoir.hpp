#pragma once

#include <complex>
#include <vector>

/// Closed solutions of acoustic water of constant depth.
namespace damslip::exact {

/// Reservoir of depth h that goes on to infinity upstream of a rigid vertical wall (Westergaard 1933; Chopra 1967; Fenves & Chopra 1984).
struct InfiniteReservoir {
    double depth = 1.0;             ///< h [m]
    double density = 1000.0;        ///< ρ [kg/m^3]
    double sound_speed = 1440.0;    ///< c [m/s]
    double bottom_reflection = 1.0; ///< α of the bottom, 0 ... 1 [-]

    double first_frequency() const; ///< ω_1 = πc/2h of the rigid bottom [rad/s]

    /// Total force on the wall over ρ h² a for the wall's acceleration a e^{iωt} into the water, positive against the wall's motion; 0.5428
    /// at ω = 0 and α = 1.
    ///
    /// p = Σ C_n sin μ_n(h - y) e^{k_n x}, x < 0 in the water, k_n = √(μ_n² - ω²/c²) with Re k > 0, or Im k > 0 where Re k = 0 (waves
    /// e^{iωt + ikx} leave). The bottom ∂p/∂y = iωq p, q = (1-α)/((1+α)c), gives μ cos μh + iωq sin μh = 0: the ψ_n = sin μ_n(h - y) are
    /// orthogonal without conjugation, with I_n = ∫ψ_n = (1 - cos μ_n h)/μ_n, N_n = ∫ψ_n² = h/2 - sin(2μ_n h)/(4μ_n). At the wall
    /// ∂p/∂x = -ρ a (x towards the wall), so the force is ρ a Σ I_n²/(k_n N_n). The terms fall like n^-3: `terms` leave about terms^-2/16.
    std::complex<double> wall_force(double frequency, int terms = 200) const;

    /// Total force over ρ h² a of the wall's acceleration a that starts at t = 0 and stays, α = 1:
    /// (2c/h³) Σ μ_n^-2 ∫_0^t J_0(μ_n c τ) dτ, since 1/(s k_n(s)) is the transform of c ∫ J_0 (Abramowitz & Stegun 29.3.55).
    double step_force(double time, int terms = 200) const;

private:
    std::vector<std::complex<double>> depth_wave_numbers(double frequency, int terms) const; ///< μ_n h
};

/// Pressure over ρ L a at a piston that accelerates a e^{iωt} into a duct of length L whose end reflects waves of normal
/// incidence with the coefficient α: p = ρ c (a/iω) (1 + α e^{-2iκL})/(1 - α e^{-2iκL}), κ = ω/c. α = 1: wall, 0: no end, -1: p = 0.
std::complex<double> duct_pressure(double frequency, double length, double sound_speed, double reflection);

/// Natural frequencies [rad/s] of a piston (mass m, spring k, per area) at one end of a water column of length L with p = 0 at the other:
/// p = P sin κ(L - x), -Pκ cos κL = ρω²U at the piston, so k = ω² (m + ρ tan(κL)/κ).
std::vector<double> piston_and_column(double mass, double stiffness, double density, double sound_speed, double length,
                                      int count);

} // namespace damslip::exact
