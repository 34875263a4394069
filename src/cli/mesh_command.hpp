#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/terminal/streams.hpp"

namespace damslip::cli {

struct MeshArguments {
    RunInputs inputs;
    std::filesystem::path out;  ///< Gmsh file; empty: none
    std::string format = "4.1"; ///< of the Gmsh file: "2.2" or "4.1"
    std::string base = "twice"; ///< nodes of the base in it: "twice" or "shared"
};

/// The mesh of a scene as contact runs have it, the program's own or an imported one: sizes, shapes, contact pairs; written as a
/// Gmsh file where asked for.
int mesh(const MeshArguments& arguments, const Streams& streams);

} // namespace damslip::cli
