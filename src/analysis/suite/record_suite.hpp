#pragma once

#include "analysis/prepare/record_list.hpp"
#include "records/generate/generate.hpp"
#include "records/suite/suite.hpp"

#include <optional>
#include <string>
#include <vector>

/// Records of a folder, a pattern or a list: measured, fitted to a target, matched to it.
namespace damslip {

/// A record of a suite, measured: the row of its index.
struct SuiteRow {
    std::string name, event;
    records::Measures measures;
};

/// The horizontal components of a suite, read and measured.
struct RecordSuite {
    RecordList list;
    std::vector<Record> horizontal; ///< with the factors of the list
    std::vector<SuiteRow> rows;
    records::SuiteIndex index; ///< index.keep() writes what was measured
};

/// @param pattern  as of record_list() @throws InputError as record_list() and the reading of records; for no record at all, and for one
/// whose samples are all 0
RecordSuite read_suite(const std::string& pattern);

/// What the records shall have.
struct SuiteTarget {
    double pga = 1.0;                                ///< [m/s^2]
    std::optional<records::TargetSpectrum> spectrum; ///< its shape, scaled to the PGA; absent: the PGA alone
    double from = 0.05, to = 2.0;                    ///< band of periods that is fitted [s]
};

/// Records that fit a target, each with its factor.
struct FittedSuite {
    std::vector<double> periods, target; ///< [s], [m/s^2]; empty: PGA alone
    std::vector<std::vector<double>>
        spectra;                       ///< of all records at these periods; their PGA where it is the target [m/s^2]
    records::SuiteSelection selection; ///< its records are places in the suite
};

/// @param select  how many records, of different events; absent: all @param max_scale  largest factor, >= 1
/// @throws InputError as records::select_suite()
FittedSuite fit_suite(RecordSuite& suite, const SuiteTarget& target, std::optional<std::size_t> select,
                      double max_scale);

/// A record that was scaled, then matched by wavelets.
struct MatchedMember {
    records::GeneratedRecord horizontal;
    records::Measures before, after; ///< of the scaled record, and of the matched one
    std::optional<Record> vertical;  ///< scaled by the same factor and not matched
};

/// @param target  with a spectrum @param tolerance  largest deviation from it [-] @throws InputError as records::matched_record()
MatchedMember match_member(const RecordSuite& suite, const records::ChosenRecord& chosen, const SuiteTarget& target,
                           double tolerance);

/// One line of a list of records.
struct SuiteLine {
    std::filesystem::path horizontal;
    std::optional<std::filesystem::path> vertical, other_horizontal;
    std::string event;
    double weight = 1.0, scale = 1.0;
    std::string column, vertical_column; ///< of files that hold several
};

/// The line of a record, its factor times that of the list it comes from.
SuiteLine line_of(const RecordList& list, std::size_t record, double factor);

/// CSV that record_list() reads. @param file  where it will stand: paths start from its folder @param comments  lines above it
/// @throws InputError for a path with a comma, a quote or a line break
std::string suite_list_text(const std::vector<SuiteLine>& lines, const std::filesystem::path& file,
                            const std::vector<std::string>& comments);

} // namespace damslip
