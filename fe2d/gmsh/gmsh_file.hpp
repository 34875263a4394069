#pragma once

#include "core/geometry.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// A mesh as a Gmsh file (.msh) has it, before anybody asks what it means.
namespace damslip::fe2d {

struct GmshNode {
    std::int64_t tag = 0; ///< number in the file, > 0; numbers may be left out
    Point at;             ///< in the unit of the file
    double z = 0.0;       ///< in the unit of the file
    int line = 0;         ///< of the file
};

enum class GmshShape { line, triangle, quadrilateral };

/// Nodes of one of them.
constexpr int node_count(GmshShape shape)
{
    return shape == GmshShape::line ? 2 : shape == GmshShape::triangle ? 3 : 4;
}
constexpr int dimension(GmshShape shape)
{
    return shape == GmshShape::line ? 1 : 2;
}

struct GmshElement {
    std::int64_t tag = 0;
    GmshShape shape = GmshShape::line;
    std::array<int, 4> nodes{-1, -1, -1, -1}; ///< indices in GmshFile::nodes
    std::vector<int> groups;                  ///< physical tags it belongs to; empty: none
    int line = 0;                             ///< of the file
};

/// A physical group.
struct GmshGroup {
    int dimension = 0; ///< 1: lines, 2: surfaces
    int tag = 0;
    std::string name;
    int line = 0; ///< of the file
};

struct GmshFile {
    std::filesystem::path file;
    std::string version;               ///< "2.2" or "4.1"
    std::vector<GmshNode> nodes;       ///< by increasing tag
    std::vector<GmshElement> elements; ///< lines, triangles and quadrilaterals by increasing tag
    std::vector<GmshGroup> groups;     ///< with a name, in the order of the file
};

} // namespace damslip::fe2d
