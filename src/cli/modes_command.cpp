#include "cli/flags.hpp"
#include "core/usage_error.hpp"
#include "pages/modes/modes_page.hpp"

#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

struct ModesArguments {
    RunInputs inputs;
    std::optional<int> count;        ///< modes; none: ModesOptions::count
    bool frequency_response = false; ///< transfer functions, 0.1 ... 20 Hz
    std::filesystem::path out;       ///< folder for mode shapes (VTU) and transfer functions (CSV); empty: none
};

/// Natural frequencies, effective masses and damping coefficients of the dam on its rock with its water, tied base. Acoustic water:
/// every coupled mode up to 20 Hz. reservoir.model = "auto" is decided by the compressibility criterion.
int modes(const ModesArguments& arguments, const Streams& streams)
{
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip modes", "a wedge is rigid; damslip screen SCENE gives its slip");
    const Ready ready = prepare(given, Method::finite_elements, {.stop = streams.stop});
    const ModesResult result = compute_modes(ready, {arguments.count, arguments.frequency_response});
    streams.out << (streams.form == Form::json ? modes_json(given, result).dump(2) + "\n" : modes_text(given, result));
    if (!arguments.out.empty()) write_modes(arguments.out, given, result);
    return result.complete() ? exit_ok : exit_no_answer;
}

void modes_flags(CLI::App& sub, ModesArguments& a)
{
    add_run_inputs(sub, a.inputs);
    add_rock(sub, a.inputs);
    sub.add_option("-n,--count", a.count, "number of modes (10; with acoustic water all up to 20 Hz)")
        ->check(CLI::Range(1, 200));
    sub.add_flag("--frf", a.frequency_response,
                 "transfer functions ground to crest and to the water's force, 0.1 ... 20 Hz");
    add_out(sub, a.out, OutputPath::folder,
            "folder for the mode shapes as VTU files and the transfer functions as CSV");
}

} // namespace

Command modes_command()
{
    return {"modes", "natural frequencies, effective masses, Rayleigh and modified Rayleigh coefficients",
            "damslip modes examples/reference_dam.toml --count 5", with_flags<ModesArguments>(modes_flags, modes)};
}

} // namespace damslip::cli
