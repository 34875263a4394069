#pragma once

#include <cstddef>
#include <span>

namespace damslip::fe2d {

/// A slip computed with steps of dt / 2^halvings.
struct SlipAtStep {
    int halvings = 0;
    double slip = 0.0;   ///< at the end [m]
    double change = 0.0; ///< from the slip before, at whatever time it is largest; of the first one 0 [m]
};

/// Orders in the step that an estimate relies on.
struct OrderInStep {
    double largest; ///< >= 1: more is not relied on, whatever the slips show
    double
        believable; ///< >= largest: a change that is smaller than the one before by more than this order explains is an accident
};

/// Of hard contact and friction. Slips show 1.75 on average (docs/verification.md, fe.sliding.order-in-step); held to that, 3 of 26 slips
/// of the examples erred by more than was said, by a quarter at most, with 1.5 none (scripts/step_error.py).
inline constexpr OrderInStep contact_order{1.5, 2.5};
/// Of joints that change at an instant, where a bond breaks or water enters: it falls on a step's end, so changes scatter with first order.
inline constexpr OrderInStep sudden_order{1.0, 1.0};

/// Order p of the error, as c (dt / 2^k)^p, that the changes between the last three slips show, 1 <= p <= orders.largest: contact with
/// moving edges converges with first order at worst. 1 for fewer slips.
double observed_order(std::span<const SlipAtStep> slips, OrderInStep orders = contact_order);

/// Error of the last of at least two slips, change / (2^(p (k - j)) - 1) with the observed order [m]. The change is that of the whole
/// history: at its end alone errors of several slides may cancel. One that is smaller than the one before by more than the
/// believable order explains counts as large as with that order.
double step_error(std::span<const SlipAtStep> slips, OrderInStep orders = contact_order);

/// Halvings to try next: one more, or two more after the first two slips when the error is far from what is wanted even
/// if it falls with second order. @param excess  error over what is wanted, > 1 [-]
int next_halvings(std::span<const SlipAtStep> slips, double excess);

/// Largest difference of two slip histories on the same steps, as far as both go, and of their last values [m].
/// @pre neither is empty
double largest_difference(std::span<const double> a, std::span<const double> b);

/// The same of runs of several events, each compared from its own first row on: a dam that rests sooner meets the next event
/// sooner. @param a_starts, b_starts  rows, ascending, the first one 0
double largest_difference(std::span<const double> a, std::span<const std::size_t> a_starts, std::span<const double> b,
                          std::span<const std::size_t> b_starts);

} // namespace damslip::fe2d
