#pragma once

#include "cli/input/run_inputs.hpp"

namespace damslip::cli {

struct FragilityArguments {
    RunInputs inputs; ///< SCENE and --strict
    std::string
        method; ///< rigid, rigid-v, fe, fe-exact, ...; empty: rigid-v where a record has a vertical component, else rigid
    std::optional<int> samples;        ///< runs per level; none: 1024 of the rigid block, 128 of finite elements
    std::string conditioning = "auto"; ///< on, off, auto: friction is not drawn for each run, but where it matters
    std::optional<double> aim;         ///< P that has to be known best, where friction is conditioned on
    std::optional<double> budget;      ///< processor seconds of finite elements in place of samples
    int rows = 128;                    ///< of each sample of the shares; 0: none
    std::filesystem::path out;         ///< folder; empty: no files
    std::filesystem::path pdf;         ///< the report on paper; empty: none
    int jobs = 0;                      ///< threads; 0: all cores
    bool allow_scaling = false;        ///< records beyond suite.max_scale
    bool resume = false, merge = false;
    std::string shard;                 ///< "i/n"
    std::filesystem::path slurm_array; ///< write a job script for all parts here instead
    int parts = 8;                     ///< of it
};

int fragility(const FragilityArguments& arguments, const Streams& streams);

} // namespace damslip::cli
