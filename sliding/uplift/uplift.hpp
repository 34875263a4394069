#pragma once

#include "scene/uplift_models.hpp"
#include "scene/water.hpp"

#include <functional>
#include <utility>
#include <vector>

namespace damslip::sliding {

enum class Side { heel, toe };

/// An open joint under the base that starts at one end and holds the full head of that end's water.
struct Crack {
    Side side = Side::heel;
    double length = 0.0; ///< along the base [m]
};

/// Gives the uncracked profile of uplift.model = "seepage" (the seepage solver lives elsewhere).
using SeepageProfile = std::function<PressureProfile(const UpliftState&)>;

/// One solution for every state: for callers that solve the seepage once.
inline SeepageProfile fixed_profile(PressureProfile profile)
{
    return [profile = std::move(profile)](const UpliftState&) { return profile; };
}

/// The uplift of the scene's model. Pressures at the ends: gamma_w h at the heel, gamma_w (h_t - y_toe) at the toe, 0
/// where dry.
///
/// - none, or no [uplift]: no pressure at all, in a crack neither.
/// - linear: heel to toe; also curtain or drains that do not work.
/// - curtain: linear from the heel to p_low + r (p_high - p_low) at the curtain's distance, then linear to the toe; p_low,
///   p_high: the lower and higher of the end pressures. Goldgruber (2015) sec. 4.2 with r = 2/3 ("printed rule").
/// - drains: H3 = H2 + (1 - E)(H1 - H2)(L - X)/L at the drains, linear to both ends, USACE EM 1110-2-2200. A gallery above
///   H2 puts its level H4 in the place of H2. H are heads above the heel, so p3 = gamma_w (H3 - y(X)), at least 0 and at
///   most the pressure without drains. A dry end has the head of its own elevation.
/// - points: p/p_heel over the distance [m], p_heel = gamma_w h.
/// - seepage: as the solver says.
/// With water flowing upstream (tailwater higher) curtain and drains are read from the other end: the mirrored dam
/// gives the mirrored profile.
///
/// A crack holds the head of its own end over its whole length; one from end to end holds the higher of the two. Beyond
/// its tip:
///
/// - linear: straight to the other end.
/// - curtain: as uncracked until the crack reaches the curtain, then linear.
/// - drains: (L - X)/(L - T) in place of (L - X)/L, T the crack length; E = 0 once the crack has reached the drains
///   (EM 1110-2-2200).
/// - points, seepage: unchanged, with a jump at the tip.
///
/// @param seepage  used by uplift.model = "seepage" only
/// Errors: InputError if the model lacks what it needs ([curtain], [drains], a seepage profile, points from 0 to the
/// base length).
PressureProfile uplift_profile(const Scene& scene, const UpliftState& state, const Crack& crack = {},
                               const SeepageProfile& seepage = {});

/// Distances from the heel at which the profile changes its form when the crack tip passes: curtain, drains [m].
std::vector<double> crack_events(const Scene& scene);

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

/// cracked_base() where the uplift stays as it is, whatever opens: the same bits, without asking for the profile of each
/// crack that is looked at.
CrackedBase cracked_base_unchanged(const BaseLoad& load, double length, const PressureProfile& profile);

} // namespace damslip::sliding
