#include "exact/flexible_slip.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::exact {

double slip_under_step(const FlexibleSlipCase& c, double A, double t)
{
    const double x = c.yield / (c.omega * c.omega) * (1.0 - std::cos(c.omega * t / std::sqrt(1.0 - c.mass_ratio)));
    return 0.5 * (A - c.yield) * t * t - c.mass_ratio * x;
}

double slip_by_impulses(const FlexibleSlipCase& c, const std::function<double(double)>& accel, double duration,
                        double h)
{
    // Per mass of the block: [1 G; G G] (s'', x'') = (a - friction, G (a - 2 zeta omega x' - omega^2 x)).
    const double g = c.mass_ratio;
    double s = 0.0, x = 0.0, w = 0.0, u = 0.0;
    const auto steps = static_cast<long>(std::llround(duration / h));
    for (long k = 0; k < steps; ++k) {
        const double a = accel((static_cast<double>(k) + 0.5) * h);
        const double pull = a - 2.0 * c.damping * c.omega * u - c.omega * c.omega * x;
        const double w_free = w + h * (a - g * pull) / (1.0 - g);
        const double u_free = u + h * (pull - a) / (1.0 - g);
        const double impulse = std::clamp((1.0 - g) * w_free, -c.yield * h, c.yield * h);
        w = w_free - impulse / (1.0 - g);
        u = u_free + impulse / (1.0 - g);
        s += h * w;
        x += h * u;
    }
    return s;
}

} // namespace damslip::exact
