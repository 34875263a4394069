#pragma once

#include "fe2d/gmsh/write_gmsh.hpp"

#include <string_view>

namespace damslip::fe2d {

/// Reads a Gmsh mesh, ASCII of version 2.2 or 4.1 (Geuzaine & Remacle 2009; sections as in the Gmsh 4.8 reference manual, "MSH file
/// format"): nodes, two-node lines, three-node triangles, four-node quadrilaterals, physical names. Tags may be sparse; points
/// (type 15) are left out; $Periodic and fields on the mesh are passed over.
/// @throws InputError with file and line for anything else: binary files, other versions and elements by name, partitions, cut
///         files, counts that do not agree, numbers that are none, tags that are unknown or given twice.
GmshFile read_gmsh(const std::filesystem::path& file);

/// The same from memory. @param file  name for messages
GmshFile parse_gmsh(std::string_view text, const std::filesystem::path& file);

} // namespace damslip::fe2d
