#pragma once

#include "cli/terminal/terminal.hpp"

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace damslip::cli {

struct WorkerArguments {
    std::filesystem::path scene;
    std::string method;                        ///< where a line names none; empty: rigid-v, rigid without vertical
    std::string record;                        ///< where a line names none
    std::vector<std::filesystem::path> dakota; ///< two: parameters in, results out
    std::vector<std::filesystem::path> quofem; ///< the same
};

/// Answers points of the scene: JSON lines from `in`, or one file of Dakota or quoFEM.
int worker(const WorkerArguments& arguments, const Streams& streams, std::istream& in);

} // namespace damslip::cli
