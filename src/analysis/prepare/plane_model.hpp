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

/// The rigid block on a lift, whose stages it takes, and on a seam, with what that needs to slide both ways; without the vibration of the dam.
RigidModel plane_model(sliding::LiftPlane& lift);
RigidModel plane_model(sliding::SeamPlane& seam);

/// Whatever may slide: the base, then lifts and seams in the order of plane_names().
std::vector<RigidModel> all_models(const Ready& ready);

/// The rigid model of the plane that has this name. @param kept  as of make_rigid_model()
/// @throws UsageError where no plane of plane_names() has it
RigidModel plane_model(const Scene& scene, const std::string& name, KeptStatics* kept = nullptr);

} // namespace damslip
