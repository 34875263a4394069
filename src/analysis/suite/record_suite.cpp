#include "analysis/suite/record_suite.hpp"

#include "core/csv.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "records/measure/measures.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

/// Logarithms of the target at the suite's periods; of the PGA where it is all.
std::vector<double> log_target_of(const SuiteTarget& target, FittedSuite& fit)
{
    constexpr int periods = 60;
    if (!target.spectrum) return {std::log(target.pga)};
    fit.periods = records::logarithmic_periods(target.from, target.to, periods);
    std::vector<double> logarithms;
    for (const double t : fit.periods) {
        fit.target.push_back(target.pga * target.spectrum->amplification(t));
        logarithms.push_back(std::log(fit.target.back()));
    }
    return logarithms;
}

/// From the list's folder.
std::string listed_path(const std::filesystem::path& file, const std::filesystem::path& list)
{
    const std::filesystem::path folder = std::filesystem::absolute(list).parent_path();
    const std::string path = std::filesystem::absolute(file).lexically_normal().lexically_relative(folder).string();
    if (visible(path, LineEnds::replaced) != path)
        refuse(file, "a list cannot hold this path.", "a path without control characters", "rename the file");
    return csv_cell(path);
}

} // namespace

RecordSuite read_suite(const std::string& pattern)
{
    RecordSuite suite{record_list(pattern), {}, {}, records::SuiteIndex({})};
    if (suite.list.records.empty())
        refuse(pattern, "there is no record here.",
               "a folder, a pattern such as 'suite/*.AT2', or a CSV with horizontal", "correct the pattern");
    suite.index = records::SuiteIndex(suite.list.folder);
    for (std::size_t i = 0; i < suite.list.records.size(); ++i) {
        const RecordFiles& files = suite.list.records[i];
        Record record = records::read_record(files.horizontal, {files.unit, files.dt, {}, files.column});
        if (files.scale != 1.0) record = records::scaled(std::move(record), files.scale);
        suite.rows.push_back({files.name, suite.list.events[i], suite.index.measures(record)});
        if (!(suite.rows.back().measures.pga > 0.0))
            refuse(files.horizontal, "this record does not shake.", "samples other than 0", "leave it out");
        suite.horizontal.push_back(std::move(record));
    }
    return suite;
}

FittedSuite fit_suite(RecordSuite& suite, const SuiteTarget& target, std::optional<std::size_t> select,
                      double max_scale)
{
    FittedSuite fit;
    const std::vector<double> log_target = log_target_of(target, fit);
    std::vector<records::SuiteCandidate> candidates;
    for (std::size_t i = 0; i < suite.rows.size(); ++i) {
        fit.spectra.push_back(target.spectrum ? suite.index.spectrum(suite.horizontal[i], fit.periods)
                                              : std::vector<double>{suite.rows[i].measures.pga});
        candidates.push_back({suite.rows[i].event, {}});
        for (const double value : fit.spectra.back()) candidates.back().log_spectrum.push_back(std::log(value));
    }
    if (!select) {
        fit.selection = records::whole_suite(candidates, log_target, max_scale);
        return fit;
    }
    records::SuiteOptions options;
    options.max_scale = max_scale;
    options.least_scaling = !target.spectrum;
    options.select = *select;
    fit.selection = records::select_suite(candidates, log_target, options);
    return fit;
}

MatchedMember match_member(const RecordSuite& suite, const records::ChosenRecord& chosen, const SuiteTarget& target,
                           double tolerance)
{
    const Record scaled = records::scaled(suite.horizontal[chosen.record], chosen.factor);
    MatchedMember member{records::matched_record(scaled, target.spectrum.value(), target.pga, tolerance),
                         records::measure(scaled),
                         {},
                         {}};
    member.after = records::measure(member.horizontal.record);
    const RecordFiles& files = suite.list.records[chosen.record];
    if (files.vertical) // a factor of the list is on both components
        member.vertical =
            records::scaled(records::read_record(*files.vertical, {files.unit, files.dt, {}, files.vertical_column}),
                            files.scale * chosen.factor);
    return member;
}

SuiteLine line_of(const RecordList& list, std::size_t record, double factor)
{
    const RecordFiles& files = list.records[record];
    const auto cell = [](const std::string& column) {
        return column.substr(0, column.find(','));
    }; // its first word is enough
    return {files.horizontal,     files.vertical,       files.other_horizontal, list.events[record],
            list.weights[record], files.scale * factor, cell(files.column),     cell(files.vertical_column)};
}

std::string suite_list_text(const std::vector<SuiteLine>& lines, const std::filesystem::path& file,
                            const std::vector<std::string>& comments)
{
    std::string text;
    for (const std::string& comment : comments) text += "# " + visible(comment, LineEnds::replaced) + "\n";
    const bool others =
        std::any_of(lines.begin(), lines.end(), [](const SuiteLine& line) { return line.other_horizontal; });
    const bool columns = std::any_of(lines.begin(), lines.end(), [](const SuiteLine& line) {
        return !line.column.empty() || !line.vertical_column.empty();
    });
    const auto path = [&file](const std::optional<std::filesystem::path>& of) {
        return of ? listed_path(*of, file) : std::string();
    };
    text += fmt::format("horizontal,vertical,{}{}event,weight,scale\n", others ? "other_horizontal," : "",
                        columns ? "column,vertical_column," : "");
    for (const SuiteLine& line : lines)
        text += fmt::format("{},{},{}{}{},{},{}\n", path(line.horizontal), path(line.vertical),
                            others ? path(line.other_horizontal) + "," : "",
                            columns ? csv_cell(line.column) + "," + csv_cell(line.vertical_column) + "," : "", csv_cell(line.event),
                            shortest(line.weight), shortest(line.scale));
    return text;
}

} // namespace damslip
