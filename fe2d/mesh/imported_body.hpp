#pragma once

#include "fe2d/gmsh/gmsh_file.hpp"
#include "fe2d/mesh/mesh.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

/// Parts of an imported mesh on the way from the file to fe2d::Mesh.
namespace damslip::fe2d {

/// @throws InputError in the mesh file; line 0: the file as a whole
[[noreturn]] void refuse_mesh(const GmshFile& file, int line, std::string problem, std::string expected,
                              std::string fix);

/// One body of an imported mesh: the dam, or the rock with the curtain. Within a body nodes at the same place are one
/// node; between bodies they are not, so that the plane between dam and rock is split whether the file shares its nodes
/// or has them twice. Nodes that no element uses are left out.
struct ImportedBody {
    std::string name;              ///< in messages: "dam"
    std::vector<Point> nodes;      ///< in the order of the file's tags [m]
    std::vector<Element> elements; ///< counter-clockwise, nodes of this body
    std::vector<int> lines;        ///< of the file, for every element
    std::vector<int> own_node;     ///< of every node of the file that is one of this body's or, in a line, at the
                                   ///< place of one; -1: not of this body
    double area = 0.0;             ///< [m^2]
    int flipped = 0;               ///< elements that were clockwise in the file
    int joined = 0;                ///< nodes of the file left out because another one is at their place
};

/// @param region_of  of every element of the file; nothing: not of this body
/// @param same_place  nodes nearer than that are one [m]
/// @throws InputError where an element is flat, folded or re-entrant
ImportedBody take_body(const GmshFile& file, const std::string& name,
                       const std::vector<std::optional<Region>>& region_of, double same_place);

/// The outline of a body, counter-clockwise, every node once.
/// @throws InputError where elements overlap, touch in a single node, or leave a hole
NodeChain outline_of(const GmshFile& file, const ImportedBody& body);

/// Edges of a body by their nodes, the smaller first.
using EdgeSet = std::set<std::pair<int, int>>;
inline std::pair<int, int> edge(int a, int b)
{
    return a < b ? std::pair{a, b} : std::pair{b, a};
}

/// Edges of the physical line `name` whose nodes belong to the body; nothing where the file has no such line.
std::optional<EdgeSet> named_edges(const GmshFile& file, const ImportedBody& body, const std::string& name);

/// Checks that the edges of the physical line `name`, where the file has it, are those of the chain.
void check_named(const GmshFile& file, const ImportedBody& body, const std::string& name, const NodeChain& chain);

} // namespace damslip::fe2d
