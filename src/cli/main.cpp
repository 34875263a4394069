#include "cli/program.hpp"

#include <gsl/gsl_errno.h>

#include <iostream>
#include <unistd.h>

int main(int argc, char** argv)
{
    gsl_set_error_handler_off(); // GSL's own handler ends the process; statuses are checked where it is called
    std::ios::sync_with_stdio(false);
    return damslip::cli::run_program({argv + 1, argv + argc}, std::cout, std::cerr, isatty(2) != 0);
}
