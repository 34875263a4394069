#include "cli/record_command.hpp"

#include "analysis/prepare/record_list.hpp"
#include "core/file.hpp"
#include "core/number.hpp"
#include "core/usage_error.hpp"
#include "pages/record/record_tables.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "records/measure/response_spectrum.hpp"
#include "records/suite/suite_index.hpp"
#include "records/transform/transform.hpp"
#include "records/write/write_record.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

void check_suite(const RecordSuiteArguments& a)
{
    if (a.patterns.size() != 1)
        refuse_usage(fmt::format("record suite has {} patterns.", a.patterns.size()), "one folder, pattern or list",
                     "put a pattern in quotes:  damslip record suite 'suite/*.AT2'");
    const auto in_range = [](const char* flag, double value, double low, double high, const char* unit) {
        if (!(value >= low && value <= high))
            refuse_usage(fmt::format("{} {} is not allowed.", flag, value), fmt::format("{} to {}{}", low, high, unit),
                         "correct it");
    };
    if (a.pga) in_range("--target-pga-m-s2", *a.pga, 1e-3, 50.0, " m/s2");
    in_range("--max-scale", a.max_scale, 1.0, 1000.0, "");
    in_range("--from", a.from, 0.01, 10.0, " s");
    in_range("--to", a.to, 0.01, 10.0, " s");
    in_range("--tolerance", a.tolerance, 0.01, 0.5, "");
    if (!(a.from < a.to))
        refuse_usage(fmt::format("--from {} --to {} is not allowed.", a.from, a.to), "a band, from the shorter period",
                     "for example  --from 0.05 --to 2");
    if (!a.spectrum.empty() && !a.pga)
        refuse_usage("--target-spectrum without --target-pga-m-s2.", "both: of a spectrum only its shape counts",
                     "add  --target-pga-m-s2 2.0");
    if (a.select && !a.pga)
        refuse_usage("--select without a target.", "--target-pga-m-s2, and --target-spectrum for a whole spectrum",
                     "add  --target-pga-m-s2 2.0");
    if (a.match && a.spectrum.empty())
        refuse_usage("--match without --target-spectrum.", "both", "add  --target-spectrum rock");
    if (a.match && a.out.empty())
        refuse_usage("--match without --out.", "a list; the matched records go beside it",
                     "add  --out suite/suite.csv");
}

/// The records of a suite, read and measured.
struct MeasuredSuite {
    RecordList list;
    std::vector<Record> horizontal;
    std::vector<SuiteRow> rows;
    records::SuiteIndex index; ///< keeps what is measured
};

MeasuredSuite measured(const std::string& pattern)
{
    MeasuredSuite suite{record_list(pattern), {}, {}, records::SuiteIndex({})};
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

/// A path of a list, from the list's folder. @throws InputError for one that a CSV cannot hold
std::string listed_path(const std::filesystem::path& file, const std::filesystem::path& list)
{
    const std::filesystem::path folder = std::filesystem::absolute(list).parent_path();
    const std::string path = std::filesystem::absolute(file).lexically_normal().lexically_relative(folder).string();
    if (path.find_first_of(",\n\r\"") != std::string::npos)
        refuse(file, "a list cannot hold this path.", "a path without commas and quotes", "rename the file");
    return path;
}

/// One line of the list that is written.
struct SuiteLine {
    std::filesystem::path horizontal;
    std::optional<std::filesystem::path> vertical, other_horizontal;
    std::string event;
    double weight = 1.0, scale = 1.0;
};

std::string list_text(const std::vector<SuiteLine>& lines, const std::filesystem::path& out,
                      const std::vector<std::string>& comments)
{
    std::string text;
    for (const std::string& comment : comments) text += "# " + comment + "\n";
    const bool others =
        std::any_of(lines.begin(), lines.end(), [](const SuiteLine& line) { return line.other_horizontal; });
    const auto path = [&out](const std::optional<std::filesystem::path>& file) {
        return file ? listed_path(*file, out) : std::string();
    };
    text += fmt::format("horizontal,vertical,{}event,weight,scale\n", others ? "other_horizontal," : "");
    for (const SuiteLine& line : lines)
        text += fmt::format("{},{},{}{},{},{}\n", listed_path(line.horizontal, out), path(line.vertical),
                            others ? path(line.other_horizontal) + "," : "", line.event, shortest(line.weight),
                            shortest(line.scale));
    return text;
}

/// The selection, and what it was fitted to.
struct FittedSuite {
    std::vector<double> periods, target; ///< empty: PGA alone
    std::vector<std::vector<double>> spectra;
    records::SuiteSelection selection;
};

FittedSuite fitted(const RecordSuiteArguments& a, MeasuredSuite& suite, const records::TargetSpectrum* target)
{
    constexpr int periods = 60;
    FittedSuite fit;
    std::vector<double> log_target{std::log(*a.pga)};
    if (target) {
        fit.periods = records::logarithmic_periods(a.from, a.to, periods);
        log_target.clear();
        for (const double t : fit.periods) {
            fit.target.push_back(*a.pga * target->amplification(t));
            log_target.push_back(std::log(fit.target.back()));
        }
    }
    std::vector<records::SuiteCandidate> candidates;
    for (std::size_t i = 0; i < suite.rows.size(); ++i) {
        std::vector<double> spectrum;
        if (target)
            spectrum = suite.index.spectrum(suite.horizontal[i], fit.periods);
        else
            spectrum.push_back(suite.rows[i].measures.pga);
        std::vector<double> logarithms;
        for (const double value : spectrum) logarithms.push_back(std::log(value));
        candidates.push_back({suite.rows[i].event, std::move(logarithms)});
        fit.spectra.push_back(std::move(spectrum));
    }
    if (!a.select) {
        fit.selection = records::whole_suite(candidates, log_target, a.max_scale);
        return fit;
    }
    records::SuiteOptions options;
    options.max_scale = a.max_scale;
    options.least_scaling = !target;
    options.select = static_cast<std::size_t>(*a.select);
    fit.selection = records::select_suite(candidates, log_target, options);
    return fit;
}

/// Matches the records of the lines, writes them beside the list and puts them in its lines.
/// @returns whether all are within the tolerance
bool match_lines(const RecordSuiteArguments& a, const MeasuredSuite& suite, const FittedSuite& fit,
                 const records::TargetSpectrum& target, std::vector<SuiteLine>& lines, std::vector<std::string>& notes)
{
    bool good = true;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const records::ChosenRecord& chosen = fit.selection.chosen[i];
        const SuiteRow& row = suite.rows[chosen.record];
        const records::GeneratedRecord matched = records::matched_record(
            records::scaled(suite.horizontal[chosen.record], chosen.factor), target, *a.pga, a.tolerance);
        good &= matched.within_tolerance;
        const std::filesystem::path file = a.out.parent_path() / (row.name + "_matched.csv");
        write_file(file, records::record_csv(matched.record));
        const records::Measures after = records::measure(matched.record);
        notes.push_back(fmt::format(
            "{}: scaled by {:.4g}, then matched: spectrum within {:.1f} % (worst at {:.3g} s, {} passes); Arias {:.3g} "
            "to {:.3g} m/s, PGV {:.3g} to {:.3g} m/s; {}{}",
            row.name, chosen.factor, 100.0 * matched.worst_deviation, matched.worst_period, matched.passes,
            chosen.factor * chosen.factor * row.measures.arias_intensity, after.arias_intensity,
            chosen.factor * row.measures.pgv, after.pgv, file.string(),
            lines[i].vertical ? "; its vertical component is scaled by the same factor and not matched" : ""));
        lines[i].horizontal = file;
        lines[i].other_horizontal.reset(); // not matched
        if (lines[i].vertical) {           // a factor of the list is on both components
            const RecordFiles& files = suite.list.records[chosen.record];
            const Record up =
                records::read_record(*lines[i].vertical, {files.unit, files.dt, {}, files.vertical_column});
            const std::filesystem::path scaled = a.out.parent_path() / (row.name + "_scaled_v.csv");
            write_file(scaled, records::record_csv(records::scaled(up, files.scale * chosen.factor)));
            lines[i].vertical = scaled;
        }
        lines[i].scale = 1.0;
    }
    return good;
}

} // namespace

int record_suite(const RecordSuiteArguments& a, const Streams& streams)
{
    check_suite(a);
    std::optional<records::TargetSpectrum> target;
    if (!a.spectrum.empty()) {
        RecordGenerateArguments words;
        words.target = a.spectrum;
        words.ground = a.ground;
        target = generate_target(words);
    }
    MeasuredSuite suite = measured(a.patterns.front());
    if (!suite.list.made.empty() && !streams.quiet) streams.talk << suite.list.made << "\n";
    std::vector<Table> tables{suite_index_table(suite.rows)};
    std::vector<std::string> names{"records"}, notes = suite.list.notes, comments{"damslip record suite"};
    std::vector<SuiteLine> lines;
    bool good = true;
    const auto line_of = [&](std::size_t i, double factor) {
        const RecordFiles& files = suite.list.records[i];
        return SuiteLine{files.horizontal,     files.vertical,        files.other_horizontal,
                         suite.list.events[i], suite.list.weights[i], files.scale * factor};
    };
    if (a.pga) {
        const FittedSuite fit = fitted(a, suite, target ? &*target : nullptr);
        for (const records::ChosenRecord& c : fit.selection.chosen) lines.push_back(line_of(c.record, c.factor));
        tables.push_back(suite_selection_table(suite.rows, fit.selection));
        names.emplace_back("selected");
        comments.push_back(fmt::format("target {}, PGA {} m/s2{}", target ? target->name : "PGA", *a.pga,
                                       target ? fmt::format(", {} to {} s", a.from, a.to) : ""));
        if (target) {
            tables.push_back(suite_spectrum_table(fit.periods, fit.target, fit.spectra, fit.selection));
            names.emplace_back("spectra");
        }
        if (a.match) good = match_lines(a, suite, fit, *target, lines, notes);
    } else {
        for (std::size_t i = 0; i < suite.rows.size(); ++i) lines.push_back(line_of(i, 1.0));
    }
    suite.index.keep();
    if (!a.out.empty()) {
        comments.insert(comments.end(), notes.begin(), notes.end());
        write_file(a.out, list_text(lines, a.out, comments));
    }
    if (streams.form == Form::json) {
        auto j = json_header("record-suite");
        for (std::size_t i = 0; i < tables.size(); ++i) j[names[i]] = json_of(tables[i]);
        j["notes"] = notes;
        j["out"] = a.out.string();
        streams.out << j.dump(2) << "\n";
    } else {
        for (const Table& table : tables) streams.out << text(table) << "\n";
        for (const std::string& note : notes) streams.out << note << "\n";
        if (!a.out.empty() && !streams.quiet)
            streams.talk << fmt::format("{}: {} records; read it with  --records {}\n", a.out.string(), lines.size(),
                                        a.out.string());
    }
    return good ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
