#include "cli/flags.hpp"
#include "cli/mesh_command.hpp"

namespace damslip::cli {

namespace {

void mesh_flags(CLI::App& sub, MeshArguments& a)
{
    add_scene(sub, a.inputs);
    sub.add_option(
           "--out", a.out,
           "Gmsh file (.msh, ASCII) with physical groups, as mesh.file reads it; deck for CalculiX with --to calculix")
        ->check(output_to(OutputPath::file, "--out"));
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

Command mesh_command()
{
    return {"mesh", "the finite-element mesh of a scene: sizes and shapes; written for Gmsh or CalculiX",
            "damslip mesh examples/reference_dam.toml --out dam.msh", with_flags<MeshArguments>(mesh_flags, mesh)};
}

} // namespace damslip::cli
