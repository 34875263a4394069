#pragma once

#include "sliding/uplift/uplift_profile.hpp"

#include <functional>
#include <vector>

namespace damslip::sliding {

/// What presses the block on its base, uplift excepted.
struct BaseLoad {
    double normal = 0.0;            ///< total normal force on the base, compression positive [N/m]
    double moment_about_heel = 0.0; ///< of all loads, counter-clockwise [N m/m]
};

enum class CrackStatus {
    closed,  ///< compressed over the whole base
    partial, ///< open from one end, the rest compressed
    through, ///< partial, but what is left compressed could not carry it: see `cracked_through`
    open ///< no equilibrium without tension: effective resultant outside the base, or no effective normal force left
};

/// A joint in equilibrium with its uplift.
struct CrackedBase {
    CrackStatus status = CrackStatus::closed;
    Crack crack; ///< part that holds the full head [m]
    double compressed_length =
        0.0; ///< carries effective pressure [m]; can exceed what is left of the crack where it has closed again
    Side compressed_side = Side::toe; ///< end at which the compressed length lies
    PressureProfile profile;
    UpliftResultant uplift;
    double effective_normal = 0.0;   ///< N' = N - U [N/m]
    double resultant_distance = 0.0; ///< of N' from the heel along the base [m]; NaN for N' = 0
};

/// A ligament that is no answer: shorter than 2 % of the base, where the triangle of pressure has a hundred times the mean
/// of the whole base at its end (30 to 300 MPa below dams of 20 to 200 m) and the resultant lies within 0.7 % of the base
/// from its end, closer than section and levels are known; or pressed by more than 50 MPa, beyond the strength of the
/// concrete of dams (15 to 40 MPa). False for a base that is closed, or open.
bool cracked_through(const CrackedBase& base, double length);

/// The base without any crack: linear effective stress, tension allowed.
CrackedBase uncracked_base(const BaseLoad& load, double length, const PressureProfile& profile);

/// Uplift for each crack.
using CrackUplift = std::function<PressureProfile(const Crack&)>;

/// No-tension joint: finds the shortest crack T for which the effective stress is a triangle over the rest,
///     L - T = 3 x (distance of N' from the compressed end),   N' = N - U(T),
/// by scanning between the events and bisecting the first bracket, so it always ends; the result is exact to round-off.
/// The end that would be in tension opens. No such T: status open, crack over the whole base.
/// @param opened  a crack that holds water already (after an earthquake); it does not heal, though it may carry
/// pressure again
/// @param events  distances from the heel where U jumps when the tip passes (curtain, drains) [m]
CrackedBase cracked_base(const BaseLoad& load, double length, const CrackUplift& uplift, const Crack& opened = {},
                         const std::vector<double>& events = {});

} // namespace damslip::sliding
