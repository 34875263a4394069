#pragma once

#include "cli/command.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace damslip::cli {

/// The whole program but for the process around it. @returns an ExitCode
/// @param talk_is_terminal  progress is drawn on it
/// @param rows              its commands
/// @param out_is_terminal   a person reads `out`: `sweep` prints its answer there, else its rows
/// @param unasked           form of text where neither --brief nor --full is given
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& talk, bool talk_is_terminal,
                std::span<const Command> rows = commands(), bool out_is_terminal = false,
                Form unasked = Form::full);

/// A program of this project from main() on: settings of the process (BLAS threads, memory, signals), then run_program().
int run_process(int argc, char** argv, std::span<const Command> rows);

} // namespace damslip::cli
