#include "cli/program.hpp"
#include "verification/program/carry.hpp"

int main(int argc, char** argv)
{
    return damslip::cli::run_process(argc, argv, damslip::cli::verifier_commands());
}
