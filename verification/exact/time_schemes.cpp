#include "verification/exact/time_schemes.hpp"

#include <gsl/gsl_poly.h>

#include <algorithm>
#include <cmath>

namespace damslip::exact {

namespace {

using Complex = std::complex<double>;

/// q2 z² + q1 z + q0 = 2ζΩ V(z)(z-1) + Ω² P(z)
struct Quadratic {
    double q2, q1, q0;
};

Quadratic force_polynomial(const SchemeParameters& s, double damping_ratio, double omega_dt)
{
    const double c = 2.0 * damping_ratio * omega_dt, k = omega_dt * omega_dt;
    return {c * s.gamma + k * s.beta, c * (1.0 - 2.0 * s.gamma) + k * (0.5 + s.gamma - 2.0 * s.beta),
            -c * (1.0 - s.gamma) + k * (0.5 - s.gamma + s.beta)};
}

} // namespace

std::array<Complex, 3> scheme_roots(const SchemeParameters& s, double damping_ratio, double omega_dt)
{
    const Quadratic q = force_polynomial(s, damping_ratio, omega_dt);
    const double lead = 1.0 + (1.0 + s.alpha) * q.q2;
    const double a = (-2.0 + (1.0 + s.alpha) * q.q1 - s.alpha * q.q2) / lead;
    const double b = (1.0 + (1.0 + s.alpha) * q.q0 - s.alpha * q.q1) / lead;
    const double c = -s.alpha * q.q0 / lead;
    gsl_complex z0, z1, z2;
    gsl_poly_complex_solve_cubic(a, b, c, &z0, &z1, &z2);
    std::array<Complex, 3> roots{Complex(GSL_REAL(z0), GSL_IMAG(z0)), Complex(GSL_REAL(z1), GSL_IMAG(z1)),
                                 Complex(GSL_REAL(z2), GSL_IMAG(z2))};
    // Polish: the cubic formula loses digits where roots are close together.
    for (Complex& z : roots)
        for (int k = 0; k < 3; ++k) {
            const Complex slope = (3.0 * z + 2.0 * a) * z + b;
            if (std::abs(slope) > 1e-8) z -= (((z + a) * z + b) * z + c) / slope;
        }
    std::sort(roots.begin(), roots.end(), [](const Complex& x, const Complex& y) {
        return std::abs(std::abs(x) - std::abs(y)) > 1e-12 ? std::abs(x) > std::abs(y) : x.imag() > y.imag();
    });
    return roots;
}

NumericalVibration numerical_vibration(const SchemeParameters& scheme, double damping_ratio, double omega_dt)
{
    const auto roots = scheme_roots(scheme, damping_ratio, omega_dt);
    std::size_t pair = 0;
    while (pair < 2 && !(roots[pair].imag() > 0.0)) ++pair;
    const double angle = std::arg(roots[pair]), modulus = std::abs(roots[pair]);
    return {omega_dt * std::sqrt(1.0 - damping_ratio * damping_ratio) / angle, -std::log(modulus) / angle, modulus};
}

DiscreteResponse discrete_steady_state(const SchemeParameters& s, double omega, double damping_ratio, double load_omega,
                                       double dt)
{
    const Complex z = std::polar(1.0, load_omega * dt);
    const Complex p = s.beta * z * z + (0.5 + s.gamma - 2.0 * s.beta) * z + (0.5 - s.gamma + s.beta);
    const Complex v = s.gamma * z + 1.0 - s.gamma, weight = (1.0 + s.alpha) * z - s.alpha;
    // z a = weight (f - 2ζω v - ω² u),  u = dt² p a / (z-1)²,  v = dt V a / (z-1)
    const Complex per_acceleration =
        2.0 * damping_ratio * omega * dt * v / (z - 1.0) + omega * omega * dt * dt * p / ((z - 1.0) * (z - 1.0));
    const Complex a = weight / (z + weight * per_acceleration);
    return {dt * dt * p * a / ((z - 1.0) * (z - 1.0)), dt * v * a / (z - 1.0), a};
}

} // namespace damslip::exact
