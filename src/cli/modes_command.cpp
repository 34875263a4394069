#include "cli/modes_command.hpp"

#include "core/usage_error.hpp"
#include "pages/modes/modes_page.hpp"

#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

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

} // namespace damslip::cli
