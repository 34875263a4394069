#pragma once

#include "cli/terminal/streams.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace damslip::cli {

struct ManArguments {
    std::vector<std::string> command; ///< "record", "info"; empty: the program's own page
    std::filesystem::path out;        ///< folder for all pages; empty: one page on standard output
};

/// Manual pages from the help texts: damslip.1, damslip-screen.1, damslip-record-info.1, ...
int man(const ManArguments& arguments, const Streams& streams);

} // namespace damslip::cli
