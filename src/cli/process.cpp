#include "cli/process.hpp"

#include "cli/program.hpp"

#include <gsl/gsl_errno.h>

#include <climits>
#include <csignal>
#include <cstring>
#include <dlfcn.h>
#include <iostream>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

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
    using Shutdown = int (*)();
    if (const auto shutdown = reinterpret_cast<Shutdown>(dlsym(RTLD_DEFAULT, "blas_thread_shutdown_"))) shutdown();
}

/// Memory that is given back is kept by the program: a run takes and returns the same matrices again and again, and the system would
/// clear their pages each time, a twentieth of a finite-element run. Blocks of 32 MiB and more still go back at once.
void keep_memory()
{
#ifdef __GLIBC__
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
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
    return run_program({argv + 1, argv + argc}, std::cout, std::cerr, isatty(2) != 0, rows);
}

} // namespace damslip::cli
