#pragma once

#include "records/record.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace damslip::records {

/// What to do with a time column of unequal steps (more than 1e-3 of the mean step apart from it).
enum class UnevenTime {
    refuse,
    resample ///< linear interpolation at `ReadOptions::dt`, or at the smallest step of the file
};

/// What the file may leave unsaid. A value that contradicts the file is an error that names both.
struct ReadOptions {
    std::string unit; ///< of files that do not say: "g", "m/s2", "cm/s2", "gal", "mg", "mm/s2"; empty: the file says
    std::optional<double> dt; ///< of files without one [s], 1e-6 ... 1
    UnevenTime uneven = UnevenTime::refuse;
    std::string column; ///< heading, or number from 1, of the acceleration column where a file holds several; empty:
                        ///< the only one
    bool survey =
        false; ///< only what the file holds is asked: where nobody says unit or step, 1 m/s2 and 0.01 s stand for them
};

/// One accelerogram from a file, recognised by its content, never by its name. Formats: docs/records.md.
/// @throws InputError naming file, line and column, what is there, what is allowed and what to do. Nothing is guessed:
/// not the unit, not the time step, not which of several columns.
Record read_record(const std::filesystem::path& path, const ReadOptions& options = {});

/// The accelerograms of a file's content, one per acceleration column (or the one that `options.column` names).
/// @param file_name  for messages and provenance
/// Every record returned has dt in 1e-6 ... 1 s and 2 ... 5 million finite samples of at most 1e4 m/s^2.
std::vector<Record> parse_record(std::string_view content, std::string_view file_name, const ReadOptions& options = {});

} // namespace damslip::records
