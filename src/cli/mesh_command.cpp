#include "cli/mesh_command.hpp"

#include "core/file.hpp"
#include "core/units.hpp"
#include "core/usage_error.hpp"
#include "fe2d/gmsh/write_gmsh.hpp"
#include "fe2d/mesh/export_mesh.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "fe2d/mesh/quality.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "scene/effect_plan.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

Table mesh_table(const fe2d::Mesh& mesh)
{
    const fe2d::MeshQuality quality = fe2d::measure_quality(mesh);
    const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
    Table t;
    t.title = "Mesh";
    t.columns = {{"nodes", "nodes", "", 4},
                 {"quadrilaterals", "quadrilaterals", "", 4},
                 {"triangles", "triangles", "", 4},
                 {"dam_elements", "in the dam", "", 4},
                 {"base_nodes_dam", "base, dam", "", 4},
                 {"base_nodes_rock", "base, rock", "", 4},
                 {"smallest_edge_m", "smallest edge", "m", 4},
                 {"largest_edge_m", "largest edge", "m", 4},
                 {"smallest_angle_deg", "smallest angle", "deg", 4},
                 {"smallest_scaled_jacobian", "scaled Jacobian", "-", 3}};
    t.rows.push_back({count(mesh.nodes.size()), std::int64_t{quality.quadrilaterals}, std::int64_t{quality.triangles},
                      std::int64_t{mesh.dam_element_count}, count(mesh.contact.dam_nodes.size()),
                      count(mesh.contact.rock_nodes.size()), quality.smallest_edge, quality.largest_edge,
                      quality.smallest_angle / units::degree, quality.smallest_scaled_jacobian});
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

fe2d::BaseNodes base_nodes(const MeshArguments& arguments, const fe2d::Mesh& mesh)
{
    if (arguments.base == "twice") return fe2d::BaseNodes::twice;
    if (!mesh.contact.matching)
        throw UsageError(Diagnostic{"", 0, 0, "--base shared, but the nodes of dam and rock do not face each other.",
                                    "--base twice for such a mesh", "write  --base twice"});
    return fe2d::BaseNodes::shared;
}

/// The mesh without middle nodes: mesh.element adds them when the file is read.
Scene of_first_order(Scene scene)
{
    const bool triangles = scene.mesh.element == ElementKind::t3 || scene.mesh.element == ElementKind::t6;
    scene.mesh.element = triangles ? ElementKind::t3 : ElementKind::q4;
    return scene;
}

} // namespace

int mesh(const MeshArguments& arguments, const Streams& streams)
{
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip mesh", "a wedge is rigid; damslip screen SCENE gives its slip");
    const Scene scene = called_for(make_effect_plan(given, Method::finite_elements), given);
    fe2d::ContactExtension extension;
    if (scene.contact.sliding == JointPath::finite) extension.downstream = scene.contact.max_slip;
    const fe2d::Mesh mesh = fe2d::build_mesh(scene, extension);
    Table table = mesh_table(mesh);
    for (std::string& note : note_texts(given.notes)) table.notes.push_back(std::move(note));
    if (scene.mesh.file) table.notes.push_back(import_note(scene, fe2d::import_mesh(scene, extension).summary));
    if (!arguments.out.empty()) {
        const auto version = arguments.format == "2.2" ? fe2d::GmshVersion::v2_2 : fe2d::GmshVersion::v4_1;
        const fe2d::Mesh corners = fe2d::build_mesh(of_first_order(scene), extension);
        write_file(arguments.out, fe2d::gmsh_text(fe2d::export_mesh(corners, base_nodes(arguments, corners)), version));
        table.notes.push_back(fmt::format("written: {} (Gmsh {})", arguments.out.string(), arguments.format));
    }
    if (streams.form == Form::json) {
        auto j = json_header("mesh");
        j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(given)}};
        j["mesh"] = json_of(table);
        j["notes"] = note_texts(given.notes);
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << scene.title << "\n\n" << pages::text(table);
    }
    return exit_ok;
}

} // namespace damslip::cli
