#pragma once

#include "analysis/prepare/rigid_model.hpp"
#include "scene/scene.hpp"
#include "sliding/flexible/flexible_mode.hpp"
#include "sliding/flexible/flexible_slide.hpp"

#include <optional>
#include <string>

/// The sliding mass as one mode on its base.
namespace damslip {

/// Anchors, friction over the rate, rebounds, a sequence: the flexible block does not follow them. Beside [flexible_block] they are refused.
bool has_laws_of_rigid_blocks(const Scene& scene);

/// What the scene asks for beside the rigid block: [flexible_block], or regressions.period_s alone with all defaults; nothing for
/// a rigid mass, and where the scene has anchors, friction over the rate, rebounds or a sequence, which a flexible block does not follow.
/// Of a column without its strain. @pre period and mass ratio "modes" are found: resolve_flexible_modes
std::optional<sliding::FlexibleBlock> flexible_block(const Scene& scene);

/// The column of [flexible_block] under a motion: its period and damping, with reference_strain those of its strain. Nothing where the
/// block is no column.
std::optional<sliding::StrainCompatible> column_under(const Scene& scene, const sliding::FlexibleBlock& flexible,
                                                      const GroundMotion& motion);

/// Where the mass ratio comes from: "mass ratio 0.811: uniform shear column".
std::string mass_ratio_words(const Scene& scene);

/// Slip of the model that vibrates, with the scene's [sliding] options; with the checks that slide_model() makes of a rigid one.
/// @param method  decoupled or coupled, not both
sliding::FlexibleSlide slide_model(const Scene& scene, const sliding::FlexibleBlock& flexible, const RigidModel& model,
                                   const GroundMotion& motion, int polarity, FlexibleMethod method,
                                   sliding::HistoryOutput history = sliding::HistoryOutput::none);

/// flexible_block.period_s = "modes": period and mass ratio of the mode with the largest horizontal effective mass among the
/// first five of the tied finite-element model with added mass, put into the scene. @returns a sentence with the numbers;
/// empty where the scene does not ask for it
/// @throws NotConverged where the modes were not found
std::string resolve_flexible_modes(Scene& scene);

} // namespace damslip
