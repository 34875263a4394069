#pragma once

#include "core/input_error.hpp"

namespace damslip::cli {

/// The command line is wrong (exit code 2), as opposed to a file (exit code 3).
class UsageError : public InputError {
public:
    using InputError::InputError;
};

/// A solver that lost its accuracy, found where only an answer can be returned (exit code 4).
class NotConverged : public InputError {
public:
    using InputError::InputError;
};

/// Exit codes of the program.
enum ExitCode { exit_ok = 0, exit_internal = 1, exit_usage = 2, exit_input = 3, exit_no_convergence = 4 };

} // namespace damslip::cli
