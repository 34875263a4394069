#pragma once

namespace damslip::records {

/// Relative motion of a linear oscillator on moving ground: u'' + 2 zeta w u' + w^2 u = -a_g(t).
struct OscillatorState {
    double displacement = 0.0; ///< u, relative to the ground [m]
    double velocity = 0.0;     ///< u' [m/s]
};

/// The exact step of the oscillator under ground acceleration that is linear over the step, Nigam & Jennings (1969):
///
///     (u, u')_1 = A (u, u')_0 + B (a_0, a_1)
///
/// The matrices exp(L h), phi_1, phi_2 are summed as power series of L h, L = [0 1; -w^2 -2 zeta w]: no cancellation
/// for long periods (the closed forms lose (w h)^-3 digits), and the same expression for no, sub- and over-critical
/// damping. Limits: w = 0 gives the free mass u'' = -a_g exactly.
class OscillatorStep {
public:
    /// @param circular_frequency  w [rad/s], >= 0   @param ratio  zeta [-], >= 0
    /// @param step  h [s], > 0, with w h (1 + 2 zeta) <= 2 so that the series converges to round-off (asserted)
    OscillatorStep(double circular_frequency, double ratio, double step);

    /// `count` such steps as one, under ground acceleration that is linear over them all.
    /// @param count  >= 1
    OscillatorStep repeated(int count) const;

    /// @param a0, a1  ground acceleration at the start and the end of the step [m/s^2]
    OscillatorState advance(const OscillatorState& s, double a0, double a1) const
    {
        return {a_[0] * s.displacement + a_[1] * s.velocity + b_[0] * a0 + b_[1] * a1,
                a_[2] * s.displacement + a_[3] * s.velocity + b_[2] * a0 + b_[3] * a1};
    }

private:
    OscillatorStep() = default;
    /// `first` over p parts of the time, `second` over q more.
    static OscillatorStep in_turn(const OscillatorStep& first, int p, const OscillatorStep& second, int q);

    double a_[4]; ///< rows (u, u')
    double b_[4]; ///< rows (u, u'), columns (a_0, a_1)
};

} // namespace damslip::records
