#pragma once

#include "analysis/sweep/sweep_identity.hpp"
#include "core/table.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace damslip::pages {

/// "results.csv", 2/4 -> "results.2-of-4.csv".
std::filesystem::path part_file(const std::filesystem::path& csv, const Shard& shard);

/// The file of a part: the comments of the whole sweep, one of its own with counts and a checksum, then its rows.
/// @param body  header row and rows  @param not_converged  rows whose method did not end properly
std::string part_text(const SweepIdentity& identity, const Shard& shard, const std::string& body, std::size_t rows,
                      std::size_t not_converged);

/// Parts put together.
struct MergedSweep {
    std::string text; ///< byte for byte the CSV of the sweep in one piece
    std::size_t parts = 0, rows = 0, not_converged = 0;
};

/// @param paths  part files, or folders: all files named *.i-of-n.csv in them
/// @throws InputError naming the parts that are missing, given twice, damaged, of another sweep or larger than 2 GiB
MergedSweep merge_parts(const std::vector<std::filesystem::path>& paths);

/// The rows of a sweep's CSV as they were before it was written. @throws InputError for other columns than sweep_table()
Table sweep_rows_of(const std::string& csv);

} // namespace damslip::pages
