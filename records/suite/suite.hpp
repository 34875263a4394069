#pragma once

#include "records/measure/measures.hpp"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace damslip::records {

/// What a suite is chosen from: one horizontal component, its spectrum at the periods of the target.
struct SuiteCandidate {
    std::string event;                ///< components of one event and station are no independent records
    std::vector<double> log_spectrum; ///< ln S_a at each period, S_a [m/s^2] or any unit that the target has
};

struct SuiteOptions {
    std::size_t select = 1; ///< records wanted, >= 1
    double max_scale = 4.0; ///< factors lie in 1/max_scale ... max_scale, >= 1 [-]
    bool least_scaling =
        false; ///< the target is one number, which every record meets: those with the smallest |ln factor|
    std::size_t most_subsets = 200'000; ///< up to so many are all tried
};

/// One record of a suite.
struct ChosenRecord {
    std::size_t record = 0; ///< place among the candidates
    double factor = 1.0;    ///< on the whole record [-]
    double misfit = 0.0;    ///< root mean square of ln(factor S_a / target) over the periods [-]
    bool at_limit = false;  ///< a factor beyond max_scale would fit better
};

struct SuiteSelection {
    std::vector<ChosenRecord> chosen; ///< by place
    double mean_misfit = 0.0;         ///< of the geometric mean of the scaled spectra, as ChosenRecord::misfit [-]
    double single_misfit = 0.0;       ///< root mean square of the records' own misfits [-]
    bool exhaustive = false;          ///< all subsets were tried; else found step by step
};

/// The factor with which a record fits best: ln f = mean over the periods of ln(target / S_a), the least squares of its logarithms (Kottke &
/// Rathje 2008), kept within the limits.
ChosenRecord scaled_to_target(const SuiteCandidate& candidate, std::span<const double> log_target, double max_scale);

/// Records whose mean, and each, fit the target: of sets of `select` records of different events the one with the smallest
/// (misfit of the geometric mean)^2 + mean of (misfit of each)^2. All sets where there are few; else one record after the other, the best
/// addition each time, then exchanges of one record while they help (Jayaram, Lin & Baker 2011).
/// @param log_target  ln S_a at each period, not empty
/// @throws InputError for more records than there are events, max_scale below 1, lists of different lengths
SuiteSelection select_suite(std::span<const SuiteCandidate> candidates, std::span<const double> log_target,
                            const SuiteOptions& options);

/// All candidates, each with its factor. @throws InputError as scaled_to_target()
SuiteSelection whole_suite(std::span<const SuiteCandidate> candidates, std::span<const double> log_target,
                           double max_scale);

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
