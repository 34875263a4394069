#include "verification/exact/reservoir.hpp"

#include <cmath>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_bessel.h>
#include <numbers>

namespace damslip::exact {

namespace {
using std::numbers::pi;
using Complex = std::complex<double>;
constexpr Complex i_unit{0.0, 1.0};
} // namespace

double InfiniteReservoir::first_frequency() const
{
    return pi * sound_speed / (2.0 * depth);
}

std::vector<Complex> InfiniteReservoir::depth_wave_numbers(double frequency, int terms) const
{
    // z cos z + i b sin z = 0, from z = (n - 1/2) pi at b = 0 followed in b by Newton's method.
    const double b_end = frequency * depth / sound_speed * (1.0 - bottom_reflection) / (1.0 + bottom_reflection);
    std::vector<Complex> roots;
    for (int n = 1; n <= terms; ++n) {
        Complex z = (n - 0.5) * pi;
        const int steps = b_end > 0.0 ? 40 : 0;
        for (int k = 1; k <= steps; ++k) {
            const double b = b_end * k / steps;
            for (int iteration = 0; iteration < 20; ++iteration) {
                const Complex value = z * std::cos(z) + i_unit * b * std::sin(z);
                const Complex slope = std::cos(z) - z * std::sin(z) + i_unit * b * std::cos(z);
                const Complex change = value / slope;
                z -= change;
                if (std::abs(change) < 1e-14 * std::abs(z)) break;
            }
        }
        roots.push_back(z);
    }
    return roots;
}

Complex InfiniteReservoir::wall_force(double frequency, int terms) const
{
    const double kappa = frequency * depth / sound_speed;
    Complex sum = 0.0;
    for (const Complex& z : depth_wave_numbers(frequency, terms)) {
        Complex k = std::sqrt(z * z - kappa * kappa);
        if (k.real() < 0.0 || (k.real() == 0.0 && k.imag() < 0.0)) k = -k;
        const Complex integral = (1.0 - std::cos(z)) / z, norm = 0.5 - std::sin(2.0 * z) / (4.0 * z);
        sum += integral * integral / (k * norm);
    }
    return sum;
}

double InfiniteReservoir::step_force(double time, int terms) const
{
    // The argument reaches x_n = mu_n c t; J0's integral in pieces of length 1 by Gauss' rule with 10 points.
    gsl_integration_glfixed_table* rule = gsl_integration_glfixed_table_alloc(10);
    gsl_function j0{[](double x, void*) { return gsl_sf_bessel_J0(x); }, nullptr};
    double sum = 0.0, integral = 0.0, reached = 0.0;
    for (int n = 1; n <= terms; ++n) {
        const double mu = (n - 0.5) * pi, x = mu * sound_speed * time / depth;
        while (reached < x) {
            const double next = std::min(x, reached + 1.0);
            integral += gsl_integration_glfixed(&j0, reached, next, rule);
            reached = next;
        }
        sum += integral / (mu * mu * mu);
    }
    gsl_integration_glfixed_table_free(rule);
    return 2.0 * sum;
}

Complex duct_pressure(double frequency, double length, double sound_speed, double reflection)
{
    const double kappa = frequency * length / sound_speed;
    const Complex back = reflection * std::exp(-2.0 * i_unit * kappa);
    return (1.0 + back) / (1.0 - back) / (i_unit * kappa);
}

std::vector<double> piston_and_column(double mass, double stiffness, double density, double sound_speed, double length,
                                      int count)
{
    const auto residual = [&](double w) { // times cos, so without poles
        const double k = w / sound_speed;
        return (stiffness - w * w * mass) * std::cos(k * length) - w * sound_speed * density * std::sin(k * length);
    };
    std::vector<double> roots;
    const double step = 0.01 * sound_speed / length;
    for (double w = step; static_cast<int>(roots.size()) < count; w += step) {
        double low = w, high = w + step;
        if ((residual(low) > 0.0) == (residual(high) > 0.0)) continue;
        for (int k = 0; k < 80; ++k) {
            const double middle = 0.5 * (low + high);
            ((residual(middle) > 0.0) == (residual(low) > 0.0) ? low : high) = middle;
        }
        roots.push_back(0.5 * (low + high));
    }
    return roots;
}

} // namespace damslip::exact
