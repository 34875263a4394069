#pragma once

#include "cli/fe_command.hpp"
#include "cli/input/run_inputs.hpp"

namespace damslip::cli {

/// `fe --base tied`: static stages and the linear earthquake run of a dam bonded to its base.
int run_tied(const FeArguments& arguments, const Ready& ready, const Streams& streams);

} // namespace damslip::cli
