#include "cli/mesh_command.hpp"

#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "fe2d/gmsh/write_gmsh.hpp"
#include "fe2d/mesh/export_mesh.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "pages/fe/mesh_table.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/report_provenance.hpp"
#include "scene/plausible.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

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
        auto j = json_header("mesh", given);
        j["mesh"] = json_of(table);
        j["notes"] = note_texts(given.notes);
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << given.title << "\n\n" << text(table);
    }
    return exit_ok;
}

} // namespace damslip::cli
