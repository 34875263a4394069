#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace damslip::cli {

/// The whole program but for the process around it. @returns an ExitCode
/// @param talk  a terminal: progress is drawn on it
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& talk,
                bool talk_is_terminal);

} // namespace damslip::cli
