#include "cli/command.hpp"

#include "cli/verifier.hpp"
#include "core/input_error.hpp"
#include "core/inputs_kept.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "pages/report/json.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

bool put_json_document(const Streams& streams, const std::string& what,
                       std::initializer_list<std::pair<const char*, std::string>> members)
{
    if (streams.form != Form::json) return false;
    auto j = pages::json_header(what);
    for (const auto& [name, text] : members) j[name] = text;
    streams.out << j.dump(2) << "\n";
    return true;
}

void put_answer(pages::Answer answer, const std::string& files, const Streams& streams, std::ostream* to)
{
    std::ostream& out = to ? *to : streams.out;
    if (streams.form == Form::json) {
        out << answer.json().dump(2) << "\n";
    } else if (streams.form == Form::full) {
        out << answer.full();
    } else if (streams.quiet) {
        out << answer.line();
    } else {
        for (const std::string& line : streams.held ? *streams.held : std::vector<std::string>{}) {
            std::string_view text = line;
            for (const std::string_view kind : {"note: ", "warning: "}) // an answer's notes are notes
                if (text.starts_with(kind)) text.remove_prefix(kind.size());
            answer.note_in_brief(std::string(text));
        }
        if (streams.held) streams.held->clear();
        out << answer.brief(files);
    }
}

void add_scene(CLI::App& sub, RunInputs& in)
{
    sub.add_option("SCENE", in.scene, "scene file (TOML); -: standard input")->required();
    sub.add_flag("--strict", in.strict, "values outside the range of real dams are errors, not notes");
}

void add_run_inputs(CLI::App& sub, RunInputs& in)
{
    add_scene(sub, in);
    sub.option_defaults()->group("Ground motion");
    sub.add_option("--record", in.records, "horizontal accelerogram(s) instead of the scene's");
    sub.add_option("--vertical", in.verticals,
                   "vertical accelerogram(s), one for each --record, in the same order; none for a record without one");
    sub.add_option("--records", in.record_list,
                   "folder, pattern in quotes ('suite/*.AT2') or list (CSV) of accelerograms instead of the scene's; "
                   "components "
                   "are paired by their names");
    sub.add_option("--units", in.unit, "unit of record files that do not say: g, m/s2, cm/s2, gal, mg");
    sub.add_option("--dt", in.dt, "time step of one-column record files [s]");
    sub.add_option("--column", in.column, "heading or number of the horizontal column where files hold several");
    sub.add_option("--vertical-column", in.vertical_column, "the same of the vertical files");
    sub.option_defaults()->group("Options");
}

void add_scale(CLI::App& sub, RunInputs& in)
{
    sub.add_option("--scale", in.scale, "factor on all records")->group("Ground motion");
}

void add_friction(CLI::App& sub, RunInputs& in)
{
    sub.add_option("--friction", in.friction, "Coulomb mu instead of the scene's");
}

void add_rock(CLI::App& sub, RunInputs& in)
{
    sub.add_option("--rock", in.rock, "radiating (with mass, waves leave) or massless, in place of the scene's rock")
        ->check(CLI::IsMember({"radiating", "massless"}));
}

void add_plane(CLI::App& sub, RunInputs& in)
{
    sub.add_option("--plane", in.plane, "what the dam slides on: base (default), or the name of a [[seam]], whose rock then moves along");
}

void add_response_spectrum(CLI::App& sub, SpectrumArguments& a)
{
    const char* const group = "Response spectrum";
    sub.option_defaults()->group(group);
    CLI::Option* on = sub.add_flag("--response-spectrum", a.wanted,
                                   "peaks of the dam on a bonded base by its modes: forces, stresses, factors");
    CLI::Option* file = sub.add_option("--spectrum", a.horizontal,
                                       "its spectrum at 5 % damping, period [s] and S_a over any unit, in place of the "
                                       "records'")
                            ->needs(on);
    CLI::Option* pga = sub.add_option("--spectrum-pga", a.pga, "S_a at period 0 of that spectrum [m/s^2]")
                           ->check(in_range(1e-3, 100.0))
                           ->needs(file);
    file->needs(pga);
    CLI::Option* vertical = sub.add_option("--spectrum-vertical", a.vertical,
                                           "the same of the vertical component; without it that spectrum has none")
                                ->needs(file);
    CLI::Option* vertical_pga =
        sub.add_option("--spectrum-vertical-pga", a.vertical_pga, "S_a at period 0 of the vertical spectrum [m/s^2]")
            ->check(in_range(1e-3, 100.0))
            ->needs(vertical);
    sub.option_defaults()->group("Options");
    vertical->needs(vertical_pga);
}

CLI::Validator in_range(double low, double high)
{
    const auto check = [low, high](const std::string& text) -> std::string {
        std::size_t used = 0;
        const std::optional<double> value = parse_number(text, &used);
        if (value && used == text.size() && *value >= low && *value <= high) return {};
        return fmt::format("{} is not allowed: a number from {:g} to {:g}", text, low, high);
    };
    return {check, fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

CLI::Option* add_jobs(CLI::App& sub, int& jobs, const std::string& text)
{
    return sub.add_option("-j,--jobs", jobs, text)->check(CLI::Range(0, 1024))->each([](const std::string& value) {
        use_threads(std::stoi(value));
    });
}

CLI::Option* add_out(CLI::App& sub, std::filesystem::path& target, OutputPath kind, const std::string& text,
                     const std::string& names)
{
    return sub.add_option(names, target, text)->check(output_to(kind, "--out"));
}

void add_pdf(CLI::App& sub, std::filesystem::path& target)
{
    sub.add_option("--pdf", target, "the report printed on A4 (.pdf); needs Chromium")
        ->check([](const std::string& path) -> std::string {
            check_pdf(path);
            return {};
        });
}

void add_sheet(CLI::App& sub, std::filesystem::path& target, const std::string& help)
{
    sub.add_option("--sheet", target, help)->check([](const std::string& path) -> std::string {
        check_sheet(path);
        return {};
    });
}

void check_output(const std::filesystem::path& path, OutputPath kind, const std::string& flag)
{
    if (auto problem = output_path_problem(path, kind, flag)) throw UsageError(std::move(*problem));
    keep_from_inputs(path, kind, flag);
}

std::function<std::string(const std::string&)> output_to(OutputPath kind, const std::string& flag)
{
    return [kind, flag](const std::string& path) -> std::string {
        check_output(path, kind, flag);
        return {};
    };
}

} // namespace damslip::cli
