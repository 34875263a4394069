#pragma once

namespace damslip::sliding {

struct OscillatorState {
    double x = 0.0; ///< [m]
    double v = 0.0; ///< x' [m/s]
};

/// inertia x'' + 2 zeta omega x' + omega^2 x = p, p linear in time: followed in closed form, whatever the step.
class Oscillator {
public:
    /// @param omega  [rad/s], > 0 @param damping  zeta [-], >= 0 @param inertia  [-], > 0
    Oscillator(double omega, double damping, double inertia);

    /// State a time h later under p0 + p1 t. Under-, over- and critically damped alike.
    OscillatorState after(const OscillatorState& now, double p0, double p1, double h) const;

    /// omega^2 x + 2 zeta omega x': what spring and damper pull with [m/s^2].
    double restoring(const OscillatorState& s) const { return stiffness_ * s.x + damping_ * s.v; }

private:
    double stiffness_, damping_; ///< omega^2 [1/s^2], 2 zeta omega [1/s]
    double decay_;               ///< of the free motion [1/s]
    double square_;              ///< its circular frequency squared; negative: over-damped
    double free_stiffness_;      ///< stiffness over inertia [1/s^2]
};

} // namespace damslip::sliding
