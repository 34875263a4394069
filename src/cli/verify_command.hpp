#pragma once

#include "cli/terminal/streams.hpp"

#include <filesystem>
#include <string>

namespace damslip::cli {

struct VerifyArguments {
    std::string filter;        ///< part of the ids to run; empty: all
    bool markdown = false;     ///< print docs/verification.md
    bool hard = false;         ///< the hard cases instead
    bool external = false;     ///< results of others instead; `filter` is then the folder of what is not shipped
    std::filesystem::path svg; ///< scatter plot of those
};

/// Runs the verification cases, or the hard ones. @returns exit_ok when every check passes, else exit_no_answer.
int verify(const VerifyArguments& arguments, const Streams& streams);

/// Runs the hard cases whose id holds `filter`. @returns exit_ok when every one passes, else exit_no_answer.
int verify_hard(const std::string& filter, const Streams& streams);

/// Runs what others published. @returns exit_ok when 97 % lie within the accuracy of their sources, else exit_no_answer.
int verify_external(const VerifyArguments& arguments, const Streams& streams);

} // namespace damslip::cli
