#pragma once

#include "cli/terminal/streams.hpp"

namespace damslip::cli {

/// Prints a completion script for bash, zsh or fish.
int completion(const std::string& shell, const Streams& streams);

} // namespace damslip::cli
