#include "random/check_promise.hpp"

#include "cli/command.hpp"
#include "cli/program.hpp"
#include "core/file.hpp"
#include "core/status.hpp"
#include "scene/keys.hpp"
#include "scene/read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>

namespace damslip::random {

namespace {

using nlohmann::json;

struct Parsed {
    int code = 0;
    json data;
};

Parsed parsed(const std::vector<std::string>& arguments)
{
    std::ostringstream out, talk;
    const int code = cli::run_program(arguments, out, talk, false);
    return {code, json::parse(out.str(), nullptr, false)};
}

std::optional<double> number(const json& row, const char* key)
{
    if (!row.contains(key) || !row[key].is_number()) return std::nullopt;
    return row[key].get<double>();
}

/// Empty where the key is missing or null.
std::string text(const json& row, const char* key)
{
    return row.contains(key) && row[key].is_string() ? row[key].get<std::string>() : "";
}

/// Findings of one command.
class Findings {
public:
    Findings(std::string command, CheckedRuns& runs) : command_(std::move(command)), runs_(runs) {}

    void demand(bool holds, const std::string& sentence)
    {
        if (!holds) runs_.findings.push_back(command_ + ": " + sentence);
    }

private:
    std::string command_;
    CheckedRuns& runs_;
};

/// The status of a row, and that no number stands beside it that it does not allow.
std::optional<Status> check_status(const json& row, std::initializer_list<const char*> slips, Findings& findings)
{
    const std::string word = text(row, "status");
    const std::optional<Status> status = status_of_word(word);
    findings.demand(status.has_value(), fmt::format("unknown status \"{}\"", word));
    if (!status) return status;
    if (status_row(*status).slip == SlipMeaning::none)
        for (const char* key : slips) findings.demand(!number(row, key), fmt::format("{} beside \"{}\"", key, word));
    const std::string verdict = text(row, "verdict");
    if (status_row(*status).judging == Judging::none)
        findings.demand(verdict != "PASS" && verdict != "FAIL", fmt::format("{} beside \"{}\"", verdict, word));
    return status;
}

/// Does the run fail otherwise than by the slip of its base: after the earthquake, or in a lift joint?
bool fails_otherwise(const json& fe, const json& row)
{
    if (fe.contains("lift_joints")) return true;
    return std::any_of(fe["stages"].begin(), fe["stages"].end(), [&](const json& stage) {
        return stage["record"] == row["record"] && stage["polarity"] == row["polarity"] && stage["status"] != "stands";
    });
}

/// PASS and FAIL against slip and error. @param slip_mm, error_mm  none: not known
void check_verdict(const json& row, Status status, const std::optional<double>& slip_mm,
                   const std::optional<double>& error_mm, double allowable_mm, Findings& findings)
{
    const std::string verdict = text(row, "verdict");
    if (status_row(status).judging != Judging::by_slip || (verdict != "PASS" && verdict != "FAIL")) return;
    findings.demand(slip_mm && error_mm, verdict + " without a slip and its error");
    if (!slip_mm || !error_mm) return;
    const double slip = std::abs(*slip_mm), rounding = 1e-9 * slip;
    findings.demand(verdict == "PASS" ? slip + *error_mm <= allowable_mm + rounding
                                      : slip - *error_mm > allowable_mm - rounding,
                    fmt::format("{}: {} ± {} mm, allowable {} mm", verdict, slip, *error_mm, allowable_mm));
}

void check_fe(const Parsed& fe, const Scene& scene, CheckedRuns& runs)
{
    Findings findings("fe", runs);
    findings.demand(fe.code == 0 || fe.code == 3 || fe.code == 4, fmt::format("exit code {}", fe.code));
    if (fe.code == 3 || !fe.data.contains("runs")) return;
    findings.demand(!fe.data["runs"].empty() || fe.code != 0, "exit code 0 without a run");
    const bool unresolved_stage =
        std::any_of(fe.data["stages"].begin(), fe.data["stages"].end(),
                    [](const json& stage) { return stage["record"] == "all" && stage["status"] == "NOT RESOLVED"; });
    bool all_answered = true;
    for (const json& row : fe.data["runs"]) {
        const std::optional<Status> status = check_status(row, {"slip_mm", "max_slip_m"}, findings);
        if (!status) continue;
        runs.status = text(row, "status");
        all_answered = all_answered && is_answer(*status);
        const std::optional<double> slip = number(row, "slip_mm"), step_error = number(row, "slip_error_mm");
        findings.demand(!slip || !unresolved_stage, "a slip after a stage that was not resolved");
        findings.demand(!slip || number(row, "unresolved").value_or(0) == 0, "a slip with unresolved steps");
        if (fe.code == 0 && slip && step_error && !scene.time.substeps) {
            const double largest = 1e3 * number(row, "max_slip_m").value_or(0.0);
            const double allowed = scene.time.slip_tolerance * std::max(largest, 1e-3); // RunOptions::smallest_slip
            findings.demand(*step_error <= allowed * (1 + 1e-9),
                            fmt::format("{} ± {} mm at most although slip_tolerance is {}", largest, *step_error,
                                        scene.time.slip_tolerance));
        }
        const std::optional<double> largest = number(row, "max_slip_m"), total = number(row, "total_error_mm");
        if (scene.criteria.allowable_slip && !(text(row, "verdict") == "FAIL" && fails_otherwise(fe.data, row)))
            check_verdict(row, *status, largest ? std::optional(1e3 * *largest) : std::nullopt, total,
                          1e3 * *scene.criteria.allowable_slip, findings);
    }
    const bool open_after = std::any_of(fe.data["stages"].begin(), fe.data["stages"].end(), [](const json& stage) {
        return stage["record"] != "all" && stage["status"] == "NOT RESOLVED";
    });
    findings.demand(fe.code == (all_answered && !open_after ? 0 : 4),
                    fmt::format("exit code {} with status {}", fe.code, runs.status));
}

void check_screen(const Parsed& screen, CheckedRuns& runs)
{
    Findings findings("screen", runs);
    findings.demand(screen.code == 0 || screen.code == 3 || screen.code == 4, fmt::format("exit code {}", screen.code));
    if (screen.code == 3 || !screen.data.contains("displacements")) return;
    bool all_answered = true;
    for (const json& row : screen.data["displacements"]) {
        const std::optional<Status> status =
            check_status(row, {"slip_hv_mm", "max_slip_m", "upstream_slip_mm"}, findings); // slip_h has its own
        const bool rocks = status == Status::rocks_first && screen.data.contains("rocking_block");
        if (status) all_answered = all_answered && (is_answer(*status) || rocks);
    }
    if (screen.data.contains("rocking_block"))
        for (const json& row : screen.data["rocking_block"])
            if (const auto status = check_status(row, {}, findings)) all_answered = all_answered && is_answer(*status);
    findings.demand(all_answered || screen.code == 4, "exit code 0 although an answer is missing");
}

/// Objects anywhere below that have a status: a slip beside it is one that it allows.
void check_statuses(const json& node, Findings& findings)
{
    if (node.is_object()) {
        const std::optional<Status> status = status_of_word(text(node, "status"));
        if (status && status_row(*status).slip == SlipMeaning::none)
            for (const char* key : {"slip_m", "slip_mm", "max_slip_m", "max_slip_mm", "largest_slip_mm"})
                findings.demand(!number(node, key), fmt::format("{} beside \"{}\"", key, text(node, "status")));
    }
    if (node.is_structured())
        for (const json& below : node) check_statuses(below, findings);
}

/// Numbers that are none, as words of a text.
bool has_no_number(const std::string& words)
{
    static const std::regex none("(^|[^[:alnum:]_])-?(inf|nan)([^[:alnum:]_]|$)");
    return std::regex_search(words, none);
}

/// What holds of every command on every scene.
void check_command(std::vector<std::string> arguments, bool as_json, CheckedRuns& runs)
{
    const std::string folder = std::filesystem::path(arguments[1]).parent_path().string(); // of scene and records
    if (as_json) arguments.push_back("--json");
    std::ostringstream out, talk;
    const int code = cli::run_program(arguments, out, talk, false);
    arguments.erase(arguments.begin() + 1); // the scene
    Findings findings(fmt::format("{}", fmt::join(arguments, " ")), runs);
    ++runs.commands[arguments[0]];
    findings.demand(code == 0 || (code >= 2 && code <= 4), fmt::format("exit code {}: {}", code, talk.str()));
    for (const std::string& words : {out.str(), talk.str()})
        if (has_no_number(words)) {
            std::istringstream lines(words);
            for (std::string line; std::getline(lines, line);)
                findings.demand(!has_no_number(line), "no number: " + line.substr(0, 300));
        }
    for (const std::string& part : {std::string("fix:"), std::string("expected:"), folder})
        findings.demand((code != 2 && code != 3) || (code == 2 && part == folder) ||
                            talk.str().find(part) != std::string::npos,
                        "an error without \"" + part + "\": " + talk.str());
    if (!as_json) return;
    const json answer = json::parse(out.str(), nullptr, false);
    findings.demand(answer.is_object(), "--json prints no object: " + out.str().substr(0, 200));
    check_statuses(answer, findings);
}

/// A number of the scene: its line, its key in the table of keys, its value.
struct NumberLine {
    std::size_t line;
    std::string table, key;
    double value;
};

/// Numbers by which the rigid block goes whatever else the scene says.
std::vector<NumberLine> honoured_numbers(const std::vector<std::string>& lines)
{
    static const std::set<std::string> whole{"site", "section", "dam", "reservoir", "tailwater"};
    SectionInput section;
    std::vector<NumberLine> numbers;
    std::string table;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        static const std::regex head(R"(\[+([^\]]+)\]+.*)"), entry(R"((\w+) = ([-+.\deE]+)( *#.*)?)");
        std::smatch found;
        if (std::regex_match(lines[i], found, head)) table = found[1];
        if (!std::regex_match(lines[i], found, entry)) continue;
        for (const KeyGroup& group : key_groups(section))
            for (const Key& key : group.keys) {
                const std::vector<std::string> spellings = key.spellings();
                if (group.name == table && std::find(spellings.begin(), spellings.end(), found[1]) != spellings.end() &&
                    (honoured_by(table, key.name) & methods::rigid) &&
                    (whole.contains(table) || key.name == "friction"))
                    numbers.push_back({i, table, found[1], std::strtod(found[2].str().c_str(), nullptr)});
            }
    }
    return numbers;
}

/// What `screen` computes, without what names the scene.
json computed(json answer)
{
    for (const char* key : {"scene", "effects", "warnings", "headline"}) answer.erase(key);
    return answer;
}

/// A number that the table of keys calls honoured changes the answer: one of the scene, a twentieth larger.
void check_honoured(const std::filesystem::path& scene, const Parsed& screen, std::uint32_t turn, CheckedRuns& runs)
{
    std::vector<std::string> lines;
    std::istringstream text(read_file(scene));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    const std::vector<NumberLine> numbers = honoured_numbers(lines);
    if (numbers.empty() || (screen.code != 0 && screen.code != 4)) return;
    const NumberLine& number = numbers[turn % numbers.size()];
    if (number.value == 0.0) return;
    lines[number.line] = fmt::format("{} = {}", number.key, 1.05 * number.value);
    const std::filesystem::path other = scene.parent_path() / "other.toml";
    write_file(other, fmt::format("{}\n", fmt::join(lines, "\n")));
    const Parsed changed = parsed({"screen", other.string(), "--json"});
    if (changed.code != 0 && changed.code != 4) return;
    ++runs.commands["a key a twentieth larger"];
    Findings("screen", runs)
        .demand(computed(changed.data) != computed(screen.data),
                fmt::format("the same answer for {}.{} = {} and {}", number.table, number.key, number.value,
                            1.05 * number.value));
}

/// The same scene with a friction that is not known and a hazard, for `fragility`.
std::string with_probability(const std::filesystem::path& scene, bool few_runs = false)
{
    const std::filesystem::path file = scene.parent_path() / "fragility.toml";
    write_file(scene.parent_path() / "hazard.csv", "pga_g,annual_rate\n0.05,0.02\n0.2,0.002\n0.8,0.0001\n");
    write_file(file, read_file(scene) + (few_runs ? "[probability]\nreplicates = 1\n" : "") +
                         "[[probability.variable]]\nname = \"mu\"\nkey = \"contact.friction\"\n"
                         "lognormal = { median = 0.8, beta = 0.2 }\n[intensity]\nmeasure = \"PGA\"\n"
                         "levels_g = [0.1, 0.3, 0.6]\n[suite]\nmax_scale = 1000\n[[limit]]\nquantity = \"slip\"\n"
                         "above_mm = 20\n[hazard]\ncurve = \"hazard.csv\"\n");
    return file.string();
}

void check_worker(const std::string& scene, CheckedRuns& runs)
{
    std::ostringstream out, talk;
    const cli::Streams streams{out, talk, cli::Form::text, true};
    std::istringstream in("{\"id\": 1, \"set\": {\"contact.friction\": 0.6}}\n{\"id\": 2, \"method\": \"fe-reduced\"}\n"
                          "{\"id\": 3, \"set\": {\"contact.friction\": -1}}\nno JSON\n");
    Findings findings("worker", runs);
    try {
        cli::worker({scene, {}, {}, {}, {}}, streams, in);
    } catch (const InputError&) {
        return; // the scene itself is refused
    }
    std::istringstream lines(out.str());
    std::vector<json> answers;
    for (std::string line; std::getline(lines, line);) answers.push_back(json::parse(line, nullptr, false));
    findings.demand(answers.size() == 5, "not an answer for each line");
    for (const json& answer : answers) {
        findings.demand(answer.is_object(), "an answer that is no object");
        check_statuses(answer, findings);
    }
}

/// The commands beside `screen` and `fe`.
void check_commands(const std::filesystem::path& file, std::uint32_t turn, CheckedRuns& runs)
{
    const std::string scene = file.string();
    const bool as_json = turn % 2 == 0;
    const auto run = [&](const std::string& command, const std::vector<std::string>& flags = {}) {
        std::vector<std::string> words{command, scene};
        words.insert(words.end(), flags.begin(), flags.end());
        check_command(words, as_json, runs);
    };
    check_command({"screen", scene}, false, runs);
    run("draw");
    run("mesh");
    run("explain", {"--method", turn % 4 < 2 ? "fe" : "rigid"});
    run("sweep",
        {"--method", "rigid,rigid-v,coupled,jibson-2007-ratio", "--friction", "0.5,0.9", "--polarity", "1,-1"});
    switch (turn / 2 % 16) {
    case 0:
        return run("fe");
    case 1:
        return run("fe", {"--reduced", "--no-mesh-error", "--jobs", "1"});
    case 2:
        return run("fe", {"--base", "tied"});
    case 3:
        return run("modes", {"--count", "4"});
    case 4:
        return run("explain", {"--ablate"});
    case 5:
        return run("sweep", {"--method", "fe,fe-reduced", "--friction", "0.7,1"});
    case 6:
        return run("accuracy", {"--quick", "--budget", "0.5"});
    case 7:
        return run("assess", {"--budget", "0.5"});
    case 8:
        return check_command({"fragility", with_probability(file), "--samples", "8", "--share-rows", "0"}, as_json,
                             runs);
    case 9:
        return check_command(
            {"fragility", with_probability(file, true), "--method", "fe", "--samples", "2", "--share-rows", "0"},
            as_json, runs);
    case 10:
        return run("accuracy", {"--rung", "rigid:h+v"});
    case 11:
        return run("accuracy", {"--rung", "fe-added-mass:scene"});
    case 12:
        return run("explain", {"--ablate", "--method", "fe"});
    case 13:
        return run("fe", {"--spread", "--polarity", "-1"});
    case 14:
        return run("screen", {"--response-spectrum", "--mean-polarity", "--rocking"});
    default:
        ++runs.commands["worker"];
        return check_worker(scene, runs);
    }
}

} // namespace

CheckedRuns check_promise(const std::filesystem::path& scene, std::uint32_t turn)
{
    CheckedRuns runs;
    const Parsed screen = parsed({"screen", scene.string(), "--json"});
    const Parsed fe = parsed({"fe", scene.string(), "--json"});
    ++runs.commands["screen"];
    ++runs.commands["fe"];
    runs.screen_code = screen.code;
    check_honoured(scene, screen, turn, runs);
    runs.fe_code = fe.code;
    check_screen(screen, runs);
    if (fe.code == 3)
        runs.refusal = fe.data["error"]["diagnostics"][0]["message"];
    else if (fe.code != 1 && fe.code != 2)
        check_fe(fe, read_scene(scene), runs);
    check_commands(scene, turn, runs);
    return runs;
}

} // namespace damslip::random
