#pragma once

#include "random/random_scene.hpp"

namespace damslip::random {

/// Fills in both accelerograms: ten to sixty samples of a few pulses, some without any motion, some that begin at full
/// strength, some of one sample only.
void random_motion(Draw& draw, SceneFiles& files);

} // namespace damslip::random
