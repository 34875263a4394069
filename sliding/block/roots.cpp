#include "sliding/block/roots.hpp"

#include <vector>

namespace damslip::sliding {
namespace {

bool has_constant_sign(std::span<const double> c, double span)
{
    double rest = 0.0, power = span;
    for (std::size_t i = 1; i < c.size(); ++i, power *= span) rest += std::abs(c[i]) * power;
    return std::abs(c[0]) > rest;
}

/// All sign changes in (0, span), ascending.
std::vector<double> sign_changes(std::span<const double> c, double span)
{
    if (c.size() < 2 || has_constant_sign(c, span)) return {};
    std::vector<double> derivative(c.size() - 1);
    for (std::size_t i = 1; i < c.size(); ++i) derivative[i - 1] = static_cast<double>(i) * c[i];
    std::vector<double> ends = sign_changes(derivative, span);
    ends.push_back(span);
    std::vector<double> found;
    double lo = 0.0, f_lo = c[0];
    for (const double hi : ends) {
        const double f_hi = polynomial(c, hi);
        if ((f_lo < 0.0 && f_hi > 0.0) || (f_lo > 0.0 && f_hi < 0.0))
            found.push_back(bracketed_root([&](double x) { return polynomial(c, x); }, lo, hi));
        else if (f_lo == 0.0 && lo > 0.0)
            found.push_back(lo);
        lo = hi;
        f_lo = f_hi;
    }
    return found;
}

} // namespace

double first_fall_to_zero(std::span<const double> c, double span)
{
    // Zero coefficients at the low end are a root at x = 0 that is not asked for: divide it out.
    while (!c.empty() && c[0] == 0.0) c = c.subspan(1);
    if (c.empty()) return never;
    if (c[0] < 0.0) return 0.0;
    const std::vector<double> roots = sign_changes(c, span);
    if (!roots.empty()) return roots.front();
    return polynomial(c, span) <= 0.0 ? span : never;
}

} // namespace damslip::sliding
