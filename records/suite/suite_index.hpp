#pragma once

#include "records/measure/measures.hpp"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace damslip::records {

/// Measures and spectra of a suite's records, worked out once and kept in a file `.damslip-index.csv`: a line for each motion, found again by
/// the SHA-256 of its samples and its step, so that a record that changed is measured anew. Numbers are written so that they read back as the same
/// double: it changes times, no results.
class SuiteIndex {
public:
    /// @param folder  of the suite; what is no index there is passed over and written anew. Empty: nothing is kept
    explicit SuiteIndex(const std::filesystem::path& folder);

    /// As records::measure().
    Measures measures(const Record& record);

    /// Pseudo-accelerations at 5 % damping, as response_spectrum() [m/s^2]. @param periods  [s], >= 0
    std::vector<double> spectrum(const Record& record, std::span<const double> periods);

    /// Writes what is new. A folder that cannot be written keeps nothing, without a word.
    void keep() const;

    std::size_t computed() const { return computed_; } ///< measures and ordinates that were not there

private:
    struct Line {
        std::string record; ///< name when it was measured, for the reader of the file
        std::map<std::string, std::string> cells;
    };
    Line& line_of(const Record& record);
    void read();

    std::filesystem::path file_;
    std::map<std::string, Line> lines_; ///< by checksum
    std::size_t computed_ = 0;
};

} // namespace damslip::records
