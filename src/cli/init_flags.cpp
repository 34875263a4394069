#include "cli/flags.hpp"
#include "cli/init_command.hpp"

namespace damslip::cli {

namespace {

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
