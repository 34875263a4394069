#pragma once

/// u'' + 2ζω u' + ω² u = f(t), ζ < 1: closed solutions (any text on structural dynamics, e.g. Chopra, Dynamics of
/// Structures).
namespace damslip::exact {

struct Motion {
    double displacement, velocity;
};

struct DampedOscillator {
    double omega; ///< undamped [rad/s]
    double ratio; ///< ζ [-], 0 <= ζ < 1

    /// f = 0 from u(0), v(0): e^{-ζωt} [u₀ cos ω_d t + (v₀ + ζωu₀)/ω_d sin ω_d t], ω_d = ω√(1-ζ²).
    Motion free(double displacement, double velocity, double time) const;

    /// f(t) = f₀ for t > 0 from rest: f₀/ω² plus the free vibration from -f₀/ω².
    Motion step(double load, double time) const;

    /// f(t) = f₀ sin(ω_f t) from rest: steady state (f₀/ω²)[(1-r²) sin - 2ζr cos]/[(1-r²)² + (2ζr)²], r = ω_f/ω, plus
    /// the free vibration that makes u(0) = v(0) = 0.
    Motion harmonic(double load, double load_omega, double time) const;

    /// Amplitude of the absolute acceleration u'' + a_g over that of the ground, a_g harmonic with ω_g, steady state:
    /// √(1 + (2ζr)²) / √((1-r²)² + (2ζr)²), r = ω_g/ω.
    double transmissibility(double ground_omega) const;
};

} // namespace damslip::exact
