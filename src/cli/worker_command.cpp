#include "cli/command.hpp"

#include "analysis/sweep/sweep_run.hpp"
#include "cli/command.hpp"
#include "cli/input/run_inputs.hpp"
#include "cli/terminal/terminal.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "core/input_error.hpp"
#include "core/version.hpp"
#include "scene/scene_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

namespace damslip::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest_line = 16u << 20; ///< bytes

struct Question {
    Json id;
    std::vector<KeyChange> changes;
    std::string method, record; ///< empty: as the command line or the scene says
};

Json in_millimetres(const std::optional<double>& metres)
{
    return metres ? Json(*metres * 1e3) : Json();
}

Json json_of_point(const PointAnswer& answer)
{
    const RowResults& r = answer.row.results;
    Json j;
    j["slip_mm"] = in_millimetres(r.slip);
    j["error_mm"] = in_millimetres(r.slip_error);
    j["max_slip_mm"] = in_millimetres(r.max_slip);
    j["upstream_slip_mm"] = in_millimetres(r.upstream_slip);
    j["lift_slip_mm"] = in_millimetres(r.lift_slip);
    j["critical_friction"] = r.critical_friction ? Json(*r.critical_friction) : Json();
    j["status"] = r.status.empty() ? "ok" : r.status; // a regression within its range says nothing
    j["record"] = answer.record;
    j["polarity"] = answer.polarity;
    j["method"] = answer.method;
    j["seconds"] = answer.seconds;
    return j;
}

/// A line of JSON, in one piece whatever the texts hold.
std::string line_of(const Json& j)
{
    return j.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
}

Json error_of(const InputError& error)
{
    Json list = Json::array();
    for (const Diagnostic& d : error.diagnostics())
        list.push_back({{"message", d.problem}, {"expected", d.expected}, {"fix", d.fix}});
    return list;
}

[[noreturn]] void refuse_question(std::string problem, std::string fix)
{
    refuse_usage(std::move(problem), R"({"id": 7, "set": {"contact.friction": 0.7}, "method": "fe", "record": "NAME"})",
                 std::move(fix));
}

std::string text_member(const Json& j, const char* name)
{
    if (!j.contains(name)) return {};
    if (!j[name].is_string()) refuse_question(fmt::format("\"{}\" is no text.", name), "write it in quotes");
    return j[name].get<std::string>();
}

/// One line of the input. @throws InputError for what would take no end to read, and for members that stand twice
Json parsed(const std::string& line)
{
    constexpr std::size_t most_members = 1000;
    constexpr int deepest = 64;
    if (line.size() > longest_line)
        refuse_question(fmt::format("the line is longer than {} MB.", longest_line >> 20), "set the keys of one point");
    std::vector<std::set<std::string>> open; // members of the objects that are not at their end
    return Json::parse(line, [&](int depth, Json::parse_event_t event, Json& value) {
        using Event = Json::parse_event_t;
        if ((event == Event::object_start || event == Event::array_start) && depth > deepest)
            refuse_question(fmt::format("the line is nested deeper than {} levels.", deepest), "write it flat");
        if (event == Event::object_start) open.emplace_back();
        if (event == Event::object_end) open.pop_back();
        if (event != Event::key) return true;
        const std::string name = value.get<std::string>();
        if (!open.back().insert(name).second)
            refuse_question(fmt::format("\"{}\" stands twice in one object.", name), "leave one of them out");
        if (open.back().size() > most_members)
            refuse_question(fmt::format("an object has more than {} members.", most_members),
                            "set only the keys that differ from the scene");
        return true;
    });
}

Question question_of(const Json& j)
{
    Question question;
    for (const auto& [name, value] : j.items())
        if (name != "id" && name != "set" && name != "method" && name != "record")
            refuse_question(fmt::format("unknown member \"{}\".", name), "keys of the scene belong into \"set\"");
    question.method = text_member(j, "method");
    question.record = text_member(j, "record");
    if (!j.contains("set")) return question;
    if (!j["set"].is_object()) refuse_question("\"set\" is no object.", "write  \"set\": {\"contact.friction\": 0.7}");
    for (const auto& [key, value] : j["set"].items()) {
        if (value.is_number())
            question.changes.push_back({key, value.get<double>()});
        else if (value.is_boolean())
            question.changes.push_back({key, value.get<bool>()});
        else if (value.is_string())
            question.changes.push_back({key, value.get<std::string>()});
        else
            refuse_question(fmt::format("{} is set to no number, word, true or false.", key), "give one value");
    }
    return question;
}

SweepMethod method_of(const std::string& id, const Scene& scene)
{
    if (id.empty()) return usual_method(scene);
    const std::vector<std::string> known = sweep_methods();
    if (std::find(known.begin(), known.end(), id) != known.end()) return sweep_method(id);
    const std::string_view near = nearest(id, known);
    refuse_usage(fmt::format("unknown method \"{}\".", id), fmt::format("{}", fmt::join(known, ", ")),
                 near.empty() ? "write  rigid  or  fe" : fmt::format("write  {}", near));
}

class Worker {
public:
    Worker(const WorkerArguments& arguments, const Streams& streams)
        : arguments_(arguments), streams_(streams), text_(SceneText::read(arguments.scene)), scene_(text_.scene())
    {
        (void)method_of(arguments.method, scene_); // refused before the first question
    }

    Json greeting() const
    {
        std::vector<std::string> records;
        for (const RecordFiles& r : scene_.motion.records) records.push_back(r.name);
        return {{"ready", "damslip " + program_version()},
                {"title", scene_.title},
                {"records", records},
                {"methods", sweep_methods()},
                {"keys", text_.keys()}};
    }

    PointAnswer run(const Question& q)
    {
        const Scene scene = text_.with(q.changes);
        TerminalWatch watch(silent_);
        return points_.run(scene, method_of(q.method.empty() ? arguments_.method : q.method, scene),
                           q.record.empty() ? arguments_.record : q.record, watch);
    }

    /// The answer to one line, whatever is wrong with it.
    Json answer(const std::string& line)
    {
        Json id;
        const auto wrong = [&id](Json error) { return Json{{"id", id}, {"error", std::move(error)}}; };
        const auto say = [](const std::string& message) { return Json::array({Json{{"message", message}}}); };
        try {
            const Json j = parsed(line);
            if (!j.is_object()) refuse_question("the line is no JSON object.", "write one object on a line");
            if (j.contains("id")) id = j["id"];
            Json out{{"id", id}};
            out.update(json_of_point(run(question_of(j))));
            return out;
        } catch (const Json::exception&) {
            return wrong(Json::array({Json{{"message", "the line is no JSON."},
                                           {"expected", "one object on a line"},
                                           {"fix", "write  {\"id\": 1, \"set\": {\"contact.friction\": 0.7}}"}}}));
        } catch (const InputError& error) {
            return wrong(error_of(error));
        } catch (const NotConverged& error) {
            return wrong(say(error.what()));
        } catch (const std::bad_alloc&) {
            return wrong(say("not enough memory for this point."));
        }
    }

private:
    const WorkerArguments& arguments_;
    const Streams& streams_;
    Streams silent_{streams_.out, streams_.talk, streams_.form, true, false, nullptr, streams_.stop};
    SceneText text_;
    Scene scene_;
    PointRuns points_;
};

/// Values by the names that a response may have.
Json responses_of(const PointAnswer& answer)
{
    Json j = json_of_point(answer);
    for (const char* name : {"status", "record", "polarity", "method"}) j.erase(name);
    return j;
}

/// Dakota takes a results file that begins with FAIL as a failed evaluation.
std::string dakota_results(const DakotaQuestion& question, const PointAnswer& answer)
{
    const Json values = responses_of(answer);
    std::string text;
    for (std::size_t i = 0; i < question.responses.size(); ++i) {
        const std::string& name = question.responses[i];
        if (!values.contains(name)) {
            std::vector<std::string> known;
            for (const auto& [key, value] : values.items()) known.push_back(key);
            refuse_usage(fmt::format("unknown response descriptor {}.", name),
                         fmt::format("{}", fmt::join(known, ", ")),
                         "name them in  response_descriptors  of Dakota's input");
        }
        if (!question.wanted[i]) continue;
        if (values[name].is_null()) return fmt::format("FAIL\n{}: no {}\n", answer.row.results.status, name);
        text += fmt::format("{} {}\n", shortest(values[name].get<double>()), name);
    }
    return text;
}

int answer_dakota(Worker& worker, const WorkerArguments& a)
{
    const DakotaQuestion question = read_dakota(a.dakota.front());
    const PointAnswer answer = worker.run({{}, question.changes, {}, {}});
    write_file(a.dakota.back(), dakota_results(question, answer));
    return answer.row.good ? exit_ok : exit_no_answer;
}

int answer_quofem(Worker& worker, const WorkerArguments& a)
{
    const PointAnswer answer = worker.run({{}, read_quofem(a.quofem.front()), {}, {}});
    const RowResults& r = answer.row.results;
    if (!r.slip)
        throw NotConverged(Diagnostic{a.quofem.front().string(), 0, 0, fmt::format("no slip: {}.", r.status),
                                      "a point with a slip", "narrow the distributions, or use damslip fragility"});
    write_file(a.quofem.back(), shortest(*r.slip * 1e3) + "\n");
    return answer.row.good ? exit_ok : exit_no_answer;
}

} // namespace

int worker(const WorkerArguments& arguments, const Streams& streams, std::istream& in)
{
    if (!arguments.dakota.empty() && !arguments.quofem.empty())
        refuse_usage("--dakota and --quofem are both given.", "one of them", "delete one");
    Worker worker(arguments, streams);
    if (!arguments.dakota.empty()) return answer_dakota(worker, arguments);
    if (!arguments.quofem.empty()) return answer_quofem(worker, arguments);
    streams.out << line_of(worker.greeting()) << std::flush;
    std::string line;
    while (read_line(in, line, longest_line + 1)) {
        if (line.size() <= longest_line && line.find_first_not_of(" \t\r") == std::string::npos) continue;
        streams.out << line_of(worker.answer(line)) << std::flush;
    }
    return exit_ok;
}

namespace {

void worker_flags(CLI::App& sub, WorkerArguments& a)
{
    sub.add_option("SCENE", a.scene, "scene file (TOML)")->required();
    sub.add_option("--method", a.method,
                   "where a line names none: a method of sweep, such as rigid or fe; default rigid-v, without vertical "
                   "motion rigid");
    sub.add_option("--record", a.record, "where a line names none: a record of the scene");
    sub.add_option("--dakota", a.dakota, "Dakota's parameters file and the results file to write: one point")
        ->expected(2)
        ->group("Other programs");
    sub.add_option("--quofem", a.quofem, "quoFEM's params.in and the results.out to write: one point")
        ->expected(2)
        ->group("Other programs");
}

} // namespace

Command worker_command()
{
    return {"worker", "slip of points that another program asks for: JSON lines, Dakota, quoFEM",
            "damslip worker examples/reference_dam.toml",
            with_flags<WorkerArguments>(
                worker_flags, [](const WorkerArguments& a, const Streams& s) { return worker(a, s, std::cin); })};
}

} // namespace damslip::cli
