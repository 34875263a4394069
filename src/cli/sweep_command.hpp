#pragma once

#include "cli/run_inputs.hpp"
#include "cli/streams.hpp"

namespace damslip::cli {

/// Lists as typed ("0.65:1.0:0.05"); empty: the scene's own value.
struct SweepArguments {
    RunInputs inputs;
    std::string friction, friction_deg, level, uplift, reservoir, scale, polarity;
    std::string method;        ///< empty: rigid, and rigid-v where a record has a vertical component
    std::filesystem::path out; ///< CSV file; empty: standard output
    int jobs = 0;              ///< threads; 0: all cores
};

/// Names of the methods --method takes.
std::vector<std::string> sweep_methods();

/// The full grid of friction x level x uplift x reservoir x scale x polarity x record x method, one CSV row each, in
/// that order for any number of threads.
int sweep(const SweepArguments& arguments, const Streams& streams);

} // namespace damslip::cli
