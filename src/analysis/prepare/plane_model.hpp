#pragma once

#include "analysis/prepare/rigid_model.hpp"

#include <string>
#include <vector>

/// The rigid block of a plane beside the base: a lift, or a seam in the rock.
namespace damslip {

inline constexpr const char* base_plane = "base";

/// "base", the lifts from the bottom up, the seams.
std::vector<std::string> plane_names(const Scene& scene);

/// The model of a plane's stages. @param length  of what it slides on [m] @param amplification  of the ground's motion [-]
/// @param one_way  it is followed downstream only
RigidModel plane_model(sliding::SlipStages stages, double length, double amplification, bool one_way);

/// The rigid model of the plane that has this name. @throws UsageError where no plane of plane_names() has it
RigidModel plane_model(const Scene& scene, const std::string& name);

} // namespace damslip
