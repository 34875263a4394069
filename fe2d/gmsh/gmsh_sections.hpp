#pragma once

#include "fe2d/gmsh/gmsh_file.hpp"
#include "fe2d/gmsh/gmsh_lines.hpp"

#include <map>
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

} // namespace damslip::fe2d
