#pragma once

#include "cli/command.hpp"

namespace damslip::cli {

/// A program of this project from main() on: settings of the process (BLAS threads, memory, signals), then run_program().
int run_process(int argc, char** argv, std::span<const Command> rows);

} // namespace damslip::cli
