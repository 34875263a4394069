#pragma once

#include "fe2d/gmsh/gmsh_file.hpp"

#include <string>

namespace damslip::fe2d {

enum class GmshVersion { v2_2, v4_1 };

/// The text of a Gmsh file, ASCII; read back it gives the same nodes, elements and groups, bit for bit.
/// @param mesh  every element in exactly one group, which has a name; tags increase
std::string gmsh_text(const GmshFile& mesh, GmshVersion version);

} // namespace damslip::fe2d
