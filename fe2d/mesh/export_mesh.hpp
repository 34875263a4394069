#pragma once

#include "fe2d/gmsh/gmsh_file.hpp"
#include "fe2d/mesh/mesh.hpp"

namespace damslip::fe2d {

enum class BaseNodes {
    twice, ///< as the mesh has them: the dam's and the rock's
    shared ///< the dam's alone; a base whose sides match only
};

/// A mesh with the physical groups that import_mesh asks for, in metres: surfaces "dam", "rock", "curtain"; lines "base" (the
/// dam's edges), "upstream", "crest", "downstream", "floor", "ground", "rock-left", "rock-bottom", "rock-right". Node tags are
/// those of the mesh plus one. Lift joints keep their nodes twice.
GmshFile export_mesh(const Mesh& mesh, BaseNodes base = BaseNodes::twice);

} // namespace damslip::fe2d
