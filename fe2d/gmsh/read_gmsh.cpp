#include "fe2d/gmsh/gmsh.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <unordered_map>

namespace damslip::fe2d {

/// Largest tag or count in a file.
inline constexpr std::int64_t largest_gmsh_number = 100'000'000;

/// What the sections of a file, read one after the other, have given so far.
class GmshReading {
public:
    GmshReading(std::string_view text, const std::filesystem::path& file);

    GmshLines lines;
    GmshFile result;
    /// Physical tags of the entities (version 4.1) by dimension and tag.
    std::map<std::pair<int, std::int64_t>, std::vector<int>> entity_groups;

    /// Takes $End<section> from the next line.
    void end(const std::string& section);
    void add_node(std::int64_t tag, Point at, double z);
    /// An element whose node tags are the next words of the line; points are left out.
    /// @param type  Gmsh's number of the kind of element
    void add_element(std::int64_t tag, std::int64_t type, std::vector<int> groups, GmshWords& words);

private:
    int node_with(std::int64_t tag) const;
    std::unordered_map<std::int64_t, int> index_; ///< in result.nodes, of node tags
};

// $Nodes and $Elements of both versions, from the line after the section's name to before $End; $Entities of 4.1.
void read_nodes_2_2(GmshReading& in);
void read_elements_2_2(GmshReading& in);
void read_entities_4_1(GmshReading& in);
void read_nodes_4_1(GmshReading& in);
void read_elements_4_1(GmshReading& in);

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

namespace {

/// The count that a section of version 2.2 starts with.
std::int64_t count_of(GmshReading& in, const std::string& section, const char* what)
{
    in.lines.need(section);
    GmshWords words(in.lines);
    const std::int64_t count = words.whole(what, 0, largest_gmsh_number);
    words.end();
    return count;
}

} // namespace

void read_nodes_2_2(GmshReading& in)
{
    const std::int64_t count = count_of(in, "Nodes", "number of nodes");
    for (std::int64_t i = 0; i < count; ++i) {
        in.lines.need("Nodes");
        GmshWords words(in.lines);
        const std::int64_t tag = words.whole("node tag", 1, largest_gmsh_number);
        const double x = words.number("x"), y = words.number("y"), z = words.number("z");
        words.end();
        in.add_node(tag, {x, y}, z);
    }
}

void read_elements_2_2(GmshReading& in)
{
    const std::int64_t count = count_of(in, "Elements", "number of elements");
    for (std::int64_t i = 0; i < count; ++i) {
        in.lines.need("Elements");
        GmshWords words(in.lines);
        const std::int64_t tag = words.whole("element tag", 1, largest_gmsh_number);
        const std::int64_t type = words.whole("element type", 1, 140);
        const std::int64_t tags = words.whole("number of tags", 0, 100);
        std::vector<int> groups;
        for (std::int64_t k = 0; k < tags; ++k) { // the physical group, the entity, partitions
            const auto value =
                static_cast<int>(words.whole("tag of the element", -largest_gmsh_number, largest_gmsh_number));
            if (k == 0 && value != 0) groups.push_back(value < 0 ? -value : value);
        }
        in.add_element(tag, type, std::move(groups), words);
    }
}

namespace {

/// First line of $Nodes and $Elements: blocks, entries, smallest and largest tag.
struct Announced {
    std::int64_t blocks = 0, entries = 0;
};

Announced announced(GmshReading& in, const std::string& section)
{
    in.lines.need(section);
    GmshWords words(in.lines);
    Announced a;
    a.blocks = words.whole("number of blocks", 0, largest_gmsh_number);
    a.entries = words.whole("number of entries", 0, largest_gmsh_number);
    words.whole("smallest tag", 0, largest_gmsh_number);
    words.whole("largest tag", 0, largest_gmsh_number);
    words.end();
    return a;
}

void check_sum(GmshReading& in, const std::string& section, std::int64_t found, std::int64_t announced)
{
    if (found == announced) return;
    in.lines.refuse(
        fmt::format("the blocks of ${} hold {} entries, its first line says {}.", section, found, announced),
        "the same number", "write the mesh again");
}

std::vector<int> groups_of(GmshWords& words)
{
    const std::int64_t count = words.whole("number of physical tags", 0, 1000);
    std::vector<int> groups;
    for (std::int64_t k = 0; k < count; ++k) {
        const auto tag = static_cast<int>(words.whole("physical tag", -largest_gmsh_number, largest_gmsh_number));
        groups.push_back(tag < 0 ? -tag : tag); // negative: the curve runs the other way in the group
    }
    return groups;
}

} // namespace

void read_entities_4_1(GmshReading& in)
{
    in.lines.need("Entities");
    GmshWords counts(in.lines);
    std::int64_t count[4];
    for (std::int64_t& n : count) n = counts.whole("number of entities", 0, largest_gmsh_number);
    counts.end();
    for (int dimension = 0; dimension < 4; ++dimension)
        for (std::int64_t i = 0; i < count[dimension]; ++i) {
            in.lines.need("Entities");
            GmshWords words(in.lines);
            const std::int64_t tag = words.whole("entity tag", -largest_gmsh_number, largest_gmsh_number);
            for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) words.number("coordinate of the entity");
            std::vector<int> groups = groups_of(words);
            if (dimension > 0) {
                const std::int64_t sides = words.whole("number of bounding entities", 0, largest_gmsh_number);
                for (std::int64_t k = 0; k < sides; ++k)
                    words.whole("bounding entity", -largest_gmsh_number, largest_gmsh_number);
            }
            words.end();
            if (!in.entity_groups.emplace(std::pair{dimension, tag}, std::move(groups)).second)
                in.lines.refuse(fmt::format("entity {} of dimension {} is given twice.", tag, dimension),
                                "a tag of its own for every entity of a dimension", "write the mesh again");
        }
}

void read_nodes_4_1(GmshReading& in)
{
    const Announced all = announced(in, "Nodes");
    std::int64_t found = 0;
    for (std::int64_t block = 0; block < all.blocks; ++block) {
        in.lines.need("Nodes");
        GmshWords words(in.lines);
        const std::int64_t dimension = words.whole("dimension of the entity", 0, 3);
        words.whole("entity tag", -largest_gmsh_number, largest_gmsh_number);
        const bool parametric = words.whole("parametric", 0, 1) == 1;
        const std::int64_t count = words.whole("number of nodes in the block", 0, all.entries - found);
        words.end();
        std::vector<std::int64_t> tags;
        for (std::int64_t i = 0; i < count; ++i) {
            in.lines.need("Nodes");
            GmshWords tag(in.lines);
            tags.push_back(tag.whole("node tag", 1, largest_gmsh_number));
            tag.end();
        }
        for (const std::int64_t tag : tags) {
            in.lines.need("Nodes");
            GmshWords place(in.lines);
            const double x = place.number("x"), y = place.number("y"), z = place.number("z");
            for (std::int64_t k = 0; parametric && k < dimension; ++k) place.number("parameter");
            place.end();
            in.add_node(tag, {x, y}, z);
        }
        found += count;
    }
    check_sum(in, "Nodes", found, all.entries);
}

void read_elements_4_1(GmshReading& in)
{
    const Announced all = announced(in, "Elements");
    std::int64_t found = 0;
    for (std::int64_t block = 0; block < all.blocks; ++block) {
        in.lines.need("Elements");
        GmshWords words(in.lines);
        const auto dimension = static_cast<int>(words.whole("dimension of the entity", 0, 3));
        const std::int64_t entity = words.whole("entity tag", -largest_gmsh_number, largest_gmsh_number);
        const std::int64_t type = words.whole("element type", 1, 140);
        const std::int64_t count = words.whole("number of elements in the block", 0, all.entries - found);
        words.end();
        const auto groups = in.entity_groups.find({dimension, entity});
        if (groups == in.entity_groups.end())
            in.lines.refuse(
                fmt::format("entity {} of dimension {} is not in $Entities.", entity, dimension),
                "$Entities before $Elements, with every entity that has elements: its physical groups stand there",
                "write the mesh again");
        for (std::int64_t i = 0; i < count; ++i) {
            in.lines.need("Elements");
            GmshWords element(in.lines);
            const std::int64_t tag = element.whole("element tag", 1, largest_gmsh_number);
            in.add_element(tag, type, groups->second, element);
        }
        found += count;
    }
    check_sum(in, "Elements", found, all.entries);
}

} // namespace damslip::fe2d
