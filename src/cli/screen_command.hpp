#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/terminal/streams.hpp"

#include <optional>

namespace damslip::cli {

struct ScreenArguments {
    RunInputs inputs;
    std::filesystem::path out;      ///< folder for summary.json, displacements.csv and the resolved scene; empty: none
    std::filesystem::path pdf;      ///< the report on paper; empty: none
    bool rocking = false;           ///< the block that rocks, too, where the sliding one holds
    bool response_spectrum = false; ///< peaks by the modes, too
    std::filesystem::path spectrum; ///< in place of the records' spectra; empty: those
    std::optional<double> pga;      ///< of that spectrum [m/s^2]
    int jobs = 0;                   ///< threads; 0: all cores
};

/// Limit equilibrium, yield accelerations, rigid-block displacements and regressions for every record of the scene.
int screen(const ScreenArguments& arguments, const Streams& streams);

} // namespace damslip::cli
