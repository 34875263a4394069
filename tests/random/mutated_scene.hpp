#pragma once

#include "random/random_scene.hpp"

namespace damslip::random {

/// A shipped example as a person in a hurry would leave it: some of its numbers a little or a thousand times off, lines or
/// tables gone, values of two lines exchanged, keys of the table of keys at the ends of what is usual or allowed, keys added that
/// make a run hard (cohesion, few sub-steps, a tight tolerance, a coarse mesh). Under a drawn motion of a few pulses, on a coarse mesh, so that it runs in a fraction of a second.
SceneFiles mutated_scene(Draw& draw);

} // namespace damslip::random
