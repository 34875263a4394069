#include "fe2d/gmsh/gmsh_sections.hpp"

#include <fmt/format.h>

namespace damslip::fe2d {

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
