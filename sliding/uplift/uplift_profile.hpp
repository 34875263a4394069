#pragma once

#include "scene/uplift_models.hpp"
#include "scene/water.hpp"

#include <functional>
#include <utility>

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

} // namespace damslip::sliding
