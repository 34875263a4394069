#include "cli/record_command.hpp"

#include "analysis/suite/record_suite.hpp"
#include "cli/command.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "pages/record/record_tables.hpp"
#include "pages/report/json.hpp"
#include "pages/report/table_text.hpp"
#include "records/write/write_record.hpp"

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

/// Matches the records of the lines, writes them beside the list and puts them in its lines.
/// @returns whether all are within the tolerance
bool match_lines(const RecordSuiteArguments& a, const RecordSuite& suite, const FittedSuite& fit,
                 const SuiteTarget& target, std::vector<SuiteLine>& lines, std::vector<std::string>& notes)
{
    bool good = true;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const records::ChosenRecord& chosen = fit.selection.chosen[i];
        const std::string& name = suite.rows[chosen.record].name;
        const MatchedMember member = match_member(suite, chosen, target, a.tolerance);
        const records::GeneratedRecord& matched = member.horizontal;
        good &= matched.within_tolerance;
        const std::filesystem::path file = a.out.parent_path() / (name + "_matched.csv");
        write_file(file, records::record_csv(matched.record));
        notes.push_back(fmt::format(
            "{}: scaled by {:.4g}, then matched: spectrum within {:.1f} % (worst at {:.3g} s, {} passes); Arias {:.3g} "
            "to {:.3g} m/s, PGV {:.3g} to {:.3g} m/s; {}{}",
            name, chosen.factor, 100.0 * matched.worst_deviation, matched.worst_period, matched.passes,
            member.before.arias_intensity, member.after.arias_intensity, member.before.pgv, member.after.pgv,
            file.string(),
            member.vertical ? "; its vertical component is scaled by the same factor and not matched" : ""));
        lines[i].horizontal = file;
        lines[i].column.clear();
        lines[i].other_horizontal.reset(); // not matched
        if (member.vertical) {
            lines[i].vertical = a.out.parent_path() / (name + "_scaled_v.csv");
            lines[i].vertical_column.clear();
            write_file(*lines[i].vertical, records::record_csv(*member.vertical));
        }
        lines[i].scale = 1.0;
    }
    return good;
}

/// @throws UsageError, InputError for a spectrum that is not known
SuiteTarget target_of(const RecordSuiteArguments& a)
{
    SuiteTarget target{*a.pga, {}, a.from, a.to};
    if (a.spectrum.empty()) return target;
    RecordGenerateArguments words;
    words.target = a.spectrum;
    words.ground = a.ground;
    target.spectrum = generate_target(words);
    return target;
}

} // namespace

int record_suite(const RecordSuiteArguments& a, const Streams& streams)
{
    check_suite(a);
    std::optional<SuiteTarget> target;
    if (a.pga) target = target_of(a);
    RecordSuite suite = read_suite(a.patterns.front());
    if (!suite.list.made.empty()) streams.remark(suite.list.made);
    std::vector<Table> tables{suite_index_table(suite.rows)};
    std::vector<std::string> names{"records"}, notes = suite.list.notes, comments{"damslip record suite"};
    std::vector<SuiteLine> lines;
    bool good = true;
    if (target) {
        const std::optional<std::size_t> select =
            a.select ? std::optional(static_cast<std::size_t>(*a.select)) : std::nullopt;
        const FittedSuite fit = fit_suite(suite, *target, select, a.max_scale);
        for (const records::ChosenRecord& c : fit.selection.chosen)
            lines.push_back(line_of(suite.list, c.record, c.factor));
        tables.push_back(suite_selection_table(suite.rows, fit.selection));
        names.emplace_back("selected");
        comments.push_back(fmt::format("target {}, PGA {} m/s2{}", target->spectrum ? target->spectrum->name : "PGA",
                                       *a.pga, target->spectrum ? fmt::format(", {} to {} s", a.from, a.to) : ""));
        if (target->spectrum) {
            tables.push_back(suite_spectrum_table(fit.periods, fit.target, fit.spectra, fit.selection));
            names.emplace_back("spectra");
        }
        if (a.match) good = match_lines(a, suite, fit, *target, lines, notes);
    } else {
        for (std::size_t i = 0; i < suite.rows.size(); ++i) lines.push_back(line_of(suite.list, i, 1.0));
    }
    suite.index.keep();
    if (!a.out.empty()) {
        comments.insert(comments.end(), notes.begin(), notes.end());
        write_file(a.out, suite_list_text(lines, a.out, comments));
    }
    Answer answer(json_header("record-suite"));
    for (std::size_t i = 0; i < tables.size(); ++i) answer.add(names[i], tables[i]);
    for (auto table = tables.rbegin(); table != tables.rend(); ++table) // what was chosen first
        answer.add("", *table, {.text = false, .brief = true, .data = false});
    for (const std::string& note : notes) {
        answer += note + "\n";
        answer.note_in_brief(note);
    }
    answer.set("notes", notes);
    answer.set("out", a.out.string());
    answer.headline_in_brief({target ? fmt::format("{} of {} records selected.", lines.size(), suite.rows.size())
                                     : fmt::format("{} records.", suite.rows.size())});
    put_answer(std::move(answer), "--out FILE.csv", streams);
    if (streams.form != Form::json && !a.out.empty() && !streams.quiet)
        streams.talk << fmt::format("{}: {} records; read it with  --records {}\n", a.out.string(), lines.size(),
                                    a.out.string());
    return good ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
