#pragma once

#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/rigid_model.hpp"
#include "scene/scene.hpp"
#include "sliding/planes/seam.hpp"

#include <string>
#include <vector>

/// The rigid block of a plane beside the base: a lift, or a seam in the rock.
namespace damslip {

inline constexpr const char* base_plane = "base";
inline constexpr const char* any_plane = "any"; ///< the one that slides furthest

/// "base", the lifts from the bottom up, the seams.
std::vector<std::string> plane_names(const Scene& scene);

/// Lift joints and the anchors through them, which the plan of the rigid block leaves out, are those of the scene as read: on a plane
/// they replace lifts.
void restore_lift_joints(Scene& scene, const Scene& given);

/// The rigid block on a lift, whose stages it takes, and on a seam, with what that needs to slide both ways; without the vibration of the dam.
RigidModel plane_model(sliding::LiftPlane& lift);
RigidModel plane_model(sliding::SeamPlane& seam);

/// Whatever may slide: the base, then lifts and seams in the order of plane_names().
std::vector<RigidModel> all_models(const Ready& ready);

/// The rigid model of the plane that has this name. @param kept  as of make_rigid_model()
/// @throws UsageError where no plane of plane_names() has it
RigidModel plane_model(const Scene& scene, const std::string& name, KeptStatics* kept = nullptr);

/// The scene with the joints that [lifts] makes for finite elements, and without [lifts]: as lift joints with
/// active = "all", as tied lifts with "adaptive", neither with "none". A mesh from a file has no lines for them: the scene
/// stays as it is.
/// @throws InputError  where other keys do not go with lift joints
Scene with_joints_of_lifts(Scene scene);

/// @throws InputError where other keys do not go with traced cracks (`dam.crack`), or f_t is missing
void check_traced(const Scene& scene);

/// The scene in which the tied lifts of these names are lift joints.
Scene with_awake_lifts(Scene scene, const std::vector<std::string>& names);

/// The scene whose finite elements slide on the seam that planes.slides_on names, with what of the rock moves along (Scene::seam_body);
/// a wedge that is searched for has the angle of the least yield acceleration. The base of the dam is a joint on that rock. Without
/// a name the scene as it is.
/// @throws UsageError where no seam has the name; InputError for what finite elements cannot follow on a seam
Scene with_seam_body(Scene scene);

} // namespace damslip
