#include "verification/exact/added_mass.hpp"

#include <cmath>
#include <gsl/gsl_sf_clausen.h>
#include <gsl/gsl_sf_zeta.h>
#include <numbers>

namespace damslip::exact {

namespace {
using std::numbers::pi;
constexpr double catalan = 0.91596559417721901505;
constexpr double beta4 = 0.98894455174110533611; // Dirichlet beta(4)
} // namespace

double westergaard_sine_sum(double zeta, double tau)
{
    const double x = 0.5 * pi * zeta;
    double sum = 0.0;
    if (tau > 0.0)
        for (int n = 40001; n >= 1; n -= 2) {
            const double n2 = static_cast<double>(n) * n;
            // 1/(n sqrt(n^2 - tau)) - 1/n^2 without cancellation
            const double root = std::sqrt(1.0 - tau / n2);
            sum += std::sin(n * x) / n2 * (tau / n2) / (root * (1.0 + root));
        }
    return gsl_sf_clausen(x) - 0.25 * gsl_sf_clausen(2.0 * x) + sum;
}

double westergaard_total()
{
    return 14.0 * gsl_sf_zeta(3.0) / (pi * pi * pi);
}

double westergaard_height()
{
    const double moment = 8.0 / (pi * pi) * (1.75 / pi * gsl_sf_zeta(3.0) - 4.0 / (pi * pi) * beta4);
    return moment / westergaard_total();
}

double westergaard_base()
{
    return 8.0 * catalan / (pi * pi);
}

double zangar_total()
{
    return 0.365 * (2.0 / 3.0 + 0.25 * pi);
}

double goldgruber_total()
{
    return 0.707 * std::tgamma(0.8) / (std::sqrt(pi) * std::tgamma(1.3));
}

} // namespace damslip::exact
