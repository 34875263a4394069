#include "cli/program.hpp"

int main(int argc, char** argv)
{
    return damslip::cli::run_process(argc, argv, damslip::cli::commands());
}
