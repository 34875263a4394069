#pragma once

#include "cli/terminal/streams.hpp"

namespace damslip::cli {

struct VerifyArguments {
    std::string filter;    ///< part of the ids to run; empty: all
    bool markdown = false; ///< print docs/verification.md
    bool hard = false;     ///< the hard cases instead
};

/// Runs the verification cases, or the hard ones. @returns exit_ok when every check passes, else exit_no_answer.
int verify(const VerifyArguments& arguments, const Streams& streams);

/// Runs the hard cases whose id holds `filter`. @returns exit_ok when every one passes, else exit_no_answer.
int verify_hard(const std::string& filter, const Streams& streams);

} // namespace damslip::cli
