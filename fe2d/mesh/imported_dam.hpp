#pragma once

#include "fe2d/mesh/imported_body.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// Share of the base length by which an imported mesh may differ from the scene's section, and of the area.
inline constexpr double section_tolerance = 1e-3;

/// Puts the dam of the file into an empty mesh: nodes, elements, faces, crest, contact.dam_nodes; its lift joints are
/// split. The base is the physical line "base"; "upstream", "crest" and "downstream" may be named, otherwise the
/// section's corners divide the outline.
/// @throws InputError where the dam is not the scene's section within section_tolerance, the base is not straight, a
///         lift joint of the scene is no line of the mesh
void append_imported_dam(Mesh& mesh, const GmshFile& file, const ImportedBody& dam, const Scene& scene);

} // namespace damslip::fe2d
