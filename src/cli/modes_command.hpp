#pragma once

#include "cli/run_inputs.hpp"
#include "cli/streams.hpp"

namespace damslip::cli {

struct ModesArguments {
    RunInputs inputs;
    int count = 10;            ///< modes
    std::filesystem::path out; ///< folder for mode shapes (VTU); empty: none
};

/// Natural frequencies, effective masses and damping coefficients of the dam on its rock with added mass, tied base.
int modes(const ModesArguments& arguments, const Streams& streams);

} // namespace damslip::cli
