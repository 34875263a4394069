#include "cli/program.hpp"

#include "cli/command.hpp"
#include "cli/terminal/terminal.hpp"
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "scene/read.hpp"

#include <algorithm>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <gsl/gsl_errno.h>
#include <iostream>
#include <malloc.h>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

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

/// The sentences, and the error object where --json was asked for. @returns the code
int report_error(std::string message, std::vector<Diagnostic> diagnostics, int code, Form form, std::ostream& out,
                 std::ostream& talk)
{
    for (Diagnostic& d : diagnostics) d = with_line(std::move(d));
    if (!diagnostics.empty()) message = InputError(diagnostics).what();
    talk << message << "\n";
    if (form == Form::json) out << error_json(message, diagnostics, code);
    out.flush();
    return code;
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
                bool talk_is_terminal, std::span<const Command> rows, bool out_is_terminal, Form unasked)
{
    VisibleStream out(raw_out), talk(raw_talk);
    std::vector<std::string> held;
    const auto print_held = [&] { // of a command that ends without an answer to print them below
        for (const std::string& line : held) talk << line << "\n";
        held.clear();
    };
    const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    const Form form = json ? Form::json : Form::text;
    try {
        check_names(arguments);
        const InputsKept inputs_kept;
        const Invocation invocation = parse_arguments(arguments, rows);
        prepare_farewell(form);
        const InterruptGuard interrupt;
        const Form answer_form = invocation.form == Form::text && !invocation.brief ? unasked : invocation.form;
        Streams streams{out, talk, answer_form, invocation.quiet, talk_is_terminal && !invocation.quiet};
        if (streams.terminal) streams.bar = &raw_talk;
        streams.hand_on = [&] {
            raw_out.flush(), raw_talk.flush();
            return start_verifier(arguments);
        };
        streams.stop = [&interrupt] { return interrupt.interrupted(); };
        streams.out_is_terminal = out_is_terminal;
        if (answer_form == Form::text) streams.held = &held;
        use_cache_folder(invocation.cache ? user_cache_folder() : std::filesystem::path());
        int code = exit_ok;
        try {
            code = invocation.run(streams);
        } catch (...) {
            print_held();
            throw;
        }
        print_held();
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
        return report_error(error.what(), error.diagnostics(), exit_usage, form, out, talk);
    } catch (const NotConverged& error) {
        return report_error(error.what(), {error.diagnostic()}, exit_no_answer, form, out, talk);
    } catch (const Interrupted& error) {
        return report_error(error.what(), {}, exit_no_answer, form, out, talk);
    } catch (const InputError& error) {
        return report_error(error.what(), error.diagnostics(), exit_input, form, out, talk);
    } catch (const std::bad_alloc&) {
        return report_error(no_memory, {}, exit_no_answer, form, out, talk);
    } catch (const std::exception& error) {
        return report_error(std::string("internal error: ") + error.what() +
                                "\n  please report this with the command and the scene",
                            {}, exit_internal, form, out, talk);
    }
}

} // namespace damslip::cli

namespace {

constexpr const char* one_thread = "OPENBLAS_NUM_THREADS=1";
constexpr std::size_t most_variables = 4096; ///< of an environment that is taken over

/// Where memory is limited (ulimit -v), the program starts anew with OpenBLAS asked for one thread. It starts one for each
/// core as soon as it is loaded, which the program takes back (fe2d/solver/linear_solver.cpp), and tries for ever where
/// they do not fit. Functions of this section run before those of the libraries; the environment of a process that
/// runs already cannot grow before they do.
void start_with_one_blas_thread(int, char** arguments, char** environment)
{
    rlimit memory{};
    if (::getrlimit(RLIMIT_AS, &memory) != 0 || memory.rlim_cur == RLIM_INFINITY) return;
    static const char* variables[most_variables + 2];
    std::size_t count = 0;
    for (; environment[count] && count < most_variables; ++count) {
        if (std::strncmp(environment[count], one_thread, std::strchr(one_thread, '=') - one_thread + 1) == 0) return;
        variables[count] = environment[count];
    }
    if (environment[count]) return;
    variables[count] = one_thread;
    static char program[PATH_MAX];
    if (::readlink("/proc/self/exe", program, sizeof program - 1) > 0)
        ::execve(program, arguments, const_cast<char* const*>(variables)); // comes back only where it failed
}
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)(int, char**,
                                                                             char**) = start_with_one_blas_thread;

/// Ends the threads that OpenBLAS has started: they look for work in a loop for some tens of milliseconds, as long as a short
/// command takes. Nothing needs them later: finite elements run BLAS with one thread (fe2d/solver/linear_solver.cpp).
void end_blas_threads()
{
    damslip::fe2d::use_one_blas_thread(); // before: asked afterwards, OpenBLAS starts one again
    using Shutdown = int (*)();
    if (const auto shutdown = reinterpret_cast<Shutdown>(dlsym(RTLD_DEFAULT, "blas_thread_shutdown_"))) shutdown();
}

/// Memory that is given back is kept by the program: a run takes and returns the same matrices again and again, and the system would
/// clear their pages each time, a twentieth of a finite-element run. Blocks of 256 MiB and more still go back at once.
/// The first of it lies in large pages where the system has them: a first touch costs as much for 2 MiB as for 4 KiB.
/// No memory is taken by that before it is used. Where memory is limited (ulimit -v) it would count, and small pages remain.
void keep_memory()
{
#ifdef __GLIBC__
    constexpr std::size_t first = 1 << 30, large_page = 2 << 20;
    constexpr int usual_blocks_of_their_own = 65536; // glibc's M_MMAP_MAX
    ::mallopt(M_MMAP_THRESHOLD, 256 << 20);
    ::mallopt(M_TRIM_THRESHOLD, INT_MAX); // more than `first`
    rlimit memory{};
    if (::getrlimit(RLIMIT_AS, &memory) != 0 || memory.rlim_cur != RLIM_INFINITY) return;
    ::mallopt(M_MMAP_MAX, 0); // this block is of the heap itself
    if (void* const block = std::malloc(first)) {
        void* pages = block;
        std::size_t size = first;
        if (std::align(large_page, first - large_page, pages, size)) ::madvise(pages, first - large_page, MADV_HUGEPAGE);
        std::free(block);
    }
    ::mallopt(M_MMAP_MAX, usual_blocks_of_their_own);
#endif
}

} // namespace

namespace damslip::cli {

int run_process(int argc, char** argv, std::span<const Command> rows)
{
    end_blas_threads();
    keep_memory();
    gsl_set_error_handler_off(); // GSL's own handler ends the process; statuses are checked where it is called
    std::ios::sync_with_stdio(false);
    std::signal(SIGPIPE,
                SIG_IGN); // a reader that went away is a failed write: files are finished, and the code says it
    return run_program({argv + 1, argv + argc}, std::cout, std::cerr, isatty(2) != 0, rows, isatty(1) != 0, Form::text);
}

} // namespace damslip::cli
