#pragma once

#include "scene/scene.hpp"

#include <string>

namespace damslip::pages {

/// The section of a scene as an SVG file: concrete, water, curtain, drains, uplift, signs. A wedge has its own drawing.
/// @throws InputError, NotConverged  of the seepage
std::string drawn_section(const Scene& given);

} // namespace damslip::pages
