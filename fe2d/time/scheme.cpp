#include "fe2d/time/scheme.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

namespace {

[[noreturn]] void refuse(const std::string& key, double value, std::string expected, std::string fix)
{
    Diagnostic diagnostic;
    diagnostic.problem = key + " = " + shortest(value) + " is not allowed.";
    diagnostic.expected = std::move(expected);
    diagnostic.fix = std::move(fix);
    throw InputError(std::move(diagnostic));
}

} // namespace

Scheme hht(double alpha)
{
    if (!(alpha >= -1.0 / 3.0 - 1e-12 && alpha <= 0.0))
        refuse("time.alpha", alpha, "HHT alpha, -1/3 <= alpha <= 0, no unit",
               "write  alpha = -0.05 ; alpha = 0 switches the numerical damping off");
    return {alpha, 0.5 - alpha, 0.25 * (1.0 - alpha) * (1.0 - alpha)};
}

Scheme newmark(double gamma, double beta)
{
    if (!(gamma >= 0.5 && gamma <= 1.0))
        refuse("time.gamma", gamma, "Newmark gamma, 0.5 <= gamma <= 1, no unit (below 0.5 every step gains energy)",
               "write  gamma = 0.5 ; for numerical damping use  scheme = \"hht\"");
    if (!(beta > 0.0 && beta <= 1.0))
        refuse("time.beta", beta, "Newmark beta, 0 < beta <= 1, no unit",
               "write  beta = 0.25  (average acceleration, stable at any step)");
    return {0.0, gamma, beta};
}

Scheme average_acceleration()
{
    return {0.0, 0.5, 0.25};
}

Scheme linear_acceleration()
{
    return {0.0, 0.5, 1.0 / 6.0};
}

Scheme scheme_of(const TimeOptions& options)
{
    return options.scheme == TimeScheme::newmark ? newmark(options.gamma, options.beta) : hht(options.alpha);
}

double stability_limit(const Scheme& scheme)
{
    if (scheme.unconditionally_stable()) return std::numeric_limits<double>::infinity();
    return 1.0 / std::sqrt(0.5 * scheme.gamma - scheme.beta);
}

void check_step(const Scheme& scheme, double dt, double highest_frequency)
{
    if (!(dt > 0.0) || !std::isfinite(dt))
        refuse("time.dt_s", dt, "time step, a number > 0, in seconds", "leave it out to use the record's step");
    if (scheme.unconditionally_stable()) return;
    const double limit = stability_limit(scheme) / highest_frequency;
    if (dt > limit)
        refuse("time.dt_s", dt,
               "at most " + shortest(limit) + " s: Newmark gamma = " + shortest(scheme.gamma) +
                   ", beta = " + shortest(scheme.beta) + " is stable up to dt = " + shortest(stability_limit(scheme)) +
                   " / omega, and the model's highest omega is " + shortest(highest_frequency) +
                   " rad/s (infinite: it has massless nodes)",
               "use  scheme = \"hht\"  or  beta = 0.25 , stable at any step");
}

StepConstants step_constants(const Scheme& scheme, double dt)
{
    assert(dt > 0.0 && scheme.beta > 0.0);
    const double beta = scheme.beta, gamma = scheme.gamma;
    StepConstants c;
    c.scheme = scheme;
    c.dt = dt;
    c.a0 = 1.0 / (beta * dt * dt);
    c.a1 = gamma / (beta * dt);
    c.a2 = 1.0 / (beta * dt);
    c.a3 = 0.5 / beta - 1.0;
    c.a4 = gamma / beta - 1.0;
    c.a5 = dt * (0.5 * gamma / beta - 1.0);
    return c;
}

} // namespace damslip::fe2d
