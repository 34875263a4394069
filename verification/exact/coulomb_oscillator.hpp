#pragma once

#include <vector>

namespace damslip::exact {

/// Oscillator on a rough plane under a harmonic load, displacements in units of F_0/k:
///
///     u'' = w^2 [cos(W t) - u - f sgn(u')],   f = F_f/F_0, w^2 = k/m
///
/// Between reversals the friction is a constant, so with r = W/w, V = 1/(1 - r^2) and the direction s = +-1
///
///     u = V cos(W t) - s f + A cos w(t - t_0) + B sin w(t - t_0),   A, B from u, u' at t_0
///
/// A piece of sliding ends at the first zero of u', found by bisection; there the load decides: |cos(W t) - u| <= f
/// sticks (a stop) until the difference exceeds f, otherwise sliding goes on the other way. No step size enters.
struct CoulombOscillator {
    double frequency;         ///< w [rad/s]
    double drive;             ///< W [rad/s]
    double friction;          ///< f [-], 0 <= f < 1
    double amplitude() const; ///< Den Hartog (1931), motion without stops: X k/F_0 = sqrt(V^2 - f^2 U^2), U = sin(pi/r)
                              ///< / (r (1 + cos(pi/r)))
};

class CoulombMotion {
public:
    /// From rest at u = 0, t = 0.
    CoulombMotion(const CoulombOscillator& oscillator, double duration);

    double displacement(double t) const;          ///< 0 <= t <= duration [F_0/k]
    double velocity(double t) const;              ///< [F_0/k per s]
    int stops(double from, double to) const;      ///< pieces of sticking that begin in this time
    double largest(double from, double to) const; ///< largest |u| at the ends of pieces in this time

private:
    /// direction 0: at rest at `offset`.
    struct Piece {
        double start, direction, offset, cosine, sine;
    };
    const Piece& piece_at(double t) const;
    double displacement(const Piece& piece, double t) const;
    double velocity(const Piece& piece, double t) const;
    Piece next(double t, double u) const;
    double end_of(const Piece& piece) const;

    CoulombOscillator o_;
    double response_; ///< V
    double duration_;
    std::vector<Piece> pieces_;
};

} // namespace damslip::exact
