#pragma once

#include "cli/terminal/streams.hpp"

#include <filesystem>
#include <string>

namespace damslip::cli {

struct ExplainArguments {
    std::filesystem::path scene;
    std::string method = "rigid"; ///< "rigid" or "fe"
};

/// The effect plan: which effects are on, why, and what each costs.
int explain(const ExplainArguments& arguments, const Streams& streams);

} // namespace damslip::cli
