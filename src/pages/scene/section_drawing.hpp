#pragma once

#include "pages/report/page.hpp"
#include "scene/scene.hpp"
#include "sliding/uplift/uplift.hpp"

namespace damslip::pages {

/// The section to scale: concrete, water and its levels, silt, ice, forces, curtain, drains, the uplift pressure below
/// the base, dimensions, axes and the sign convention.
/// @param uplift  along the base, as the yield acceleration uses it
/// @param mesh  lines of a mesh of the section, drawn in it; empty: none
Drawing section_drawing(const Scene& scene, const PressureProfile& uplift,
                        const std::vector<Polyline>& mesh = {});

} // namespace damslip::pages
