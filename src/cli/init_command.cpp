#include "cli/document.hpp"
#include "cli/flags.hpp"
#include "core/file.hpp"
#include "core/number.hpp"
#include "core/status.hpp"
#include "core/usage_error.hpp"
#include "pages/scene/drawn_section.hpp"
#include "pages/scene/scene_template.hpp"
#include "scene/read.hpp"

#include <fmt/format.h>
#include <iostream>
#include <unistd.h>

namespace damslip::cli {

namespace {

struct InitArguments {
    std::filesystem::path out = "dam.toml";
    pages::SceneTemplate dam;
    bool force = false; ///< replaces a file
};

/// A number from the terminal; nothing for an empty line: what is assumed stays.
std::optional<double> asked(const std::string& what, const std::string& otherwise, const Streams& streams)
{
    for (;;) {
        streams.talk << what << (otherwise.empty() ? ": " : fmt::format(" [{}]: ", otherwise)) << std::flush;
        std::string line;
        if (!read_line(std::cin, line)) return std::nullopt;
        if (line.find_first_not_of(" \t\r") == std::string::npos) {
            if (!otherwise.empty()) return std::nullopt;
            continue;
        }
        if (const std::optional<double> value = parse_whole_number_text(line); value && *value > 0.0) return value;
        streams.talk << "a number above zero, such as 62.5\n";
    }
}

void ask_for_the_rest(pages::SceneTemplate& dam, const Streams& streams)
{
    const auto ask = [&](std::optional<double>& value, const char* what, double otherwise) {
        if (!value) value = asked(what, fmt::format("{:.4g}", otherwise), streams);
    };
    if (dam.height <= 0.0) dam.height = asked("height of the dam [m]", "", streams).value_or(0.0);
    if (dam.height <= 0.0) return;
    ask(dam.base, "length of its base [m]", 0.8 * dam.height);
    ask(dam.crest, "width of its crest [m]", 0.1 * dam.height);
    ask(dam.level, "water above the heel [m]", 0.95 * dam.height);
    ask(dam.friction, "friction of the base [-]", 0.8);
}

/// Writes a commented scene and its drawing beside it. Asks for what is missing where somebody sits at the terminal.
int init(const InitArguments& arguments, const Streams& streams)
{
    InitArguments a = arguments;
    if (isatty(STDIN_FILENO) && !streams.quiet && a.dam.height <= 0.0) ask_for_the_rest(a.dam, streams);
    if (!(a.dam.height > 0.0))
        throw UsageError(Diagnostic{"", 0, 0, "the height of the dam is missing.", "--height in metres",
                                    "for example  damslip init dam.toml --height 62.5 --base 45"});
    if (!a.dam.verticals.empty() && a.dam.verticals.size() != a.dam.records.size())
        throw UsageError(Diagnostic{
            "", 0, 0,
            fmt::format("{} vertical records beside {} horizontal ones.", a.dam.verticals.size(), a.dam.records.size()),
            "one --vertical for each --record, or none", "name as many"});
    if (!a.force && std::filesystem::exists(a.out))
        throw UsageError(Diagnostic{a.out.string(), 0, 0, "is there already.", "a new file",
                                    "choose another name, or replace it with  --force"});
    const std::filesystem::path folder = std::filesystem::absolute(a.out).parent_path();
    for (auto* records : {&a.dam.records, &a.dam.verticals}) // names in a scene count from its folder
        for (std::filesystem::path& record : *records)
            record = std::filesystem::proximate(std::filesystem::absolute(record), folder);
    const std::string text = pages::scene_text(a.dam);
    const Scene scene = parse_scene(text, a.out);
    write_file(a.out, text);
    std::filesystem::path drawing = a.out;
    drawing.replace_extension(".svg");
    write_file(drawing, pages::drawn_section(scene));
    if (!put_json_document(streams, "init", {{"scene", a.out.string()}, {"drawing", drawing.string()}}))
        streams.out << fmt::format("{}: the scene, assumptions marked\n{}: its section\nnext:  damslip screen {}\n",
                                   a.out.string(), drawing.string(), a.out.string());
    return exit_ok;
}

void init_flags(CLI::App& sub, InitArguments& a)
{
    sub.add_option("FILE", a.out, "scene to write")
        ->capture_default_str()
        ->check(output_to(OutputPath::regular_file, "FILE"));
    sub.add_option("--height", a.dam.height, "of the dam [m]; asked for at a terminal")->check(in_range(1.0, 1000.0));
    sub.add_option("--base", a.dam.base, "length of the base [m] (0.8 of the height)")->check(in_range(0.1, 2000.0));
    sub.add_option("--crest", a.dam.crest, "width of the crest [m] (0.1 of the height)")->check(in_range(0.1, 1000.0));
    sub.add_option("--level", a.dam.level, "of the water above the heel [m] (0.95 of the height)")
        ->check(in_range(0.1, 3000.0));
    sub.add_option("--friction", a.dam.friction, "of the base [-] (0.8)")->check(in_range(0.01, 10.0));
    sub.add_option("--allowable", a.dam.allowable, "slip [mm] (50)")->check(in_range(0.1, 100000.0));
    sub.add_option("--title", a.dam.title, "of the dam")->capture_default_str();
    sub.add_option("--record", a.dam.records, "horizontal accelerogram(s)");
    sub.add_option("--vertical", a.dam.verticals, "vertical accelerogram(s), one for each --record");
    sub.add_flag("--force", a.force, "replace FILE where it is there");
}

} // namespace

Command init_command()
{
    return {"init", "a commented scene of your own dam, with its drawing",
            "damslip init dam.toml --height 62.5 --base 45", with_flags<InitArguments>(init_flags, init)};
}

} // namespace damslip::cli
