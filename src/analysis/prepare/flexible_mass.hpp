#pragma once

#include "scene/scene.hpp"
#include "sliding/flexible/flexible_block.hpp"

#include <optional>
#include <string>

/// The sliding mass as one mode on its base.
namespace damslip {

/// What the scene asks for beside the rigid block: [flexible_block], or regressions.period_s alone with all defaults; nothing for
/// a rigid mass. @pre period and mass ratio "modes" are found: resolve_flexible_modes
std::optional<sliding::FlexibleBlock> flexible_block(const Scene& scene);

/// Where the mass ratio comes from: "mass ratio 0.811: uniform shear column".
std::string mass_ratio_words(const Scene& scene);

/// flexible_block.period_s = "modes": period and mass ratio of the mode with the largest horizontal effective mass among the
/// first five of the tied finite-element model with added mass, put into the scene. @returns a sentence with the numbers;
/// empty where the scene does not ask for it
/// @throws NotConverged where the modes were not found
std::string resolve_flexible_modes(Scene& scene);

} // namespace damslip
