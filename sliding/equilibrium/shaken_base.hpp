#pragma once

#include "sliding/equilibrium/base_state.hpp"

#include <optional>
#include <vector>

namespace damslip::sliding {

/// Loads of the ground acceleration (-a_h, +a_v) [m/s^2]: inertia (+m a_h, -m a_v) at the centroid and the added mass'
/// force. a_h is positive upstream: it drives the dam downstream.
std::vector<Load> earthquake_loads(const Scene& scene, const AddedMassIntegral& water, double a_h, double a_v);

/// The base under static and earthquake loads together (`load`), from the static state `before`; see `evaluate` for the
/// crack rules.
CrackedBase shaken_base(const Scene& scene, const StaticCase& static_case, const BaseState& before, const Force& load,
                        const SeepageProfile& seepage);

/// Pressure of the static state with that part of the joint set to zero which the earthquake opens.
PressureProfile without_new_crack(const BaseState& before, const Crack& crack);

/// Uplift of a joint open from end to end, by uplift.opening: `zero` nothing but what the crack of the static state holds,
/// `full` and `mouth` the higher of the heads at both ends along the whole base.
/// @param opens  the end at which the base leaves the rock
/// @returns none where uplift.opening leaves the uplift as it is: unchanged, reynolds, no uplift
std::optional<UpliftResultant> uplift_of_open_joint(const Scene& scene, const StaticCase& static_case,
                                                    const BaseState& before, Side opens, const SeepageProfile& seepage);

/// The same joint before any water has come into it, whatever uplift.opening says: what `zero` leaves.
UpliftResultant uplift_of_empty_joint(const BaseState& before, Side opens);

/// The static state with the uplift of the joint that is open from `opens` to the other end, where uplift.opening names one:
/// what tips about that other end stands on it.
BaseState with_open_joint(const Scene& scene, const StaticCase& static_case, const BaseState& before, Side opens,
                          const SeepageProfile& seepage);

/// Length still bonded [m]: neither in the static crack nor in the one under the earthquake.
double bonded_length(const BaseState& before, const CrackedBase& base);

} // namespace damslip::sliding
