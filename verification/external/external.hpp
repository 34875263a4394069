#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Results of other people and programs, each with its own accuracy, which is fixed before anything is compared.
namespace damslip::external {

/// One published number beside ours.
struct Result {
    std::string group; ///< what is counted together: "rigid block, slip"
    std::string what;  ///< the case: "Kobe 1995 TAK-090, 0.4 g, a_y 0.1 g, normal"
    std::string unit;
    double theirs = 0.0, ours = 0.0;
    double accuracy = 0.0;   ///< of theirs: what its digits and its own steps leave open [unit]
    bool reproduced = false; ///< their own scheme, written anew, gives their digits
    std::string reason;      ///< of a miss, with its proof; empty: none was found

    bool within() const; ///< |ours - theirs| <= accuracy; false for anything not finite
};

struct Source {
    std::string id; ///< "slammer"
    std::string citation;
    std::string subject;  ///< geometry and input in a sentence
    std::string accuracy; ///< how the accuracy of its numbers is fixed, and why
    std::string folder;   ///< file that has to be in the folder given; empty: all is in the program
    std::function<std::vector<Result>(const std::filesystem::path& folder)> run;
};

/// All sources, in the order of the page.
std::vector<Source> all_sources();

/// What was looked for and could not be had, a sentence each: source and what is missing.
std::vector<std::string> not_to_be_had();

} // namespace damslip::external
