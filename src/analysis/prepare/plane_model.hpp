#pragma once

#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/rigid_model.hpp"
#include "sliding/planes/seam.hpp"

#include <string>
#include <vector>

/// The rigid block of a plane beside the base: a lift, or a seam in the rock.
namespace damslip {

inline constexpr const char* base_plane = "base";
inline constexpr const char* any_plane = "any"; ///< the one that slides furthest

/// "base", the lifts from the bottom up, the seams.
std::vector<std::string> plane_names(const Scene& scene);

/// The model of a plane's stages. @param length  of what it slides on [m] @param amplification  of the ground's motion [-]
/// @param one_way  it is followed downstream only
RigidModel plane_model(sliding::SlipStages stages, double length, double amplification, bool one_way);

/// What a seam needs to slide both ways.
void add_bodies(const sliding::SeamPlane& plane, RigidModel& model);

/// Of all planes but the base, in the order of plane_names(). @param kept  as of make_rigid_model()
std::vector<RigidModel> plane_models(const Scene& scene, KeptStatics* kept = nullptr);

/// Whatever may slide: the base, then lifts and seams.
std::vector<RigidModel> all_models(const Ready& ready);

/// The rigid model of the plane that has this name. @param kept  as of make_rigid_model()
/// @throws UsageError where no plane of plane_names() has it
RigidModel plane_model(const Scene& scene, const std::string& name, KeptStatics* kept = nullptr);

} // namespace damslip
