#include "cli/program.hpp"

#include "cli/arguments.hpp"
#include "cli/terminal/usage_error.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

namespace {

/// {"error": {"code", "message", "diagnostics": [...]}} where --json was asked for, the sentences otherwise.
void report_error(const std::string& message, const std::vector<Diagnostic>& diagnostics, int code, Form form,
                  std::ostream& out, std::ostream& talk)
{
    talk << message << "\n";
    if (form != Form::json) return;
    nlohmann::ordered_json j;
    j["error"] = {{"code", code}, {"message", message}, {"diagnostics", nlohmann::ordered_json::array()}};
    for (const Diagnostic& d : diagnostics)
        j["error"]["diagnostics"].push_back({{"file", d.file},
                                             {"line", d.line},
                                             {"column", d.column},
                                             {"message", d.problem},
                                             {"expected", d.expected},
                                             {"fix", d.fix}});
    out << j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

} // namespace

int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& talk, bool talk_is_terminal)
{
    const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    const Form form = json ? Form::json : Form::text;
    try {
        const Invocation invocation = parse_arguments(arguments);
        const Streams streams{out, talk, invocation.form, invocation.quiet, talk_is_terminal && !invocation.quiet};
        const int code = invocation.run(streams);
        out.flush();
        if (!out) {
            talk << "error: the output could not be written (disk full, or the reader went away).\n";
            return exit_internal;
        }
        return code;
    } catch (const HelpText& help) {
        out << help.text;
        return exit_ok;
    } catch (const UsageError& error) {
        report_error(error.what(), error.diagnostics(), exit_usage, form, out, talk);
        return exit_usage;
    } catch (const NotConverged& error) {
        report_error(error.what(), {error.diagnostic()}, exit_no_answer, form, out, talk);
        return exit_no_answer;
    } catch (const Interrupted& error) {
        report_error(error.what(), {}, exit_no_answer, form, out, talk);
        return exit_no_answer;
    } catch (const InputError& error) {
        report_error(error.what(), error.diagnostics(), exit_input, form, out, talk);
        return exit_input;
    } catch (const std::exception& error) {
        report_error(std::string("internal error: ") + error.what() +
                         "\n  please report this with the command and the scene",
                     {}, exit_internal, form, out, talk);
        return exit_internal;
    }
}

} // namespace damslip::cli
