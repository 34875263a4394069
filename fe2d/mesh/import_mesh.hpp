#pragma once

#include "fe2d/gmsh/gmsh.hpp"
#include "fe2d/mesh/build_mesh.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

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

/// Reads scene.mesh.file (gmsh/gmsh.hpp) in place of meshing. Bodies are the physical surfaces "dam", "rock" and
/// "curtain", each also with zones "rock:weathered"; rock is left out where the scene has no foundation, the curtain is rock
/// where build_mesh would not mesh it. The physical line "base" is the plane between dam and rock; it and the lift joints are
/// split as build_mesh does (imported_dam.hpp, imported_rock.hpp).
/// @throws InputError at the lines of the file where it is not what the scene describes
ImportedMesh import_mesh(const Scene& scene, const ContactExtension& extension = {});

/// The same from a file that has been read; scene.mesh.file is not looked at.
ImportedMesh import_mesh(GmshFile file, const Scene& scene, const ContactExtension& extension = {});

/// Parts of an imported mesh on the way from the file to fe2d::Mesh.

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

/// Share of the base length by which an imported mesh may differ from the scene's section, and of the area.
inline constexpr double section_tolerance = 1e-3;

/// Puts the dam of the file into an empty mesh: nodes, elements, faces, crest, contact.dam_nodes; its lift joints are
/// split. The base is the physical line "base"; "upstream", "crest" and "downstream" may be named, otherwise the
/// section's corners divide the outline.
/// @throws InputError where the dam is not the scene's section within section_tolerance, the base is not straight, a
///         lift joint of the scene is no line of the mesh
void append_imported_dam(Mesh& mesh, const GmshFile& file, const ImportedBody& dam, const Scene& scene);

/// Appends the rock of the file to a mesh that holds its dam: nodes, elements, the rock's side of the contact plane,
/// its surface and the sides of the box. Its base nodes are those of its outline between heel and toe. "rock-left",
/// "rock-right", "rock-bottom" may be named; otherwise they are where the outline is at its least and largest x and its
/// least y.
/// @throws InputError where the rock does not follow the base from heel to toe, dam and rock touch elsewhere, the sides
///         are not found, or the surface is not straight as far as a finite path needs it
void append_imported_rock(Mesh& mesh, const GmshFile& file, const ImportedBody& rock, const Scene& scene,
                          const ContactExtension& extension);

} // namespace damslip::fe2d
