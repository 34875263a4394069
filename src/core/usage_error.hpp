#pragma once

#include "core/input_error.hpp"
#include "core/status.hpp"

namespace damslip {

/// What was asked for is wrong (exit code 2), as opposed to a file (exit code 3).
class UsageError : public InputError {
public:
    using InputError::InputError;
};

/// @throws UsageError  @param problem, expected, fix  as Diagnostic has them
[[noreturn]] inline void refuse_usage(std::string problem, std::string expected, std::string fix)
{
    throw UsageError(Diagnostic{"", 0, 0, std::move(problem), std::move(expected), std::move(fix)});
}

} // namespace damslip
