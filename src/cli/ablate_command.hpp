#pragma once

#include "cli/explain_command.hpp"

namespace damslip::cli {

/// `explain --ablate`: the scene without each of its effects in turn. @returns an ExitCode
int ablate(const ExplainArguments& arguments, const Streams& streams);

} // namespace damslip::cli
