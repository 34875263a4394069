#include "cli/program.hpp"

#include "cli/arguments.hpp"
#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/visible_stream.hpp"
#include "cli/verifier.hpp"
#include "core/cache_folder.hpp"
#include "core/text.hpp"
#include "core/usage_error.hpp"

#include <algorithm>
#include <new>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

namespace {

/// {"error": {"code", "message", "diagnostics": [...]}}
std::string error_json(const std::string& message, const std::vector<Diagnostic>& diagnostics, int code)
{
    nlohmann::ordered_json j;
    j["error"] = {{"code", code}, {"message", message}, {"diagnostics", nlohmann::ordered_json::array()}};
    for (const Diagnostic& d : diagnostics)
        j["error"]["diagnostics"].push_back({{"file", d.file},
                                             {"line", d.line},
                                             {"column", d.column},
                                             {"message", d.problem},
                                             {"expected", d.expected},
                                             {"fix", d.fix}});
    return j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// The sentences, and the error object where --json was asked for.
void report_error(const std::string& message, const std::vector<Diagnostic>& diagnostics, int code, Form form,
                  std::ostream& out, std::ostream& talk)
{
    talk << message << "\n";
    if (form == Form::json) out << error_json(message, diagnostics, code);
    out.flush();
}

const char* const no_memory =
    "error: not enough memory for this command.\n"
    "  expected: as much as the model takes: `damslip explain SCENE --method fe` prints the bytes of its parts\n"
    "  fix:      a coarser mesh, fewer --jobs, or a higher limit (ulimit -v)";

/// Said where a computation is ended that does not ask (InterruptGuard).
void prepare_farewell(Form form)
{
    const std::string message = "Interrupted: ended at once; what is finished is in the files written so far.";
    InterruptGuard::set_farewell(message + "\n",
                                 form == Form::json ? error_json(message, {}, exit_no_answer) : std::string());
}

/// Names reach JSON, tables and pages, which are UTF-8.
void check_names(const std::vector<std::string>& arguments)
{
    for (const std::string& argument : arguments)
        if (!is_utf8(argument))
            refuse(utf8_text(argument), "this name is not UTF-8 (its bytes are shown as Latin-1).", "names in UTF-8",
                   "rename the file or folder");
}

} // namespace

int run_program(const std::vector<std::string>& arguments, std::ostream& raw_out, std::ostream& raw_talk,
                bool talk_is_terminal, std::span<const Command> rows)
{
    VisibleStream out(raw_out), talk(raw_talk);
    const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    const Form form = json ? Form::json : Form::text;
    try {
        check_names(arguments);
        const Invocation invocation = parse_arguments(arguments, rows);
        prepare_farewell(form);
        const InterruptGuard interrupt;
        Streams streams{out, talk, invocation.form, invocation.quiet, talk_is_terminal && !invocation.quiet};
        if (streams.terminal) streams.bar = &raw_talk;
        streams.hand_on = [&] {
            raw_out.flush(), raw_talk.flush();
            return start_verifier(arguments);
        };
        streams.stop = [&interrupt] { return interrupt.interrupted(); };
        use_cache_folder(invocation.cache ? user_cache_folder() : std::filesystem::path());
        int code = invocation.run(streams);
        if (interrupt.interrupted() && code == exit_ok) {
            talk << "Interrupted: the answer is of what was finished.\n";
            code = exit_no_answer;
        }
        if (json && !out.used()) // a command whose answer is files
            out << nlohmann::ordered_json{{"schema", "damslip.done/1"}, {"exit_code", code}}.dump(2) << "\n";
        out.flush();
        if (!out) {
            talk << "error: standard output could not be written: the disk is full, or its reader went away.\n";
            return exit_input;
        }
        return code;
    } catch (const HelpText& help) {
        out << help.text;
        out.flush();
        return out ? exit_ok : exit_input;
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
    } catch (const std::bad_alloc&) {
        report_error(no_memory, {}, exit_no_answer, form, out, talk);
        return exit_no_answer;
    } catch (const std::exception& error) {
        report_error(std::string("internal error: ") + error.what() +
                         "\n  please report this with the command and the scene",
                     {}, exit_internal, form, out, talk);
        return exit_internal;
    }
}

} // namespace damslip::cli
