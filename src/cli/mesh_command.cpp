#include "cli/flags.hpp"
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "fe2d/gmsh/write_gmsh.hpp"
#include "fe2d/mesh/export_mesh.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "pages/fe/mesh_table.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/report_provenance.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
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

/// The mesh of a scene as contact runs have it, the program's own or an imported one: sizes, shapes, contact pairs; written as a
/// Gmsh file where asked for.
int mesh(const MeshArguments& arguments, const Streams& streams)
{
    if (!arguments.results.empty())
        throw UsageError(
            Diagnostic{"", 0, 0, "--results without --to calculix.", "results of CalculiX", "add  --to calculix"});
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

void mesh_flags(CLI::App& sub, MeshArguments& a)
{
    add_scene(sub, a.inputs);
    add_out(
        sub, a.out, OutputPath::file,
        "Gmsh file (.msh, ASCII) with physical groups, as mesh.file reads it; deck for CalculiX with --to calculix");
    sub.add_option("--format", a.format, "version of the Gmsh file")
        ->check(CLI::IsMember({"2.2", "4.1"}))
        ->capture_default_str();
    sub.add_option("--base", a.base, "nodes between dam and rock in the Gmsh file: twice, or shared by both")
        ->check(CLI::IsMember({"twice", "shared"}))
        ->capture_default_str();
    sub.add_option("--to", a.to,
                   "for whom --out is: gmsh (the mesh), or calculix (mesh, materials, loads: a deck to run)")
        ->check(CLI::IsMember({"gmsh", "calculix"}))
        ->capture_default_str();
    sub.add_option("--analysis", a.analysis, "what CalculiX is to compute")
        ->check(CLI::IsMember({"modes", "tied", "static-contact"}))
        ->capture_default_str();
    sub.add_option("--modes", a.modes, "modes that CalculiX finds, or superposes in a tied run")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    sub.add_option("--results", a.results, "the .dat file that ccx made of the deck: our results beside its own")
        ->check(CLI::ExistingFile);
}

} // namespace

Command mesh_command(Carry<MeshArguments> calculix)
{
    const auto carry = [calculix](const MeshArguments& arguments, const Streams& streams) {
        return arguments.to == "calculix" ? calculix(arguments, streams) : mesh(arguments, streams);
    };
    return {"mesh", "the finite-element mesh of a scene: sizes and shapes; written for Gmsh or CalculiX",
            "damslip mesh examples/reference_dam.toml --out dam.msh", with_flags<MeshArguments>(mesh_flags, carry)};
}

} // namespace damslip::cli
