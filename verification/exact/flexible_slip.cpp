#include "verification/exact/flexible_slip.hpp"

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

namespace {

/// x'' + 2 zeta omega x' + omega^2 x = a over one step h, a linear from a0 to a1.
void runge_kutta(const FlexibleSlipCase& c, double a0, double a1, double h, double& x, double& v)
{
    const auto accel = [&](double a, double at_x, double at_v) {
        return a - 2.0 * c.damping * c.omega * at_v - c.omega * c.omega * at_x;
    };
    const double middle = 0.5 * (a0 + a1);
    const double v1 = v, w1 = accel(a0, x, v1);
    const double v2 = v + 0.5 * h * w1, w2 = accel(middle, x + 0.5 * h * v1, v2);
    const double v3 = v + 0.5 * h * w2, w3 = accel(middle, x + 0.5 * h * v2, v3);
    const double v4 = v + h * w3, w4 = accel(a1, x + h * v3, v4);
    x += h * (v1 + 2.0 * v2 + 2.0 * v3 + v4) / 6.0;
    v += h * (w1 + 2.0 * w2 + 2.0 * w3 + w4) / 6.0;
}

/// Mode and excess of the drive over the yield at one instant.
struct Instant {
    double x = 0.0, v = 0.0, excess = 0.0, excess_rate = 0.0;
};

void set_excess(const FlexibleSlipCase& c, double a, double slope, Instant& now)
{
    const double x2 = a - 2.0 * c.damping * c.omega * now.v - c.omega * c.omega * now.x;
    const double x3 = slope - 2.0 * c.damping * c.omega * x2 - c.omega * c.omega * now.v;
    now.excess = a - c.mass_ratio * x2 - c.yield;
    now.excess_rate = slope - c.mass_ratio * x3;
}

/// The cubic through both ends of a step, and its integrals from the time `from` on.
struct Cubic {
    double c0, c1, c2, c3;

    double at(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
    double once(double t) const { return t * (c0 + t * (c1 / 2.0 + t * (c2 / 3.0 + t * c3 / 4.0))); }
    double twice(double t) const { return t * t * (c0 / 2.0 + t * (c1 / 6.0 + t * (c2 / 12.0 + t * c3 / 20.0))); }
};

Cubic through(const Instant& a, const Instant& b, double h)
{
    const double rise = (b.excess - a.excess) / h;
    return {a.excess, a.excess_rate, (3.0 * rise - 2.0 * a.excess_rate - b.excess_rate) / h,
            (a.excess_rate + b.excess_rate - 2.0 * rise) / (h * h)};
}

/// Where `negative` turns from true to false or back between lo and hi.
double turn(const std::function<bool(double)>& negative, double lo, double hi)
{
    const bool at_lo = negative(lo);
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (lo + hi);
        (negative(middle) == at_lo ? lo : hi) = middle;
    }
    return hi;
}

/// One way, s'' = e while it slides, over one step.
void slide_step(const Cubic& e, double h, double& rate, double& slip)
{
    double begin = 0.0;
    if (rate <= 0.0 && e.at(0.0) <= 0.0) {
        const double reached = e.at(h) > 0.0 ? h : 0.5 * h;
        if (e.at(reached) <= 0.0) return;
        begin = turn([&](double t) { return e.at(t) <= 0.0; }, 0.0, reached);
    }
    const auto rate_at = [&](double t) { return rate + e.once(t) - e.once(begin); };
    const auto path_at = [&](double t) {
        return rate * (t - begin) + e.twice(t) - e.twice(begin) - e.once(begin) * (t - begin);
    };
    double end = h;
    if (rate_at(h) < 0.0) {
        const double moving = rate > 0.0 ? begin : 0.5 * (begin + h);
        if (rate_at(moving) >= 0.0) end = turn([&](double t) { return rate_at(t) < 0.0; }, moving, h);
    }
    slip += std::max(0.0, path_at(end));
    rate = std::max(0.0, end < h ? 0.0 : rate_at(h));
}

} // namespace

double slip_decoupled_by_steps(const FlexibleSlipCase& c, std::span<const double> accel, double dt, double quiet,
                               double fineness)
{
    const double parts = std::ceil(std::max(fineness * c.omega * dt, 0.125 * fineness)), h = dt / parts;
    const auto n = static_cast<long>(accel.size()), end = n - 1 + std::lround(quiet / dt);
    Instant now;
    double rate = 0.0, slip = 0.0;
    for (long k = 0; k < end; ++k) {
        const double from = k < n - 1 ? accel[k] : 0.0, slope = k < n - 1 ? (accel[k + 1] - from) / dt : 0.0;
        set_excess(c, from, slope, now);
        for (double i = 0.0; i < parts; ++i) {
            const double a0 = from + slope * h * i, a1 = from + slope * h * (i + 1.0);
            Instant then = now;
            runge_kutta(c, a0, a1, h, then.x, then.v);
            set_excess(c, a1, slope, then);
            slide_step(through(now, then, h), h, rate, slip);
            now = then;
        }
    }
    return slip;
}

} // namespace damslip::exact
