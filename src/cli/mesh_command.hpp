#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/terminal/streams.hpp"

namespace damslip::cli {

struct MeshArguments {
    RunInputs inputs;
    std::filesystem::path out;      ///< Gmsh file; empty: none
    std::string format = "4.1";     ///< of the Gmsh file: "2.2" or "4.1"
    std::string base = "twice";     ///< nodes of the base in it: "twice" or "shared"
    std::string to = "gmsh";        ///< for whom `out` is: "gmsh" or "calculix"
    std::string analysis = "modes"; ///< of the deck for CalculiX: "modes", "tied" or "static-contact"
    int modes = 10;                 ///< of that deck: found, or superposed
    std::filesystem::path results;  ///< .dat file that ccx made of the deck, to compare with; empty: none
};

/// The mesh of a scene as contact runs have it, the program's own or an imported one: sizes, shapes, contact pairs; written as a
/// Gmsh file where asked for.
int mesh(const MeshArguments& arguments, const Streams& streams);

} // namespace damslip::cli
