#include "verification/program/carry.hpp"

#include "cli/command.hpp"
#include "cli/terminal/terminal.hpp"
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/version.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "verification/pages/evidence.hpp"
#include "verification/pages/manual.hpp"
#include "verification/pages/verify_tables.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

/// The cases whose id contains `filter`.
/// @param command  as the user gave it, for the message
/// @throws UsageError if there is none
template <class Case>
std::vector<const Case*> select_cases(const std::vector<Case>& cases, const std::string& filter,
                                      std::string_view command)
{
    std::vector<const Case*> selected;
    for (const Case& c : cases)
        if (c.id.find(filter) != std::string::npos) selected.push_back(&c);
    if (selected.empty())
        throw UsageError(Diagnostic{"", 0, 0, fmt::format("{}: no case has \"{}\" in its name.", command, filter),
                                    fmt::format("part of a case id, such as {}", cases.front().id),
                                    fmt::format("run  damslip {}  without a filter to see them all", command)});
    return selected;
}

/// Runs those cases, which must outlive what is returned, one after the other. @param command  as the user gave it
template <class Outcome, class Case>
std::vector<Outcome> outcomes_of(const std::vector<Case>& cases, const std::string& filter, const std::string& command,
                                 const Streams& streams)
{
    const auto selected = select_cases(cases, filter, command);
    std::vector<Outcome> outcomes;
    Progress progress(streams, command, static_cast<double>(selected.size()));
    for (const Case* c : selected) {
        const Stopwatch start;
        outcomes.push_back({c, c->run(), 0.0});
        outcomes.back().seconds = start.seconds();
        progress.advance(1);
    }
    return outcomes;
}

template <class Outcome>
double seconds_of(const std::vector<Outcome>& outcomes)
{
    double seconds = 0.0;
    for (const Outcome& o : outcomes) seconds += o.seconds;
    return seconds;
}

/// Runs the verification cases. @returns exit_ok when every check passes, else exit_no_answer.
int verify_closed(const VerifyArguments& arguments, const Streams& streams)
{
    const verification::Registry cases = verification::all_cases();
    const auto outcomes = outcomes_of<CaseOutcome>(cases, arguments.filter, "verify", streams);
    std::size_t checks = 0, failed = 0;
    for (const CaseOutcome& o : outcomes) {
        checks += o.checks.size();
        for (const verification::Check& check : o.checks) failed += check.passed() ? 0 : 1;
    }
    if (arguments.markdown) {
        streams.out << markdown_of(outcomes) << hard_markdown();
    } else if (streams.form == Form::json) {
        auto j = json_header("verify");
        j["cases"] = outcomes.size();
        j["checks"] = checks;
        j["failed"] = failed;
        j["seconds"] = seconds_of(outcomes);
        j["results"] = json_of(check_table(outcomes));
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << text(check_table(outcomes))
                    << fmt::format("{} cases, {} checks, {} failed, {:.2f} s\n", outcomes.size(), checks, failed,
                                   seconds_of(outcomes));
    }
    return failed == 0 ? exit_ok : exit_no_answer;
}

/// Runs the hard cases. @returns exit_ok when every one passes, else exit_no_answer.
int verify_hard(const VerifyArguments& arguments, const Streams& streams)
{
    const hard::HardCases cases = hard::all_hard_cases();
    const auto outcomes = outcomes_of<HardOutcome>(cases, arguments.filter, "verify --hard", streams);
    std::size_t failed = 0;
    for (const HardOutcome& o : outcomes) failed += o.passed() ? 0 : 1;
    if (streams.form == Form::json) {
        auto j = json_header("verify-hard");
        j["cases"] = outcomes.size();
        j["failed"] = failed;
        j["seconds"] = seconds_of(outcomes);
        j["results"] = json_of(hard_table(outcomes));
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << text(hard_table(outcomes))
                    << fmt::format("{} hard cases, {} failed, {:.2f} s\n", outcomes.size(), failed,
                                   seconds_of(outcomes));
    }
    return failed == 0 ? exit_ok : exit_no_answer;
}

/// Runs what others published. @returns exit_ok when 97 % lie within the accuracy of their sources, else exit_no_answer.
int verify_external(const VerifyArguments& arguments, const Streams& streams)
{
    const std::vector<external::Source> sources = external::all_sources();
    const std::filesystem::path folder = arguments.filter;
    if (!folder.empty()) // named: what it is named for has to be there
        for (const external::Source& source : sources)
            if (!source.folder.empty() && !std::filesystem::exists(folder / source.folder))
                throw InputError(
                    Diagnostic{(folder / source.folder).string(), 0, 0, "there is no such file.",
                               "the results of " + source.id + " in the folder that is named",
                               "correct the name, or leave the folder out: the sources in the program are run"});
    std::vector<SourceOutcome> outcomes;
    std::size_t numbers = 0, within = 0, unexplained = 0;
    bool whole = true; ///< every source was run
    double seconds = 0.0;
    for (const external::Source& source : sources) {
        outcomes.push_back({&source, {}, 0.0});
        if (!source.folder.empty() && folder.empty()) {
            if (!streams.quiet)
                streams.talk << fmt::format("{}: not run; name the folder that holds {}\n", source.id, source.folder);
            whole = false;
            continue;
        }
        const Stopwatch start;
        outcomes.back().results = source.run(folder);
        outcomes.back().seconds = start.seconds();
        seconds += outcomes.back().seconds;
        for (const external::Result& r : outcomes.back().results) {
            ++numbers;
            within += r.within();
            unexplained += !r.within() && r.reason.empty();
        }
    }
    const std::string figure = evidence_figure(outcomes);
    if (!arguments.svg.empty() && !figure.empty()) write_file(arguments.svg, figure);
    if (arguments.markdown) {
        streams.out << evidence_markdown(outcomes,
                                         arguments.svg.empty() ? "" : "figures/" + arguments.svg.filename().string());
    } else if (streams.form == Form::json) {
        auto j = json_header("verify-external");
        j["numbers"] = numbers;
        j["within"] = within;
        j["without_reason"] = unexplained;
        j["seconds"] = seconds;
        j["groups"] = json_of(evidence_table(outcomes));
        j["outside"] = json_of(missed_table(outcomes));
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << text(evidence_table(outcomes));
        if (const Table outside = missed_table(outcomes); !outside.rows.empty()) streams.out << "\n" << text(outside);
        streams.out << fmt::format(
            "\n{} numbers of others, {} within their accuracy ({:.2f} %), {} outside without a reason, {:.1f} s\n",
            numbers, within, numbers ? 100.0 * static_cast<double>(within) / static_cast<double>(numbers) : 0.0,
            unexplained, seconds);
    }
    // Of all sources: coupled slips whose own steps do not settle lie outside. Of the few in the program alone a share says little.
    constexpr double least_share = 0.97;
    const bool enough = !whole || static_cast<double>(within) >= least_share * static_cast<double>(numbers);
    return enough && unexplained == 0 ? exit_ok : exit_no_answer;
}

/// Where ERRATA.md lies: beside the documents of an installed program, or in the sources' folder that it was built from or is called in.
std::string errata()
{
    for (const std::filesystem::path& file : {own_folder() / "../share/doc/damslip/ERRATA.md", own_folder() / "../../ERRATA.md",
                                              std::filesystem::path("ERRATA.md")})
        if (std::filesystem::exists(file)) return read_file(file);
    return "ERRATA.md is not at hand.";
}

/// All of it as one document. @returns exit_ok when every case passes and the record is that of the release, else exit_no_answer
int write_manual(const VerifyArguments& arguments, const Streams& streams)
{
    const verification::Registry cases = verification::all_cases();
    const hard::HardCases hard_cases = hard::all_hard_cases();
    const auto outcomes = outcomes_of<CaseOutcome>(cases, "", "verify", streams);
    const auto hard = outcomes_of<HardOutcome>(hard_cases, "", "verify --hard", streams);
    const std::vector<external::Source> sources = external::all_sources();
    std::vector<SourceOutcome> external;
    for (const external::Source& source : sources) {
        external.push_back({&source, {}, 0.0});
        if (source.folder.empty() || !arguments.filter.empty()) external.back().results = source.run(arguments.filter);
    }
    const Page page = manual_page(outcomes, hard, external, errata());
    if (arguments.manual.extension() == ".pdf")
        print_pdf(page_html(page), arguments.manual);
    else
        write_file(arguments.manual, page_html(page));
    streams.out << page.headline.sentence << "\nverification record " << record_digest(outcomes) << "\n";
    name_report(arguments.manual, streams);
    return page.headline.outcome == Outcome::pass ? exit_ok : exit_no_answer;
}

/// The digest of the record alone.
int print_digest(const Streams& streams)
{
    const verification::Registry cases = verification::all_cases();
    const std::string digest = record_digest(outcomes_of<CaseOutcome>(cases, "", "verify", streams));
    streams.out << digest << "\n";
    return digest == program_verification() ? exit_ok : exit_no_answer;
}

/// One id a line.
template <class Cases>
int print_ids(const Cases& cases, const Streams& streams)
{
    for (const auto& c : cases) streams.out << c.id << "\n";
    return exit_ok;
}

} // namespace

int verify(const VerifyArguments& arguments, const Streams& streams)
{
    if (!arguments.manual.empty()) return write_manual(arguments, streams);
    if (arguments.digest) return print_digest(streams);
    if (arguments.external) return verify_external(arguments, streams);
    if (arguments.list)
        return arguments.hard ? print_ids(hard::all_hard_cases(), streams) : print_ids(verification::all_cases(), streams);
    return arguments.hard && !arguments.markdown ? verify_hard(arguments, streams) : verify_closed(arguments, streams);
}

} // namespace damslip::cli
