#include "cli/command.hpp"
#include "cli/verifier.hpp"

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
Command fe_command();
Command modes_command();
Command calibrate_command();
Command explain_command();
Command accuracy_command();
Command record_command();
Command schema_command();
Command completion_command();
Command man_command();

namespace {

/// A row that damslip-verify carries out.
template <class Arguments, Command (*command)(Carry<Arguments>)>
Command handed_on()
{
    return command([](const Arguments&, const Streams& streams) { return streams.hand_on(); });
}

} // namespace

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
                 handed_on<StudyArguments, study_command>,
                 fe_command,
                 modes_command,
                 calibrate_command,
                 handed_on<MeshArguments, mesh_command>,
                 explain_command,
                 accuracy_command,
                 record_command,
                 handed_on<VerifyArguments, verify_command>,
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
