#include "fe2d/gmsh/gmsh_sections.hpp"

namespace damslip::fe2d {

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

} // namespace damslip::fe2d
