#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/spectrum_input.hpp"
#include "cli/terminal/streams.hpp"

#include <optional>

namespace damslip::cli {

struct ScreenArguments {
    RunInputs inputs;
    std::filesystem::path out;  ///< folder for summary.json, displacements.csv and the resolved scene; empty: none
    std::filesystem::path pdf;  ///< the report on paper; empty: none
    bool rocking = false;       ///< the block that rocks, too, where the sliding one holds
    SpectrumArguments spectrum; ///< peaks by the modes, too
    bool mean_polarity = false; ///< a table with the mean of both polarities
    int jobs = 0;               ///< threads; 0: all cores
};

/// Limit equilibrium, yield accelerations, rigid-block displacements and regressions for every record of the scene.
int screen(const ScreenArguments& arguments, const Streams& streams);

} // namespace damslip::cli
