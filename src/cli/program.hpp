#pragma once

#include "cli/command.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace damslip::cli {

/// The whole program but for the process around it. @returns an ExitCode
/// @param talk_is_terminal  progress is drawn on it
/// @param rows              its commands
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& talk, bool talk_is_terminal,
                std::span<const Command> rows = commands());

} // namespace damslip::cli
