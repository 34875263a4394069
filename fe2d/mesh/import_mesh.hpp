#pragma once

#include "fe2d/gmsh/gmsh_file.hpp"
#include "fe2d/mesh/build_mesh.hpp"

#include <string>

namespace damslip::fe2d {

/// What an imported mesh was like in its file.
struct ImportSummary {
    std::string version; ///< of the Gmsh format: "2.2", "4.1"
    int file_nodes = 0;  ///< in the file
    int unused = 0;      ///< nodes that belong to no element of dam and rock: left out
    int joined = 0;      ///< nodes left out because another one of the same body is at their place
    int flipped = 0;     ///< elements that were clockwise
};

struct ImportedMesh {
    Mesh mesh;
    ImportSummary summary;
};

/// Reads scene.mesh.file (gmsh/read_gmsh.hpp) in place of meshing. Bodies are the physical surfaces "dam", "rock" and
/// "curtain", each also with zones "rock:weathered"; rock is left out where the scene has no foundation, the curtain is rock
/// where build_mesh would not mesh it. The physical line "base" is the plane between dam and rock; it and the lift joints are
/// split as build_mesh does (imported_dam.hpp, imported_rock.hpp).
/// @throws InputError at the lines of the file where it is not what the scene describes
ImportedMesh import_mesh(const Scene& scene, const ContactExtension& extension = {});

/// The same from a file that has been read; scene.mesh.file is not looked at.
ImportedMesh import_mesh(GmshFile file, const Scene& scene, const ContactExtension& extension = {});

} // namespace damslip::fe2d
