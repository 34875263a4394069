#include "verification/exact/timoshenko_beam.hpp"

#include <cmath>
#include <numbers>

namespace damslip::exact {

double TimoshenkoCantilever::tip_deflection(double force) const
{
    const double inertia = depth * depth * depth / 12.0;
    return force * length * length * length / (3.0 * young_modulus * inertia) +
           force * length / (shear_factor * shear_modulus * depth);
}

std::vector<double> TimoshenkoCantilever::frequencies(int count) const
{
    const double area = depth, inertia = depth * depth * depth / 12.0;
    const double r2 = inertia / (area * length * length);
    const double s2 = young_modulus * inertia / (shear_factor * area * shear_modulus * length * length);
    const auto equation = [&](double b) {
        const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4.0 / (b * b));
        const double a = std::sqrt((root - r2 - s2) / 2.0), c = std::sqrt((root + r2 + s2) / 2.0);
        return 2.0 + (b * b * (r2 - s2) * (r2 - s2) + 2.0) * std::cosh(b * a) * std::cos(b * c) -
               b * (r2 + s2) / std::sqrt(1.0 - b * b * r2 * s2) * std::sinh(b * a) * std::sin(b * c);
    };
    const double scale =
        std::sqrt(young_modulus * inertia / (density * area)) / (length * length * 2.0 * std::numbers::pi);
    std::vector<double> result;
    const double step = 0.05, cut_off = 1.0 / std::sqrt(r2 * s2);
    for (double b = step; static_cast<int>(result.size()) < count && b + step < cut_off; b += step) {
        if (equation(b) * equation(b + step) > 0.0) continue;
        double low = b, high = b + step;
        for (int i = 0; i < 100; ++i) {
            const double middle = 0.5 * (low + high);
            (equation(low) * equation(middle) <= 0.0 ? high : low) = middle;
        }
        result.push_back(0.5 * (low + high) * scale);
    }
    return result;
}

} // namespace damslip::exact
