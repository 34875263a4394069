#pragma once

#include <optional>
#include <span>

/// What a sequence of refined results says about its limit.
namespace damslip {

/// Orders an extrapolation relies on: contact with moving edges is of first order at worst, the schemes and elements
/// of second at best.
inline constexpr double least_order = 1.0, largest_order = 2.0;

/// Order p of e_k = c r^(-p k), from the last three values v_k = v + e_k: ln(|v1 - v0| / |v2 - v1|) / ln r. Nothing for
/// fewer values or where the last two agree. It is what the values show, whatever that is.
/// @param ratio  r of sizes from one value to the next, > 1 [-]
std::optional<double> observed_order(std::span<const double> values, double ratio = 2.0);

/// The same where the limit is known: ln(|e1| / |e2|) / ln r of the last two errors.
std::optional<double> order_of_errors(std::span<const double> errors, double ratio);

/// Observed orders of sequences that converge as they should, accidents allowed for: outside, values are not yet, or not
/// only, following the power law that extrapolation rests on.
inline constexpr double lowest_plausible_order = 0.5, highest_plausible_order = 2.5;

struct Limit {
    double value = 0.0;
    double correction = 0.0;     ///< value - last value of the sequence
    std::optional<double> order; ///< observed

    bool plausible() const { return !order || (*order >= lowest_plausible_order && *order <= highest_plausible_order); }
};

/// Richardson's extrapolation (Richardson 1911; Roache 1998) of values from coarse to fine, each size 1/ratio of the one
/// before: v + (v_n - v_(n-1)) / (r^p - 1) with the observed order, held between least_order and largest_order.
/// @param elsewhere  order observed in another sequence, for two values; none: first order. Nothing for fewer values.
std::optional<Limit> extrapolated(std::span<const double> values, double ratio = 2.0,
                                  const std::optional<double>& elsewhere = {});

} // namespace damslip
