#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// How far the fine part of the rock surface goes on, straight, past heel and toe: the dam may slide that far.
struct ContactExtension {
    double upstream = 1.0;   ///< [m], >= 0
    double downstream = 1.0; ///< [m], >= 0
};

/// Turns the linear quadrilaterals and triangles of a mesh, whoever made it, into elements of the wanted kind:
/// quadrilaterals split along their shorter diagonal (t3, t6), middle nodes added (q8, q9, t6; quadratic.hpp).
void shape_elements(Mesh& mesh, ElementKind kind);

/// Whether the curtain is a zone of its own in the mesh (build_mesh).
bool curtain_is_meshed(const Scene& scene);

/// Meshes the dam and, where the scene has a foundation, the rock box (scene.mesh gives sizes, growth and element kind,
/// see shape_elements). A curtain is a zone of its own where
/// its stiffness differs from the rock's, or its permeability does and scene.stages.pore_pressure puts the flow on this
/// mesh; any other curtain is rock, and the mesh that of the scene without it. With scene.mesh.rock_contact_size the
/// rock's nodes on the contact plane are its own. With scene.mesh.file the mesh is that of the file (import_mesh.hpp). Node places depend on the scene only: same scene, same bits.
/// @throws InputError when the section cannot be meshed (faces.hpp, quality.hpp), or the box does not hold the base,
///         its extensions or the curtain.
Mesh build_mesh(const Scene& scene, const ContactExtension& extension = {});

} // namespace damslip::fe2d
