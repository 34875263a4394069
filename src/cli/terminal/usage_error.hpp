#pragma once

#include "core/input_error.hpp"
#include "core/status.hpp"

namespace damslip::cli {

/// The command line is wrong (exit code 2), as opposed to a file (exit code 3).
class UsageError : public InputError {
public:
    using InputError::InputError;
};

} // namespace damslip::cli
