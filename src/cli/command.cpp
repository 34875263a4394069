#include "cli/command.hpp"

#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "pages/report/answer.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <ostream>
#include <sstream>

namespace damslip::cli {

namespace {

const char* const exit_codes = "Exit codes: 0 ok, 1 internal error, 2 command line, 3 a file that cannot be read or "
                               "written, 4 no answer: not converged, interrupted, too little memory, or a check failed "
                               "(results so far are kept).";

struct Parser {
    CLI::App app{"How far does this concrete gravity dam slide in this earthquake, and how sure are we?", "damslip"};
    bool json = false, full = false, brief = false, quiet = false, cache = true;
    std::map<const CLI::App*, Run> runs; ///< of the commands that run something
};

/// NaN and infinity are no numbers of any flag; CLI11 reads them.
void refuse_no_numbers(CLI::App& sub)
{
    const auto finite = [](const std::string& text) -> std::string {
        return parse_number(text) ? "" : text + " is not allowed: a finite number";
    };
    for (CLI::Option* option : sub.get_options([](const CLI::Option*) { return true; }))
        if (option->get_type_name().starts_with("FLOAT")) option->check(finite);
}

/// Which commands have their flags declared: with hundreds of flags that takes longer than a short command itself.
using Wanted = std::function<bool(const Command&)>;

void add(const Command& command, CLI::App& parent, Parser& p, const Wanted& wanted)
{
    CLI::App& sub = *parent.add_subcommand(command.name, command.description);
    sub.footer("Example:\n  " + command.example);
    if (!command.below.empty()) {
        sub.require_subcommand(1);
        for (const Command& below : command.below) add(below, sub, p, wanted);
        return;
    }
    if (!wanted(command)) return;
    CLI::Option* json = sub.add_flag("--json", p.json, "one JSON object on standard output, for machines");
    CLI::Option* full =
        sub.add_flag("--full", p.full, "all tables in place of the answer in brief")->excludes(json);
    sub.add_flag("--brief", p.brief, "the answer in brief, in at most 25 lines of 110 columns (default)")->excludes(json, full);
    sub.add_flag("-q,--quiet", p.quiet, "no progress, no talk; of the answer in brief its line alone");
    sub.add_flag("!--no-cache", p.cache,
                 "make reduced rock anew: do not use the cache folder ($XDG_CACHE_HOME/damslip or ~/.cache/damslip)");
    p.runs[&sub] = command.declare(sub);
    refuse_no_numbers(sub);
}

void build(Parser& p, std::span<const Command> rows, const Wanted& wanted)
{
    p.app.set_version_flag("--version", "damslip " + program_version());
    p.app.require_subcommand(1);
    p.app.footer(std::string("Examples:\n  damslip screen examples/reference_dam.toml\n  damslip sweep "
                             "examples/reference_dam.toml --friction 0.65:1.0:0.05\n") +
                 exit_codes);
    for (const Command& command : rows) add(command, p.app, p, wanted);
}

/// The command that was typed.
const Run& chosen(const Parser& p)
{
    const CLI::App* at = &p.app;
    while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
    return p.runs.at(at);
}

std::vector<std::string> command_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(sub->get_name());
    return names;
}

std::vector<std::string> flag_names(const CLI::App& app)
{
    std::vector<std::string> flags;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    return flags;
}

[[noreturn]] void unknown(const std::string& what, const std::string& word, const std::string& where,
                          const std::vector<std::string>& known, const std::string& help)
{
    const std::string_view near = nearest(word, known);
    refuse_usage(fmt::format("unknown {} {}{}.{}", what, word, where,
                             near.empty() ? "" : fmt::format(" Did you mean {}?", near)),
                 fmt::format("{}", fmt::join(known, ", ")), "run  " + help);
}

/// Misspelt commands and flags, which CLI11 would report without a suggestion.
void check_spelling(const CLI::App& top, const std::vector<std::string>& arguments)
{
    const CLI::App* app = &top;
    std::string path = "damslip";
    for (const std::string& word : arguments) {
        if (word == "--") return;
        if (word.size() > 2 && word.starts_with("--")) {
            const std::string flag = word.substr(0, word.find('='));
            const std::vector<std::string> known = flag_names(*app);
            if (path == "damslip fragility" && (flag == "--multi-fidelity" || flag == "--cheap-samples"))
                refuse_usage(flag + " is no longer there: cheaper models beside the finite elements gained nothing.",
                             "finite elements alone, with friction conditioned on where it is drawn",
                             "leave it out; fewer runs for the same interval:  --conditioning on");
            if (std::find(known.begin(), known.end(), flag) == known.end())
                unknown("flag", flag, " of " + path, known, path + " --help");
        } else if (const std::vector<std::string> names = command_names(*app);
                   !names.empty() && !word.starts_with("-")) {
            if (std::find(names.begin(), names.end(), word) == names.end())
                unknown("command", word, app == &top ? "" : " of " + path, names, path + " --help");
            app = app->get_subcommand(word);
            path += " " + word;
        }
    }
}

/// What CLI11 refused, with what is expected in its place: the flag that its message names, or the arguments of the command.
UsageError usage_error(const CLI::App& top, const std::vector<std::string>& arguments, const std::string& message)
{
    const CLI::App* app = &top;
    std::string path = "damslip";
    for (const std::string& word : arguments) {
        const std::vector<std::string> names = command_names(*app);
        if (std::find(names.begin(), names.end(), word) == names.end()) continue;
        app = app->get_subcommand(word);
        path += " " + word;
    }
    const auto described = [](const CLI::Option& option) {
        return fmt::format("{} {}: {}", option.get_name(), option.get_type_name(), option.get_description());
    };
    std::string expected, positionals;
    std::size_t first = std::string::npos; // where the message names it
    for (const CLI::Option* option : app->get_options()) {
        const std::string name = option->get_single_name();
        if (option->get_positional()) positionals += fmt::format(" {}", name);
        const std::string word = option->get_positional() ? name : "--" + name;
        const std::size_t at = message.find(word), end = at + word.size();
        if (at >= first ||
            (end < message.size() && std::string_view(" :=,").find(message[end]) == std::string_view::npos))
            continue;
        first = at;
        expected = described(*option);
    }
    const std::vector<std::string> below = command_names(*app);
    if (expected.empty())
        expected = below.empty() ? path + positionals + " [OPTIONS]" : fmt::format("one of {}", fmt::join(below, ", "));
    return UsageError(Diagnostic{"", 0, 0, message + (message.ends_with('.') ? "" : "."), expected,
                                 fmt::format("run  {} --help", path)});
}

/// "TEXT:{contact,tied}", "INT:INT in [1 - 1000]": kind, choices, range.
void read_type(const std::string& type, OptionSummary& option)
{
    const std::size_t colon = type.find(':');
    option.value = type.substr(0, colon);
    if (colon == std::string::npos) return;
    const std::string rule = type.substr(colon + 1);
    const std::size_t open = rule.find_first_of("{["), close = rule.find_last_of("}]");
    if (open == std::string::npos || close == std::string::npos || close < open) return;
    const std::string inside = rule.substr(open + 1, close - open - 1);
    if (rule[open] == '[') {
        option.range = inside;
        return;
    }
    std::istringstream words(inside);
    for (std::string word; std::getline(words, word, ',');) option.choices.push_back(word);
}

OptionSummary summary_of(const CLI::Option& option)
{
    OptionSummary s;
    s.positional = option.get_positional();
    s.name = s.positional ? option.get_name(true) : "";
    if (!s.positional && !option.get_lnames().empty()) s.name = "--" + option.get_lnames().front();
    if (!option.get_snames().empty()) s.short_name = "-" + option.get_snames().front();
    if (option.get_items_expected_max() > 0) read_type(option.get_type_name(), s);
    s.default_value = option.get_default_str();
    s.text = option.get_description();
    s.group = option.get_group();
    s.required = option.get_required();
    s.repeated = option.get_items_expected_max() > 1;
    return s;
}

void add_summaries(const CLI::App& app, const std::string& name, std::vector<CommandSummary>& out)
{
    CommandSummary summary{name, app.get_description(), {}, app.get_footer(), false};
    for (const CLI::Option* option : app.get_options()) summary.options.push_back(summary_of(*option));
    std::stable_partition(summary.options.begin(), summary.options.end(),
                          [](const OptionSummary& o) { return o.positional; });
    const auto below = app.get_subcommands([](const CLI::App*) { return true; });
    summary.has_subcommands = !below.empty();
    out.push_back(std::move(summary));
    for (const CLI::App* sub : below) add_summaries(*sub, (name.empty() ? "" : name + " ") + sub->get_name(), out);
}

} // namespace

Invocation parse_arguments(const std::vector<std::string>& arguments, std::span<const Command> rows)
{
    Parser parser;
    build(parser, rows, [&](const Command& command) { // what is not named cannot be the one that is typed
        return std::find(arguments.begin(), arguments.end(), command.name) != arguments.end();
    });
    if (arguments.empty()) throw HelpText{parser.app.help()};
    check_spelling(parser.app, arguments);
    try {
        parser.app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::CallForHelp&) {
        throw HelpText{parser.app.help()}; // of the command that was named, with the way to it: "damslip record info"
    } catch (const CLI::CallForVersion& version) {
        throw HelpText{std::string(version.what()) + "\n"};
    } catch (const CLI::ParseError& error) {
        throw usage_error(parser.app, arguments, error.what());
    }
    const Form form = parser.json ? Form::json : parser.full ? Form::full : Form::text;
    return {chosen(parser), form, parser.quiet, parser.cache, parser.brief};
}

std::vector<CommandSummary> command_summaries()
{
    Parser parser;
    build(parser, commands(), [](const Command&) { return true; });
    std::vector<CommandSummary> summaries;
    add_summaries(parser.app, "", summaries);
    return summaries;
}

bool put_json_document(const Streams& streams, const std::string& what,
                       std::initializer_list<std::pair<const char*, std::string>> members)
{
    if (streams.form != Form::json) return false;
    auto j = pages::json_header(what);
    for (const auto& [name, text] : members) j[name] = text;
    streams.out << j.dump(2) << "\n";
    return true;
}

void put_answer(pages::Answer answer, const std::string& files, const Streams& streams, std::ostream* to)
{
    std::ostream& out = to ? *to : streams.out;
    if (streams.form == Form::json) {
        out << answer.json().dump(2) << "\n";
    } else if (streams.form == Form::full) {
        out << answer.full();
    } else if (streams.quiet) {
        out << answer.line();
    } else {
        for (const std::string& line : streams.held ? *streams.held : std::vector<std::string>{}) {
            std::string_view text = line;
            for (const std::string_view kind : {"note: ", "warning: "}) // an answer's notes are notes
                if (text.starts_with(kind)) text.remove_prefix(kind.size());
            answer.note_in_brief(std::string(text));
        }
        if (streams.held) streams.held->clear();
        out << answer.brief(files);
    }
}

void add_scene(CLI::App& sub, RunInputs& in)
{
    sub.add_option("SCENE", in.scene, "scene file (TOML); -: standard input")->required();
    sub.add_flag("--strict", in.strict, "values outside the range of real dams are errors, not notes");
}

void add_run_inputs(CLI::App& sub, RunInputs& in)
{
    add_scene(sub, in);
    sub.option_defaults()->group("Ground motion");
    sub.add_option("--record", in.records, "horizontal accelerogram(s) instead of the scene's");
    sub.add_option("--vertical", in.verticals,
                   "vertical accelerogram(s), one for each --record, in the same order; none for a record without one");
    sub.add_option("--records", in.record_list,
                   "folder, pattern in quotes ('suite/*.AT2') or list (CSV) of accelerograms instead of the scene's; "
                   "components "
                   "are paired by their names");
    sub.add_option("--units", in.unit, "unit of record files that do not say: g, m/s2, cm/s2, gal, mg");
    sub.add_option("--dt", in.dt, "time step of one-column record files [s]");
    sub.add_option("--column", in.column, "heading or number of the horizontal column where files hold several");
    sub.add_option("--vertical-column", in.vertical_column, "the same of the vertical files");
    sub.option_defaults()->group("Options");
}

void add_scale(CLI::App& sub, RunInputs& in)
{
    sub.add_option("--scale", in.scale, "factor on all records")->group("Ground motion");
}

void add_friction(CLI::App& sub, RunInputs& in)
{
    sub.add_option("--friction", in.friction, "Coulomb mu instead of the scene's");
}

void add_rock(CLI::App& sub, RunInputs& in)
{
    sub.add_option("--rock", in.rock, "radiating (with mass, waves leave) or massless, in place of the scene's rock")
        ->check(CLI::IsMember({"radiating", "massless"}));
}

void add_plane(CLI::App& sub, RunInputs& in)
{
    sub.add_option("--plane", in.plane, "what the dam slides on: base (default), or the name of a [[seam]], whose rock then moves along");
}

void add_response_spectrum(CLI::App& sub, SpectrumArguments& a)
{
    const char* const group = "Response spectrum";
    sub.option_defaults()->group(group);
    CLI::Option* on = sub.add_flag("--response-spectrum", a.wanted,
                                   "peaks of the dam on a bonded base by its modes: forces, stresses, factors");
    CLI::Option* file = sub.add_option("--spectrum", a.horizontal,
                                       "its spectrum at 5 % damping, period [s] and S_a over any unit, in place of the "
                                       "records'")
                            ->needs(on);
    CLI::Option* pga = sub.add_option("--spectrum-pga", a.pga, "S_a at period 0 of that spectrum [m/s^2]")
                           ->check(in_range(1e-3, 100.0))
                           ->needs(file);
    file->needs(pga);
    CLI::Option* vertical = sub.add_option("--spectrum-vertical", a.vertical,
                                           "the same of the vertical component; without it that spectrum has none")
                                ->needs(file);
    CLI::Option* vertical_pga =
        sub.add_option("--spectrum-vertical-pga", a.vertical_pga, "S_a at period 0 of the vertical spectrum [m/s^2]")
            ->check(in_range(1e-3, 100.0))
            ->needs(vertical);
    sub.option_defaults()->group("Options");
    vertical->needs(vertical_pga);
}

CLI::Validator in_range(double low, double high)
{
    const auto check = [low, high](const std::string& text) -> std::string {
        std::size_t used = 0;
        const std::optional<double> value = parse_number(text, &used);
        if (value && used == text.size() && *value >= low && *value <= high) return {};
        return fmt::format("{} is not allowed: a number from {:g} to {:g}", text, low, high);
    };
    return {check, fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

CLI::Option* add_jobs(CLI::App& sub, int& jobs, const std::string& text)
{
    return sub.add_option("-j,--jobs", jobs, text)->check(CLI::Range(0, 1024))->each([](const std::string& value) {
        use_threads(std::stoi(value));
    });
}

CLI::Option* add_out(CLI::App& sub, std::filesystem::path& target, OutputPath kind, const std::string& text,
                     const std::string& names)
{
    return sub.add_option(names, target, text)->check(output_to(kind, "--out"));
}

void add_pdf(CLI::App& sub, std::filesystem::path& target)
{
    sub.add_option("--pdf", target, "the report printed on A4 (.pdf); needs Chromium")
        ->check([](const std::string& path) -> std::string {
            check_pdf(path);
            return {};
        });
}

void add_sheet(CLI::App& sub, std::filesystem::path& target, const std::string& help)
{
    sub.add_option("--sheet", target, help)->check([](const std::string& path) -> std::string {
        check_sheet(path);
        return {};
    });
}

void check_output(const std::filesystem::path& path, OutputPath kind, const std::string& flag)
{
    if (auto problem = output_path_problem(path, kind, flag)) throw UsageError(std::move(*problem));
    keep_from_inputs(path, kind, flag);
}

std::function<std::string(const std::string&)> output_to(OutputPath kind, const std::string& flag)
{
    return [kind, flag](const std::string& path) -> std::string {
        check_output(path, kind, flag);
        return {};
    };
}

} // namespace damslip::cli
