#include "cli/program.hpp"

#include <gsl/gsl_errno.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <unistd.h>

namespace {

/// OpenBLAS starts a thread for each core when it is loaded, which the program takes back (fe2d/solver/blas_threads.hpp),
/// and tries for ever where memory is short (ulimit -v). Asked for one thread before that, it starts none: functions of
/// this section run before those of the libraries.
void ask_for_one_blas_thread(int, char**, char**)
{
    ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
    ::setenv("OMP_NUM_THREADS", "1", 1);
}
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)(int, char**, char**) =
    ask_for_one_blas_thread;

} // namespace

int main(int argc, char** argv)
{
    gsl_set_error_handler_off(); // GSL's own handler ends the process; statuses are checked where it is called
    std::ios::sync_with_stdio(false);
    std::signal(SIGPIPE, SIG_IGN); // a reader that went away is a failed write: files are finished, and the code says it
    return damslip::cli::run_program({argv + 1, argv + argc}, std::cout, std::cerr, isatty(2) != 0);
}
