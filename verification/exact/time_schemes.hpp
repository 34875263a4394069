#pragma once

#include <array>
#include <complex>

/// What a one-step scheme of the Newmark/HHT family does to one oscillator, from its characteristic polynomial.
namespace damslip::exact {

/// Scheme M a₁ + (1+α)(C v + K u - R)₁ - α(C v + K u - R)₀ = 0 with Newmark's γ, β on u'' + 2ζω u' + ω² u = f.
struct SchemeParameters {
    double alpha, gamma, beta; ///< [-]
};

/// Eigenvalues of the amplification matrix, largest modulus first; a pair is given with the positive imaginary part
/// first.
///
/// Write z for the shift u_n -> u_{n+1}. Newmark's assumptions, used twice and once, are
///     (z-1)² u = Δt² P(z) a,   P = βz² + (½+γ-2β)z + (½-γ+β);        (z-1) v = Δt V(z) a,   V = γz + 1-γ,
/// and the equation of motion is z a = -((1+α)z - α)(2ζω v + ω² u). Times (z-1)², with Ω = ωΔt:
///     z(z-1)² + ((1+α)z - α) [2ζΩ V(z)(z-1) + Ω² P(z)] = 0.
/// No matrix of the scheme enters, so this is independent of how the program makes its steps. α = 0: one root is 0.
std::array<std::complex<double>, 3> scheme_roots(const SchemeParameters& scheme, double damping_ratio, double omega_dt);

/// Free vibration as the scheme shows it, from the principal pair z = exp(-ζ̄Ω̄ ± iΩ̄).
struct NumericalVibration {
    double period_ratio;  ///< T̄/T_d, Ω_d/Ω̄ with Ω_d = Ω√(1-ζ²) [-]
    double damping_ratio; ///< ζ̄ = -ln|z| / Ω̄ [-]
    double modulus;       ///< |z| of the pair [-]
};
NumericalVibration numerical_vibration(const SchemeParameters& scheme, double damping_ratio, double omega_dt);

/// Discrete steady state under f = exp(iω_f t) per unit mass: the amplitudes of u, v, a on the time grid. The equation
/// of motion is then z a = ((1+α)z - α)(f - 2ζω v - ω² u) with z = exp(iω_fΔt), and the same relations hold.
struct DiscreteResponse {
    std::complex<double> displacement, velocity, acceleration;
};
DiscreteResponse discrete_steady_state(const SchemeParameters& scheme, double omega, double damping_ratio,
                                       double load_omega, double dt);

} // namespace damslip::exact
