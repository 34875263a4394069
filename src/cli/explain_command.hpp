#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/terminal/streams.hpp"

#include <filesystem>
#include <string>

namespace damslip::cli {

struct ExplainArguments {
    RunInputs inputs;
    std::string method = "rigid"; ///< "rigid" or "fe"
    bool ablate = false;          ///< runs the scene without each of its effects
    std::filesystem::path report; ///< of the ablation, HTML; empty: none
    int jobs = 1;                 ///< threads of the ablation, 0: all cores
};

/// The effect plan: which effects are on, why, and what each costs.
int explain(const ExplainArguments& arguments, const Streams& streams);

/// `explain --ablate`: the scene without each of its effects in turn. @returns an ExitCode
int ablate(const ExplainArguments& arguments, const Streams& streams);

} // namespace damslip::cli
