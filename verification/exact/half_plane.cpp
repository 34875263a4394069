#include "verification/exact/half_plane.hpp"

#include <cmath>
#include <gsl/gsl_integration.h>
#include <memory>
#include <numbers>

namespace damslip::exact {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;
constexpr int points = 16; ///< of Gauss' rule

enum class StripMotion { horizontal, vertical, rocking };

/// û of one wave number. R is written without the difference of large numbers it holds at large k.
Complex surface_motion(const HalfPlane& plane, StripMotion motion, double frequency, Complex k)
{
    const double ks = frequency / plane.shear_speed(), kp = frequency / plane.compression_speed();
    const Complex k2 = k * k, alpha = std::sqrt(k2 - kp * kp), beta = std::sqrt(k2 - ks * ks);
    const Complex product = alpha * beta;
    const Complex r =
        4.0 * k2 * (k2 * kp * kp - kp * kp * ks * ks - ks * ks * product) / (k2 + product) + ks * ks * ks * ks;
    return -(motion == StripMotion::horizontal ? beta : alpha) * ks * ks / (plane.shear_modulus * r);
}

/// ŵ²: sin z/z for a uniform traction, 3 k (sin z - z cos z)/z³ for x/I; z = k b.
Complex shape(StripMotion motion, Complex k, double b)
{
    const Complex z = k * b, z2 = z * z;
    if (motion != StripMotion::rocking) {
        const Complex s = std::abs(z) < 1e-3 ? 1.0 - z2 / 6.0 : std::sin(z) / z;
        return s * s;
    }
    const Complex s = std::abs(z) < 0.02 ? k * (1.0 - z2 / 10.0 + z2 * z2 / 280.0)
                                         : 3.0 * k * (std::sin(z) - z * std::cos(z)) / (z2 * z);
    return s * s;
}

Complex flexibility(const HalfPlane& plane, StripMotion motion, double frequency)
{
    const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> rule(
        gsl_integration_glfixed_table_alloc(points), &gsl_integration_glfixed_table_free);
    const double b = plane.half_width, ks = frequency / plane.shear_speed();
    const auto along = [&](Complex from, Complex to, int pieces) {
        Complex sum = 0.0;
        const Complex piece = (to - from) / static_cast<double>(pieces);
        for (int n = 0; n < pieces; ++n)
            for (std::size_t i = 0; i < points; ++i) {
                double s, weight;
                gsl_integration_glfixed_point(0.0, 1.0, i, &s, &weight, rule.get());
                const Complex k = from + piece * (n + s);
                sum += weight * piece * shape(motion, k, b) * surface_motion(plane, motion, frequency, k);
            }
        return sum;
    };
    // Over the poles, not so high that sin(k b) grows; then along the axis to k b = 2000 pi in quarters of its waves.
    const double height = std::min(0.5 * ks, 1.0 / b), end = 2000.0 * pi / b;
    const Complex up{0.5 * height, height}, down{1.5 * ks, height}, axis{1.5 * ks + height, 0.0};
    const auto pieces = [&](Complex from, Complex to) {
        return 8 + static_cast<int>(std::abs(to - from) * (b + 4.0 / height));
    };
    Complex sum = along(0.0, up, 16) + along(up, down, pieces(up, down)) + along(down, axis, 16);
    // in pieces that grow from the size of k_s to that of the shape's waves
    double reached = axis.real();
    while (reached < end) {
        const double next = std::min(end, reached + std::min(reached, 0.5 * pi / b));
        sum += along(reached, next, 1);
        reached = next;
    }
    // beyond, sin² and cos² by their mean: ŵ² = 1/(2 z²) or 9 k²/(2 z⁴), û = (1 - ν)/(G k)
    const double z = end * b, limit = (1.0 - plane.poisson_ratio) / plane.shear_modulus;
    sum += motion == StripMotion::rocking ? 9.0 * limit / (4.0 * z * z * b * b) : limit / (4.0 * z * z);
    return sum / pi; // both signs of k
}

} // namespace

double HalfPlane::shear_speed() const
{
    return std::sqrt(shear_modulus / density);
}
double HalfPlane::compression_speed() const
{
    return shear_speed() * std::sqrt(2.0 * (1.0 - poisson_ratio) / (1.0 - 2.0 * poisson_ratio));
}

Complex HalfPlane::horizontal(double frequency) const
{
    return flexibility(*this, StripMotion::horizontal, frequency);
}
Complex HalfPlane::vertical(double frequency) const
{
    return flexibility(*this, StripMotion::vertical, frequency);
}
Complex HalfPlane::rocking(double frequency) const
{
    return flexibility(*this, StripMotion::rocking, frequency);
}

} // namespace damslip::exact
