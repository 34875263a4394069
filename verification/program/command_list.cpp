#include "verification/program/carry.hpp"

namespace damslip::cli {

std::span<const Command> verifier_commands()
{
    static const std::vector<Command> rows{verify_command(verify), study_command(study), mesh_command(calculix)};
    return rows;
}

} // namespace damslip::cli
