#pragma once

#include "scene/scene.hpp"

namespace damslip {

/// Element sizes of a scene with all defaults filled in [m].
struct MeshSizes {
    double dam = 0.0;     ///< height / 40
    double contact = 0.0; ///< min(dam, base / 60)
    double rock = 0.0;    ///< largest in the rock: scene.mesh.rock_size, else depth / 8
};
MeshSizes mesh_sizes(const Scene& scene);

/// Length of the elements along a lift joint that resolve the process zone of its bond, a quarter of the characteristic length
/// E' G / f^2 (Bazant & Oh 1983), but not more than 240 along the joint [m]; infinite where no bond breaks by its energy.
double lift_mesh_size(const Scene& scene, const LiftJoint& joint);

/// Element height in acoustic water: reservoir.mesh_size, else level / 20 [m].
double water_mesh_size(const Reservoir& water);

/// The scene with these sizes, and the density of rock that radiates, as keys of its own. With mesh.file dam and rock have no
/// sizes; the scene of a wedge has no mesh.
Scene with_own_choices(Scene scene);

} // namespace damslip
