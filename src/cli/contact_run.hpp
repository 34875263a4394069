#pragma once

#include "cli/fe_command.hpp"
#include "cli/input/run_inputs.hpp"

namespace damslip::cli {

/// `fe`: the dam slides, opens and rocks on its base. Static stages, earthquake with exact Coulomb contact, run-out, static state after
/// it; the rigid block's slip beside it.
int run_contact(const FeArguments& arguments, const Ready& ready, const Streams& streams);

} // namespace damslip::cli
