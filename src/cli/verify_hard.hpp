#pragma once

#include "cli/terminal/streams.hpp"

#include <string>

namespace damslip::cli {

/// Runs the hard cases whose id holds `filter`. @returns exit_ok when every one passes, else exit_no_answer.
int verify_hard(const std::string& filter, const Streams& streams);

/// Their table of docs/verification.md, without figures: nothing is run.
std::string hard_markdown();

} // namespace damslip::cli
