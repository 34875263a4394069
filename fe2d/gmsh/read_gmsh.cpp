#include "fe2d/gmsh/read_gmsh.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/number.hpp"
#include "fe2d/gmsh/gmsh_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace damslip::fe2d {

namespace {

constexpr const char* write_again = "write it with  gmsh -2 -format msh41  or  -format msh22  (ASCII, not binary)";

/// The first section: $MeshFormat.
void read_format(GmshReading& in)
{
    if (!in.lines.next() || in.lines.line() != "$MeshFormat")
        in.lines.refuse("the file does not start with $MeshFormat: it is no Gmsh mesh.",
                        "a Gmsh mesh, ASCII, version 2.2 or 4.1", write_again);
    in.lines.need("MeshFormat");
    GmshWords words(in.lines);
    const double version = words.number("version");
    const std::int64_t type = words.whole("file type (0 ASCII, 1 binary)", 0, 1);
    const std::int64_t size = words.whole("size of a number in bytes", 1, 64);
    words.end();
    if (type == 1) in.lines.refuse("the mesh is a binary file.", "ASCII: file type 0", write_again);
    if (version != 2.2 && version != 4.1)
        in.lines.refuse(fmt::format("version {} of the Gmsh format is not read.", shortest(version)), "2.2 or 4.1",
                        write_again);
    if (size != 8) in.lines.refuse(fmt::format("size of a number = {} is not allowed.", size), "8 bytes", write_again);
    in.result.version = version == 2.2 ? "2.2" : "4.1";
    in.end("MeshFormat");
}

void read_names(GmshReading& in)
{
    in.lines.need("PhysicalNames");
    GmshWords words(in.lines);
    const std::int64_t count = words.whole("number of physical names", 0, 100'000);
    words.end();
    for (std::int64_t i = 0; i < count; ++i) {
        in.lines.need("PhysicalNames");
        GmshWords line(in.lines);
        GmshGroup group;
        group.dimension = static_cast<int>(line.whole("dimension", 0, 3));
        group.tag = static_cast<int>(line.whole("physical tag", 0, largest_gmsh_number));
        group.name = line.quoted("physical name");
        group.line = in.lines.number();
        for (const GmshGroup& other : in.result.groups)
            if (other.dimension == group.dimension && (other.tag == group.tag || other.name == group.name))
                in.lines.refuse(fmt::format("the physical group {} \"{}\" of dimension {} is named in line {} already.",
                                            group.tag, group.name, group.dimension, other.line),
                                "each tag and each name once", "delete one");
        in.result.groups.push_back(std::move(group));
    }
}

/// Passes over a section that says nothing about the mesh itself.
void skip(GmshReading& in, const std::string& section)
{
    do in.lines.need(section);
    while (in.lines.line() != "$End" + section);
}

/// One section whose first line has just been read. @returns false where it was only passed over
bool read_section(GmshReading& in, const std::string& section)
{
    static const std::set<std::string> passed_over{"Periodic",         "NodeData",      "ElementData",
                                                   "ElementNodeData",  "GhostElements", "InterpolationScheme",
                                                   "Parametrizations", "Comments"};
    const bool new_format = in.result.version == "4.1";
    if (section == "PhysicalNames")
        read_names(in);
    else if (section == "Entities" && new_format)
        read_entities_4_1(in);
    else if (section == "Nodes")
        new_format ? read_nodes_4_1(in) : read_nodes_2_2(in);
    else if (section == "Elements")
        new_format ? read_elements_4_1(in) : read_elements_2_2(in);
    else if (section == "PartitionedEntities")
        in.lines.refuse("the mesh is partitioned.", "a mesh in one piece", "write it without -part");
    else if (passed_over.contains(section)) {
        skip(in, section);
        return false;
    } else
        in.lines.refuse(fmt::format("section ${} is not known.", section.substr(0, 40)),
                        "$PhysicalNames, $Entities (4.1), $Nodes, $Elements", write_again);
    in.end(section);
    return true;
}

} // namespace

GmshFile parse_gmsh(std::string_view text, const std::filesystem::path& file)
{
    GmshReading in(text, file);
    read_format(in);
    std::set<std::string> seen;
    while (in.lines.next()) {
        const std::string first(in.lines.line());
        if (first.front() != '$')
            in.lines.refuse(fmt::format("a section was to start here, not \"{}\".", first.substr(0, 40)),
                            "$Nodes, $Elements or another section", "write the mesh again");
        const std::string section = first.substr(1);
        if (seen.contains(section))
            in.lines.refuse(fmt::format("section ${} is given twice.", section), "once", "write the mesh again");
        if (read_section(in, section)) seen.insert(section);
    }
    for (const char* section : {"Nodes", "Elements"})
        if (!seen.contains(section))
            in.lines.refuse(fmt::format("section ${} is missing.", section), "$Nodes and $Elements",
                            "the file looks cut: write it again");
    GmshFile result = std::move(in.result);
    const auto by_tag = [](const auto& a, const auto& b) { return a.tag < b.tag; };
    std::vector<int> order(result.nodes.size()), place(result.nodes.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return by_tag(result.nodes[a], result.nodes[b]); });
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
    std::sort(result.nodes.begin(), result.nodes.end(), by_tag);
    for (GmshElement& element : result.elements)
        for (int i = 0; i < node_count(element.shape); ++i) element.nodes[i] = place[element.nodes[i]];
    std::stable_sort(result.elements.begin(), result.elements.end(), by_tag);
    return result;
}

GmshFile read_gmsh(const std::filesystem::path& file)
{
    return parse_gmsh(read_file(file), file);
}

} // namespace damslip::fe2d
