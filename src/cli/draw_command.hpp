#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/terminal/streams.hpp"

namespace damslip::cli {

struct DrawArguments {
    RunInputs inputs;
    std::filesystem::path out; ///< empty: standard output
};

/// The section of a scene as SVG.
int draw(const DrawArguments& arguments, const Streams& streams);

} // namespace damslip::cli
