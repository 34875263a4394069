#include "cli/document.hpp"
#include "cli/flags.hpp"
#include "core/file.hpp"
#include "core/status.hpp"
#include "pages/scene/drawn_section.hpp"

#include <ostream>

namespace damslip::cli {

namespace {

struct DrawArguments {
    RunInputs inputs;
    std::filesystem::path out; ///< empty: standard output
};

/// The section of a scene as SVG.
int draw(const DrawArguments& arguments, const Streams& streams)
{
    const Scene scene = read_run_scene(arguments.inputs, streams);
    need_section(scene, "damslip draw", "damslip screen SCENE --out DIR draws a wedge in its report");
    const std::string svg = pages::drawn_section(scene);
    if (!arguments.out.empty()) {
        write_file(arguments.out, svg);
        put_json_document(streams, "draw", {{"out", arguments.out.string()}});
    } else if (!put_json_document(streams, "draw", {{"svg", svg}})) {
        streams.out << svg;
    }
    return exit_ok;
}

void draw_flags(CLI::App& sub, DrawArguments& a)
{
    add_scene(sub, a.inputs);
    add_out(sub, a.out, OutputPath::file, "SVG file; without it the drawing goes to standard output", "-o,--out");
}

} // namespace

Command draw_command()
{
    return {"draw", "the section of a scene as SVG: water, uplift, curtain, drains, signs",
            "damslip draw examples/reference_dam.toml --out dam.svg", with_flags<DrawArguments>(draw_flags, draw)};
}

} // namespace damslip::cli
