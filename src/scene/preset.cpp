#include "scene/preset.hpp"

namespace damslip {

void apply_preset(Scene& scene, const std::function<bool(const char* key)>& open)
{
    if (scene.analysis.preset != AnalysisPreset::goldgruber_2015) return;
    if (open("contact.enforcement")) scene.contact.enforcement = ContactEnforcement::slip_tolerance;
    if (open("contact.slip_tolerance")) scene.contact.slip_tolerance = 0.005;
    if (open("contact.separation")) scene.contact.separation = JointOpening::none;
    if (scene.foundation && open("foundation.mass")) scene.foundation->mass = RockMass::massless;
    if (scene.foundation && open("foundation.boundary")) scene.foundation->boundary = RockBoundary::fixed;
    if (scene.reservoir && open("reservoir.far_end")) scene.reservoir->far_end = FarEnd::damper;
    if (scene.reservoir && open("reservoir.bottom_motion")) scene.reservoir->bottom_motion = BottomMotion::still;
    if (scene.reservoir && open("reservoir.bottom_reflection") && !scene.reservoir->bottom_density)
        scene.reservoir->bottom_reflection = 1.0;
    if (open("damping.mass")) scene.damping.mass = MassDamping::relative;
    if (open("time.scheme")) scene.time.scheme = TimeScheme::hht;
    if (open("time.alpha")) scene.time.alpha = -1.0 / 3.0;
    if (open("time.dt")) scene.time.dt = 0.01;
    if (open("time.substeps") && open("time.slip_tolerance")) scene.time.substeps = 0;
}

} // namespace damslip
