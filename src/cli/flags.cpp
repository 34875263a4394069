#include "cli/flags.hpp"

#include "cli/print_pdf.hpp"
#include "core/usage_error.hpp"

namespace damslip::cli {

void add_scene(CLI::App& sub, RunInputs& in)
{
    sub.add_option("SCENE", in.scene, "scene file (TOML); -: standard input")->required();
    sub.add_flag("--strict", in.strict, "values outside the range of real dams are errors, not notes");
}

void add_run_inputs(CLI::App& sub, RunInputs& in)
{
    add_scene(sub, in);
    sub.add_option("--record", in.records, "horizontal accelerogram(s) instead of the scene's")->group("Ground motion");
    sub.add_option("--vertical", in.verticals,
                   "vertical accelerogram(s), one for each --record, in the same order; none for a record without one")
        ->group("Ground motion");
    sub.add_option("--records", in.record_list,
                   "folder, pattern in quotes ('suite/*.AT2') or list (CSV) of accelerograms instead of the scene's; "
                   "components "
                   "are paired by their names")
        ->group("Ground motion");
    sub.add_option("--units", in.unit, "unit of record files that do not say: g, m/s2, cm/s2, gal, mg")
        ->group("Ground motion");
    sub.add_option("--dt", in.dt, "time step of one-column record files [s]")->group("Ground motion");
    sub.add_option("--column", in.column, "heading or number of the horizontal column where files hold several")
        ->group("Ground motion");
    sub.add_option("--vertical-column", in.vertical_column, "the same of the vertical files")->group("Ground motion");
}

void add_rock(CLI::App& sub, RunInputs& in)
{
    sub.add_option("--rock", in.rock, "radiating (with mass, waves leave) or massless, in place of the scene's rock")
        ->check(CLI::IsMember({"radiating", "massless"}));
}

void add_pdf(CLI::App& sub, std::filesystem::path& target)
{
    sub.add_option("--pdf", target, "the report printed on A4 (.pdf); needs Chromium")
        ->check([](const std::string& path) -> std::string {
            check_pdf(path);
            return {};
        });
}

std::function<std::string(const std::string&)> output_to(OutputPath kind, const std::string& flag)
{
    return [kind, flag](const std::string& path) -> std::string {
        if (auto problem = output_path_problem(path, kind, flag)) throw UsageError(std::move(*problem));
        return {};
    };
}

} // namespace damslip::cli
