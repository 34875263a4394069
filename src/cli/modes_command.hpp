#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/terminal/streams.hpp"

namespace damslip::cli {

struct ModesArguments {
    RunInputs inputs;
    int count = 10;                  ///< modes
    bool frequency_response = false; ///< transfer functions, 0.1 ... 20 Hz
    std::filesystem::path out;       ///< folder for mode shapes (VTU) and transfer functions (CSV); empty: none
};

/// Natural frequencies, effective masses and damping coefficients of the dam on its rock with its water, tied base. Acoustic water:
/// every coupled mode up to 20 Hz. reservoir.model = "auto" is decided by the compressibility criterion.
int modes(const ModesArguments& arguments, const Streams& streams);

} // namespace damslip::cli
