#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// Hydraulic conductivity of the rock [m/s]; without [foundation] the default of Foundation.
double rock_permeability(const Scene& scene);

/// The curtain has an E or ν of its own: the solid model needs mesh lines around it. One without a modulus has the
/// rock's. False without a curtain or without flexible rock.
bool curtain_changes_stiffness(const Scene& scene);

/// The curtain is intact and has a permeability of its own: the flow model needs mesh lines around it.
bool curtain_changes_flow(const Scene& scene);

} // namespace damslip
