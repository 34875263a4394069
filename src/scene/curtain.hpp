#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// Hydraulic conductivity of the rock [m/s]; without [foundation] the default of Foundation.
double rock_permeability(const Scene& scene);

/// Whether the curtain has an E or ν of its own, so that the solid model needs mesh lines around it. A curtain without a
/// modulus has that of the rock. False without a curtain or without flexible rock.
bool curtain_changes_stiffness(const Scene& scene);

/// The curtain is intact and has a permeability of its own: the flow model needs mesh lines around it.
bool curtain_changes_flow(const Scene& scene);

} // namespace damslip
