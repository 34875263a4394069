#pragma once

#include "cli/terminal/terminal.hpp"
#include "core/csv.hpp"
#include "records/generate/generate.hpp"
#include "records/measure/measures.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// `damslip record info|convert|baseline|scale|spectrum|generate|suite`. Each command has its arguments, a function that computes (testable
/// without streams) and one that talks. Data goes to `out` files or standard output, remarks to the talk stream.
namespace damslip::cli {

/// What all commands that read a record take.
struct RecordInput {
    std::filesystem::path file;
    std::string unit;         ///< --units
    std::optional<double> dt; ///< --dt [s]
    std::string column;       ///< --column
    bool resample = false;    ///< --resample: uneven times are interpolated
};
Record read(const RecordInput& input);

enum class RecordOutput { csv, csv_with_time, at2 }; ///< --to csv | csv-time | at2

/// Where a record goes; no file: standard output.
struct RecordTarget {
    std::filesystem::path out;
    std::string to; ///< --to
};
/// Word of --to; empty: by the ending of `out` (.at2: at2, else csv). @throws UsageError for others.
RecordOutput record_output(const std::string& word, const std::filesystem::path& out);

struct RecordInfoArguments {
    std::vector<std::filesystem::path> files;
    RecordInput reading; ///< of all files
};
int record_info(const RecordInfoArguments& arguments, const Streams& streams);

struct RecordConvertArguments {
    RecordInput input;
    RecordTarget target;
    std::optional<double> new_dt; ///< --new-dt [s]: another time step
};
int record_convert(const RecordConvertArguments& arguments, const Streams& streams);

struct RecordBaselineArguments {
    RecordInput input;
    RecordTarget target;
    std::string degree = "quadratic"; ///< --degree constant | linear | quadratic
    std::string fit = "velocity";     ///< --fit velocity | acceleration
};
int record_baseline(const RecordBaselineArguments& arguments, const Streams& streams);

struct RecordScaleArguments {
    RecordInput input;
    RecordTarget target;
    std::optional<double> factor;   ///< --factor [-], negative flips the polarity
    std::optional<double> pga_m_s2; ///< --pga-m-s2; one of both
};
int record_scale(const RecordScaleArguments& arguments, const Streams& streams);

struct RecordSpectrumArguments {
    RecordInput input;
    std::filesystem::path out;    ///< CSV; empty: table on standard output
    double ratio = 0.05;          ///< --damping [-], 0 ... 1
    double from = 0.02, to = 4.0; ///< --from, --to [s]
    int count = 100;              ///< --count, 2 ... 10000
};
records::ResponseSpectrum record_spectrum_of(const Record& record, const RecordSpectrumArguments& arguments);
int record_spectrum(const RecordSpectrumArguments& arguments, const Streams& streams);

struct RecordGenerateArguments {
    std::string target = "rock";       ///< --target rock | ec8-1 | ec8-2 | a CSV file of period [s] and S_a
    std::string ground = "A";          ///< --ground A ... E, of ec8
    std::string component = "h";       ///< --component h | v
    records::GenerateOptions options;  ///< --pga-m-s2 --duration --dt --tolerance --rise --level
    std::string envelope = "compound"; ///< --envelope compound | trapezoid
    std::int64_t seed = 1;             ///< --seed, >= 0
    RecordTarget destination;
};
/// The target spectrum of the arguments. @throws UsageError, InputError
records::TargetSpectrum generate_target(const RecordGenerateArguments& arguments);
records::GeneratedRecord generate(const RecordGenerateArguments& arguments);
int record_generate(const RecordGenerateArguments& arguments, const Streams& streams);

struct RecordSuiteArguments {
    std::vector<std::string> patterns; ///< one: a folder, a pattern in quotes, a list
    std::string spectrum;              ///< --target-spectrum rock | ec8-1 | ec8-2 | a CSV file; empty: PGA alone
    std::string ground = "A";          ///< --ground A ... E, of ec8
    std::optional<double> pga;         ///< --target-pga-m-s2; none: the index alone
    double from = 0.05, to = 2.0;      ///< --from, --to: the band that is fitted [s]
    std::optional<int> select;         ///< --select; none: all, each with its factor
    double max_scale = 4.0;            ///< --max-scale [-]
    bool match = false;                ///< --match: by wavelets, after scaling
    double tolerance = 0.10;           ///< --tolerance, of the match [-]
    std::filesystem::path out;         ///< list for --records and [suite] files
};
/// The index of a suite, and those of its records that fit a target, each with its factor.
int record_suite(const RecordSuiteArguments& arguments, const Streams& streams);

} // namespace damslip::cli
