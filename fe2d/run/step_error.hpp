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

/// Order in the step that an estimate relies on at most, whatever the slips show: of hard contact and friction. Slips show 1.75 on
/// average (docs/verification.md, fe.sliding.order-in-step), single ones less.
inline constexpr double contact_order = 1.5;
/// Of what changes at an instant, which falls on a step's end: a bond that breaks, water that enters a joint, strength that follows the
/// slip from one step to the next.
inline constexpr double sudden_order = 1.0;

/// Factors of safety of the grid convergence index (Roache 1994, J. Fluids Eng. 116, 405-413): the error that rests on two slips is
/// three times what their change shows, one that rests on three and the order they show a quarter more.
struct SafetyFactor {
    double of_two = 3.0, of_three = 1.25;
};
inline constexpr SafetyFactor safety_factor;

/// Order p of the error, as c (dt / 2^k)^p, that the changes between the last three slips show, 1 <= p <= largest: contact with
/// moving edges converges with first order at worst. 1 for fewer slips.
/// @param largest  >= 1
double observed_order(std::span<const SlipAtStep> slips, double largest = contact_order);

/// Error of the last of at least two slips, F change / (2^(p (k - j)) - 1) with the observed order p and the factor of safety F [m].
/// The change is that of the whole history: at its end alone errors of several slides may cancel. One that is smaller than the one
/// before by more than the largest order explains is an accident, and counts as large as with that order.
double step_error(std::span<const SlipAtStep> slips, double largest = contact_order);

/// Halvings to try next: one more, or two more after the first two slips when one more cannot bring the error down to what is wanted.
/// @param excess  error over what is wanted, > 1 [-]
int next_halvings(std::span<const SlipAtStep> slips, double excess, double largest = contact_order);

/// Largest difference of two slip histories on the same steps, as far as both go, and of their last values [m].
/// @pre neither is empty
double largest_difference(std::span<const double> a, std::span<const double> b);

/// The same of runs of several events, each compared from its own first row on: a dam that rests sooner meets the next event
/// sooner. @param a_starts, b_starts  rows, ascending, the first one 0
double largest_difference(std::span<const double> a, std::span<const std::size_t> a_starts, std::span<const double> b,
                          std::span<const std::size_t> b_starts);

} // namespace damslip::fe2d
