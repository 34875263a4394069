#pragma once

#include "fe2d/time/integrate.hpp"
#include "scene/scene.hpp"

namespace damslip {

/// How a run on a bonded base is integrated.
struct TiedScheme {
    TimeScheme scheme = TimeScheme::hht; ///< never automatic
    std::string reason;                  ///< of "auto": one sentence; else empty
};

/// "auto" takes modes where the model is linear with Rayleigh damping and no waves leave, and the motion has more steps than the
/// modes cost solves.
TiedScheme tied_scheme(const Scene& scene, const GroundMotion& motion, const fe2d::TiedRunOptions& options);

/// What the scene's time.scheme means for its FE runs, for `explain`.
std::string time_scheme_note(const Scene& scene);

} // namespace damslip
