#include "sliding/loads/added_mass.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace damslip::sliding {

namespace {

constexpr double zeta3 = 1.2020569031595942854; // Riemann zeta(3)

/// Sums over odd n of sin(n x)/n^2 and sin(n x)/n^4, 0 <= x <= pi/2.
struct SineSums {
    double second = 0.0, fourth = 0.0;
};

/// Coefficients of ln(tan u / u) = sum_k c_k u^2k: c_k = (4^k - 2) zeta(2k) / (k pi^2k).
double tangent_log_coefficient(int k)
{
    double zeta = 1.0; // zeta(2k), or its known value for the slowly converging ones
    if (k == 1) {
        zeta = std::numbers::pi * std::numbers::pi / 6.0;
    } else if (k == 2) {
        zeta = std::pow(std::numbers::pi, 4) / 90.0;
    } else {
        for (int n = 2; n <= 400; ++n) {
            const double term = std::pow(n, -2 * k);
            if (term < 1e-19) break;
            zeta += term;
        }
    }
    return (std::pow(4.0, k) - 2.0) * zeta / (k * std::pow(std::numbers::pi, 2 * k));
}

/// With d/dx sum sin(nx)/n^2 = -1/2 ln tan(x/2) and d2/dx2 sum sin(nx)/n^4 = - sum sin(nx)/n^2, both sums follow from
/// integrating the power series of ln(tan u / u), u = x/2 <= pi/4, term by term; terms shrink like 4^-k.
SineSums sine_sums(double x)
{
    if (x <= 0.0) return {};
    constexpr int terms = 27;
    static const std::array<double, terms> c = [] {
        std::array<double, terms> values{};
        for (int k = 1; k <= terms; ++k) values[static_cast<std::size_t>(k - 1)] = tangent_log_coefficient(k);
        return values;
    }();
    const double u2 = 0.25 * x * x, log_half = std::log(0.5 * x);
    double second = 0.0, fourth = 0.0, power = u2;
    for (int k = 1; k <= terms; ++k, power *= u2) {
        const double term = c[static_cast<std::size_t>(k - 1)] * power, d = 2.0 * k + 1.0;
        second += term / d;
        fourth += term / (d * (d + 1.0) * (d + 2.0));
    }
    return {-0.5 * x * (log_half - 1.0 + second),
            x * (0.875 * zeta3 + 0.5 * x * x * (log_half / 6.0 - 11.0 / 36.0 + fourth))};
}

} // namespace

double westergaard_series(double zeta, double tau)
{
    const double x = 0.5 * std::numbers::pi * zeta;
    const SineSums sums = sine_sums(x);
    double total = sums.second;
    if (tau > 0.0) {
        // 1/(n sqrt(n^2 - tau)) = 1/n^2 + tau/(2 n^4) + rest; the rest falls like 3 tau^2/(8 n^6): beyond n = 401 less
        // than 4e-15.
        total += 0.5 * tau * sums.fourth;
        for (int n = 401; n >= 1; n -= 2) {
            const double n2 = static_cast<double>(n) * n;
            const double rest = 1.0 / (n * std::sqrt(n2 - tau)) - 1.0 / n2 - 0.5 * tau / (n2 * n2);
            total += rest * std::sin(n * x);
        }
    }
    return total;
}

} // namespace damslip::sliding
