#include "fe2d/gmsh/gmsh_sections.hpp"

#include <fmt/format.h>

#include <cmath>

namespace damslip::fe2d {

namespace {

constexpr double farthest = 1e6; ///< coordinate in the file

/// Words for the kinds of element that meshes of other programs or settings have.
std::string name_of_type(std::int64_t type)
{
    switch (type) {
    case 4:
        return "4-node tetrahedron";
    case 5:
        return "8-node hexahedron";
    case 6:
        return "6-node prism";
    case 7:
        return "5-node pyramid";
    case 8:
        return "3-node line of second order";
    case 9:
        return "6-node triangle of second order";
    case 10:
        return "9-node quadrilateral of second order";
    case 16:
        return "8-node quadrilateral of second order";
    default:
        return "no line, triangle or quadrilateral of first order";
    }
}

std::string fix_of_type(std::int64_t type)
{
    return type >= 4 && type <= 7 ? "mesh the section, a surface: gmsh -2 -order 1"
                                  : "mesh with first order: gmsh -2 -order 1, or Mesh.ElementOrder = 1";
}

} // namespace

GmshReading::GmshReading(std::string_view text, const std::filesystem::path& file) : lines(text, file.string())
{
    result.file = file;
}

void GmshReading::end(const std::string& section)
{
    lines.need(section);
    if (lines.line() != "$End" + section)
        lines.refuse(fmt::format("${} goes on after as many entries as it announces.", section), "$End" + section,
                     "write the mesh again, or correct the number at the section's start");
}

void GmshReading::add_node(std::int64_t tag, Point at, double z)
{
    for (const double c : {at.x, at.y, z})
        if (std::abs(c) > farthest)
            lines.refuse(fmt::format("node {} has the coordinate {:g}.", tag, c),
                         fmt::format("at most {:g} in size, heel of the dam at the origin", farthest),
                         "shift the mesh; where its unit is not the metre give mesh.file_unit_m in the scene");
    if (!index_.emplace(tag, static_cast<int>(result.nodes.size())).second)
        lines.refuse(fmt::format("node tag {} is given twice.", tag), "a tag of its own for every node",
                     "write the mesh again");
    result.nodes.push_back({tag, at, z, lines.number()});
}

int GmshReading::node_with(std::int64_t tag) const
{
    const auto found = index_.find(tag);
    if (found == index_.end())
        lines.refuse(fmt::format("node {} of the element is not in $Nodes.", tag), "tags of $Nodes",
                     "write the mesh again");
    return found->second;
}

void GmshReading::add_element(std::int64_t tag, std::int64_t type, std::vector<int> groups, GmshWords& words)
{
    if (type == 15) {
        node_with(words.whole("node tag", 1, largest_gmsh_number));
        return words.end();
    }
    if (type < 1 || type > 3)
        lines.refuse(fmt::format("element {} has type {}: {}.", tag, type, name_of_type(type)),
                     "types 1 (2-node line), 2 (3-node triangle), 3 (4-node quadrilateral), 15 (point, left out)",
                     fix_of_type(type));
    GmshElement element{tag, static_cast<GmshShape>(type - 1), {-1, -1, -1, -1}, std::move(groups), lines.number()};
    for (int i = 0; i < node_count(element.shape); ++i) {
        element.nodes[i] = node_with(words.whole("node tag", 1, largest_gmsh_number));
        for (int j = 0; j < i; ++j)
            if (element.nodes[j] == element.nodes[i])
                lines.refuse(fmt::format("element {} has node {} twice.", tag, result.nodes[element.nodes[i]].tag),
                             "different nodes", "mesh again; a quadrilateral with three corners is a triangle, type 2");
    }
    words.end();
    result.elements.push_back(std::move(element));
}

} // namespace damslip::fe2d
