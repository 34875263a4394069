#pragma once

#include <span>

namespace damslip::fe2d {

/// A slip computed with steps of dt / 2^halvings.
struct SlipAtStep {
    int halvings = 0;
    double slip = 0.0; ///< [m]
};

/// Largest order in the step that an estimate relies on: the mean of what slips show (docs/verification.md,
/// fe.sliding.order-in-step).
inline constexpr double largest_order = 1.75;

/// Order p of the error, as c (dt / 2^k)^p, that the last three slips show, 1 <= p <= largest_order: contact with moving
/// edges converges with first order at worst. 1 for fewer slips.
double observed_order(std::span<const SlipAtStep> slips);

/// Error of the last of at least two slips, |s_k - s_j| / (2^(p (k - j)) - 1) with the observed order [m]. A difference
/// that is smaller than the one before by more than order 2.5 explains counts as large as with that order.
double step_error(std::span<const SlipAtStep> slips);

/// Halvings to try next: one more, or two more after the first two slips when the error is far from what is wanted even
/// if it falls with second order. @param excess  error over what is wanted, > 1 [-]
int next_halvings(std::span<const SlipAtStep> slips, double excess);

} // namespace damslip::fe2d
