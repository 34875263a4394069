#include "cli/command.hpp"

namespace damslip::cli {

// A new command is a file with a function like these and its line here; nothing else knows their number.
Command init_command();
Command draw_command();
Command assess_command();
Command screen_command();
Command regress_command();
Command slide_command();
Command sweep_command();
Command fragility_command();
Command worker_command();
Command study_command();
Command fe_command();
Command modes_command();
Command mesh_command();
Command explain_command();
Command accuracy_command();
Command record_command();
Command verify_command();
Command schema_command();
Command completion_command();
Command man_command();

std::span<const Command> commands()
{
    static const std::vector<Command> rows = [] {
        std::vector<Command> all;
        for (auto* command : {
                 init_command,
                 draw_command,
                 assess_command,
                 screen_command,
                 regress_command,
                 slide_command,
                 sweep_command,
                 fragility_command,
                 worker_command,
                 study_command,
                 fe_command,
                 modes_command,
                 mesh_command,
                 explain_command,
                 accuracy_command,
                 record_command,
                 verify_command,
                 schema_command,
                 completion_command,
                 man_command,
             })
            all.push_back(command());
        return all;
    }();
    return rows;
}

} // namespace damslip::cli
