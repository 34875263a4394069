#pragma once

#include "core/table.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "fe2d/mesh/mesh.hpp"

namespace damslip::pages {

/// Numbers, sizes and shapes of a mesh, in one row.
Table mesh_table(const fe2d::Mesh& mesh);

/// What reading a mesh file left out or changed.
std::string import_note(const Scene& scene, const fe2d::ImportSummary& summary);

} // namespace damslip::pages
