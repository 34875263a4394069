#pragma once

#include "cli/fe_command.hpp"
#include "cli/input/run_inputs.hpp"

namespace damslip::cli {

/// `fe --reduced`: static stages by the full model, earthquake on few modes of the dam; the slip with an estimate of what the reduction
/// changes.
int run_reduced(const FeArguments& arguments, const Ready& ready, const Streams& streams);

} // namespace damslip::cli
