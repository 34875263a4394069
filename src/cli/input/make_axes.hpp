#pragma once

#include "analysis/sweep/sweep_axes.hpp"
#include "cli/input/run_inputs.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace damslip::cli {

/// Lists as typed ("0.65:1.0:0.05"); empty: the scene's own value.
struct SweepArguments {
    RunInputs inputs;
    std::string friction, friction_deg, level, uplift, opening_water, reservoir, size, period, damping, scale, polarity, plane;
    std::string method;                      ///< empty: rigid, and rigid-v where a record has a vertical component
    std::optional<int> modes;                ///< elastic modes of fe-reduced, 1 ... 1000; none: its own choice
    bool truncation_error = false;           ///< of fe-reduced: estimated for every row
    std::optional<double> penalty_stiffness; ///< of fe-penalty [N/m^3], > 0; none: the scene's

    std::filesystem::path pdf;                ///< the report on paper; empty: none
    std::filesystem::path out;                ///< CSV file, its database beside it; empty: standard output, no database
    int jobs = 0;                             ///< threads; 0: all cores
    bool resume = false;                      ///< go on from the database
    std::string shard;                        ///< "i/n": this part only, into a file of its own; empty: all rows
    bool plan = false;                        ///< print the commands of all parts instead
    std::filesystem::path slurm_array;        ///< write a job script for all parts here instead; empty: no
    std::optional<int> parts;                 ///< of plan and job script; none: one for each scene variant and motion
    bool mean_polarity = false;               ///< a column with the mean slip of both polarities
    std::vector<std::filesystem::path> merge; ///< databases of parts, or folders of them, to put together instead
};

/// A flag of the grid and its list as typed.
struct GridFlag {
    const char* flag;
    std::string SweepArguments::*list;
};
inline constexpr GridFlag grid_flags[] = {{"--friction", &SweepArguments::friction},
                                          {"--friction-deg", &SweepArguments::friction_deg},
                                          {"--plane", &SweepArguments::plane},
                                          {"--level", &SweepArguments::level},
                                          {"--uplift", &SweepArguments::uplift},
                                          {"--opening-water", &SweepArguments::opening_water},
                                          {"--reservoir", &SweepArguments::reservoir},
                                          {"--size", &SweepArguments::size},
                                          {"--period", &SweepArguments::period},
                                          {"--damping", &SweepArguments::damping},
                                          {"--scale", &SweepArguments::scale},
                                          {"--polarity", &SweepArguments::polarity}};

/// The axes as typed, checked; the scene's own value where nothing is. @throws UsageError
Axes make_axes(const SweepArguments& arguments, const Scene& scene);

/// "1.00,0.84,0.77" or "0.65:1.0:0.05" (first, last, step; the last value is included when the step meets it) or a mix
/// of both.
/// @param flag  for messages: "--friction"
/// @throws UsageError  for anything else, non-finite numbers, a step of the wrong sign, more than 100 000 values
std::vector<double> number_list(const std::string& text, const std::string& flag);

/// "0,7" read with a decimal comma: 0.7. Nothing for any other list than two whole numbers.
std::optional<double> decimal_comma(const std::string& text);

/// "a,b,c" as words; each must be one of `allowed` (empty: any). @throws UsageError with the nearest allowed word.
std::vector<std::string> word_list(const std::string& text, const std::string& flag,
                                   const std::vector<std::string>& allowed);

} // namespace damslip::cli
