#pragma once

#include "program_answer.hpp"
#include "verification/program/carry.hpp"

namespace damslip {

/// What one command of damslip-verify answers.
inline ProgramAnswer verifier_answer(const std::vector<std::string>& arguments)
{
    std::ostringstream out, talk;
    const int code = cli::run_program(arguments, out, talk, false, cli::verifier_commands());
    return {code, out.str(), talk.str()};
}

} // namespace damslip
