#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/terminal/streams.hpp"

namespace damslip::cli {

struct StudyArguments {
    RunInputs inputs;
    std::string method = "rigid,rigid-v,fe,fe-whole-steps,fe-goldgruber-2015,fe-radiating";
    std::filesystem::path out; ///< folder for rows.csv, findings.csv and report.html
    int jobs = 0;              ///< threads; 0: all cores
    bool resume = false;       ///< go on from rows.csv.journal
};

/// `damslip study`: the grid of Goldgruber (2015), chapter 4, on the scene's dam under its first record, and what of the source's
/// findings came out.
int study(const StudyArguments& arguments, const Streams& streams);

} // namespace damslip::cli
