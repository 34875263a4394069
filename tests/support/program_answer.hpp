#pragma once

#include "cli/program.hpp"

#include <sstream>
#include <string>
#include <vector>

namespace damslip {

/// What one command of the program answers.
struct ProgramAnswer {
    int code;
    std::string out, talk;
};

inline ProgramAnswer answer_of(const std::vector<std::string>& arguments)
{
    std::ostringstream out, talk;
    const int code = cli::run_program(arguments, out, talk, false);
    return {code, out.str(), talk.str()};
}

} // namespace damslip
