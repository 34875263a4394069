#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/terminal/streams.hpp"

namespace damslip::cli {

struct AssessArguments {
    RunInputs inputs;
    double budget = 120.0;     ///< wall time [s]
    int jobs = 0;              ///< threads of the quick levels; 0: all cores
    std::filesystem::path out; ///< folder for report.html, assess.json, scene.resolved.toml; empty: none
    std::filesystem::path pdf; ///< the report as PDF; empty: none
};

/// Every level on one dam, with a recommended slip and its range.
/// @returns exit_no_answer where no level has an answer, and the dam does not fail under its static loads either
int assess_dam(const AssessArguments& arguments, const Streams& streams);

} // namespace damslip::cli
