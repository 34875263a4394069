#include "verification/exact/seepage.hpp"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_ellint.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::exact {

namespace {

using std::numbers::pi;

/// Images of the corners on the real axis.
struct Corners {
    double pile, m, z1, z2; ///< D, M, ζ1, ζ2
};

Corners corners(const SeepageUnderBase& s)
{
    const double half = pi / (2.0 * s.layer_depth);
    const double d = std::tan(half * s.pile_depth);
    return {d, std::hypot(1.0, d), -std::hypot(std::tanh(half * s.upstream), d),
            std::hypot(std::tanh(half * s.downstream), d)};
}

double modulus_squared(const Corners& c)
{
    return (c.z2 - c.z1) * 2.0 * c.m / ((c.m - c.z1) * (c.z2 + c.m));
}

/// 1 - k², without cancellation: (M-ζ2)(ζ1+M)/((M-ζ1)(ζ2+M)).
double complement(const Corners& c)
{
    return (c.m - c.z2) * (c.z1 + c.m) / ((c.m - c.z1) * (c.z2 + c.m));
}

double sign(double x, SeepageUnderBase::Side side)
{
    if (x != 0.0) return x < 0.0 ? -1.0 : 1.0;
    return side == SeepageUnderBase::Side::upstream ? -1.0 : 1.0;
}

struct Integrand {
    const SeepageUnderBase* base;
    SeepageUnderBase::Side side;
};

double integrand(double x, void* data)
{
    const auto* i = static_cast<const Integrand*>(data);
    return i->base->head(x, i->side);
}

double integral(const SeepageUnderBase& base, double from, double to, SeepageUnderBase::Side side)
{
    if (!(to > from)) return 0.0;
    Integrand data{&base, side};
    gsl_function function{integrand, &data};
    gsl_integration_workspace* work = gsl_integration_workspace_alloc(500);
    double value = 0.0, error = 0.0;
    gsl_integration_qags(&function, from, to, 0.0, 1e-9, 500, work, &value, &error);
    gsl_integration_workspace_free(work);
    return value;
}

} // namespace

double SeepageUnderBase::head(double x, Side side) const
{
    const Corners c = corners(*this);
    const double z = sign(x, side) * std::hypot(std::tanh(pi * x / (2.0 * layer_depth)), c.pile);
    const double sine2 = (c.z2 + c.m) * (z - c.z1) / ((c.z2 - c.z1) * (z + c.m));
    const double phi = std::asin(std::sqrt(std::clamp(sine2, 0.0, 1.0)));
    const double k = std::sqrt(modulus_squared(c));
    return 1.0 - gsl_sf_ellint_F(phi, k, GSL_PREC_DOUBLE) / gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE);
}

double SeepageUnderBase::discharge() const
{
    const Corners c = corners(*this);
    return gsl_sf_ellint_Kcomp(std::sqrt(complement(c)), GSL_PREC_DOUBLE) /
           gsl_sf_ellint_Kcomp(std::sqrt(modulus_squared(c)), GSL_PREC_DOUBLE);
}

double SeepageUnderBase::mean_head() const
{
    return (integral(*this, -upstream, 0.0, Side::upstream) + integral(*this, 0.0, downstream, Side::downstream)) /
           (upstream + downstream);
}

double SeepageUnderBase::head_deep(double x, Side side) const
{
    const double z1 = -std::hypot(upstream, pile_depth), z2 = std::hypot(downstream, pile_depth);
    const double z = sign(x, side) * std::hypot(x, pile_depth);
    return std::acos(std::clamp((2.0 * z - z1 - z2) / (z2 - z1), -1.0, 1.0)) / pi;
}

} // namespace damslip::exact
