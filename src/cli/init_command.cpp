#include "cli/init_command.hpp"

#include "core/file.hpp"
#include "core/number.hpp"
#include "core/status.hpp"
#include "core/usage_error.hpp"
#include "pages/scene/drawn_section.hpp"
#include "scene/read.hpp"

#include <fmt/format.h>
#include <iostream>
#include <unistd.h>

namespace damslip::cli {

namespace {

/// A number from the terminal; nothing for an empty line: what is assumed stays.
std::optional<double> asked(const std::string& what, const std::string& otherwise, const Streams& streams)
{
    for (;;) {
        streams.talk << what << (otherwise.empty() ? ": " : fmt::format(" [{}]: ", otherwise)) << std::flush;
        std::string line;
        if (!std::getline(std::cin, line)) return std::nullopt;
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

} // namespace

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
    streams.out << fmt::format("{}: the scene, assumptions marked\n{}: its section\nnext:  damslip screen {}\n",
                               a.out.string(), drawing.string(), a.out.string());
    return exit_ok;
}

} // namespace damslip::cli
