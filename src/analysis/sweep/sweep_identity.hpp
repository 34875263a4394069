#pragma once

#include "analysis/sweep/fe_sweep.hpp"

namespace damslip {

/// All that the rows of a sweep depend on. Equal identities: equal rows, bit for bit, on one machine.
struct SweepIdentity {
    std::string version; ///< of the program
    std::string scene;   ///< scene_hash after the command line's changes
    std::string records; ///< SHA-256 over the contents of all record files and the imported mesh
    std::string grid;    ///< axes and options in words
    std::size_t rows = 0;

    friend bool operator==(const SweepIdentity&, const SweepIdentity&) = default;
};

/// The record files of the scene are read.
SweepIdentity sweep_identity(const Sweep& inputs);

/// SHA-256 over all members.
std::string hash_of(const SweepIdentity& identity);

/// Comment lines on top of the CSV.
std::vector<std::string> csv_comments(const SweepIdentity& identity);

} // namespace damslip
