#pragma once

#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/mesh/imported_body.hpp"

namespace damslip::fe2d {

/// Appends the rock of the file to a mesh that holds its dam: nodes, elements, the rock's side of the contact plane,
/// its surface and the sides of the box. Its base nodes are those of its outline between heel and toe. "rock-left",
/// "rock-right", "rock-bottom" may be named; otherwise they are where the outline is at its least and largest x and its
/// least y.
/// @throws InputError where the rock does not follow the base from heel to toe, dam and rock touch elsewhere, the sides
///         are not found, or the surface is not straight as far as a finite path needs it
void append_imported_rock(Mesh& mesh, const GmshFile& file, const ImportedBody& rock, const Scene& scene,
                          const ContactExtension& extension);

} // namespace damslip::fe2d
