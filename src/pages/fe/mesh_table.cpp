#include "pages/fe/mesh_table.hpp"

#include "core/units.hpp"
#include "fe2d/mesh/quality.hpp"

#include <fmt/format.h>

namespace damslip::pages {

Table mesh_table(const fe2d::Mesh& mesh)
{
    struct Row {
        const fe2d::Mesh& mesh;
        fe2d::MeshQuality quality;
    };
    const std::vector<Row> rows{{mesh, fe2d::measure_quality(mesh)}};
    Table t = table_of<Row>(
        "Mesh",
        {{{"nodes", "nodes"}, [](const Row& r) { return count_cell(r.mesh.nodes.size()); }},
         {{"quadrilaterals", "quadrilaterals"}, [](const Row& r) { return r.quality.quadrilaterals; }},
         {{"triangles", "triangles"}, [](const Row& r) { return r.quality.triangles; }},
         {{"dam_elements", "in the dam"}, [](const Row& r) { return r.mesh.dam_element_count; }},
         {{"base_nodes_dam", "base, dam"}, [](const Row& r) { return count_cell(r.mesh.contact.dam_nodes.size()); }},
         {{"base_nodes_rock", "base, rock"}, [](const Row& r) { return count_cell(r.mesh.contact.rock_nodes.size()); }},
         {{"smallest_edge_m", "smallest edge", "m", 4}, [](const Row& r) { return r.quality.smallest_edge; }},
         {{"largest_edge_m", "largest edge", "m", 4}, [](const Row& r) { return r.quality.largest_edge; }},
         {{"smallest_angle_deg", "smallest angle", "deg", 4},
          [](const Row& r) { return r.quality.smallest_angle / units::degree; }},
         {{"smallest_scaled_jacobian", "scaled Jacobian", "-", 3},
          [](const Row& r) { return r.quality.smallest_scaled_jacobian; }}},
        rows);
    if (!mesh.has_rock())
        t.notes.push_back("no rock: the base stands on a rigid plane.");
    else
        t.notes.push_back(mesh.contact.matching ? "the nodes of dam and rock face each other along the base."
                                                : "the nodes of dam and rock do not face each other along the base.");
    for (std::size_t i = 0; i < mesh.lifts.size(); ++i)
        t.notes.push_back(fmt::format("lift joint {}: {} pairs of nodes.", i + 1, mesh.lifts[i].lower_nodes.size()));
    return t;
}

std::string import_note(const Scene& scene, const fe2d::ImportSummary& s)
{
    return fmt::format("{}: Gmsh {}, {} nodes; {} of no element of dam and rock left out, {} at the place of another "
                       "one joined, {} clockwise elements turned.",
                       scene.mesh.file->string(), s.version, s.file_nodes, s.unused, s.joined, s.flipped);
}

} // namespace damslip::pages
