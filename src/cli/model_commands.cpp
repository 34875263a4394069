#include "cli/model_commands.hpp"

#include "analysis/modes/modes.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "analysis/spectrum/spectrum_level.hpp"
#include "cli/command.hpp"
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/status.hpp"
#include "core/text.hpp"
#include "fe2d/gmsh/gmsh.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "pages/fe/fe_pages.hpp"
#include "pages/modes/modes_pages.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "records/generate/wavelet_match.hpp"
#include "scene/plausible.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
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
    put_answer(modes_answer(given, result), arguments.out.empty() ? "" : "--out DIR", streams);
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

namespace {

fe2d::BaseNodes base_nodes(const MeshArguments& arguments, const fe2d::Mesh& mesh)
{
    if (arguments.base == "twice") return fe2d::BaseNodes::twice;
    if (!mesh.contact.matching)
        refuse_usage("--base shared, but the nodes of dam and rock do not face each other.",
                     "--base twice for such a mesh", "write  --base twice");
    return fe2d::BaseNodes::shared;
}

/// The mesh without middle nodes: mesh.element adds them when the file is read.
Scene of_first_order(Scene scene)
{
    const bool triangles = scene.mesh.element == ElementKind::t3 || scene.mesh.element == ElementKind::t6;
    scene.mesh.element = triangles ? ElementKind::t3 : ElementKind::q4;
    return scene;
}

/// The mesh of a scene as contact runs have it, the program's own or an imported one: sizes, shapes, contact pairs; written as a
/// Gmsh file where asked for.
int mesh(const MeshArguments& arguments, const Streams& streams)
{
    if (!arguments.results.empty())
        refuse_usage("--results without --to calculix.", "results of CalculiX", "add  --to calculix");
    const Scene given = with_seam_body(with_joints_of_lifts(read_run_scene(arguments.inputs, streams)));
    need_section(given, "damslip mesh", "a wedge is rigid; damslip screen SCENE gives its slip");
    const Scene scene = called_for(make_effect_plan(given, Method::finite_elements), given);
    fe2d::ContactExtension extension;
    if (scene.contact.sliding == JointPath::finite) extension.downstream = scene.contact.max_slip;
    const fe2d::Mesh mesh = fe2d::build_mesh(scene, extension);
    const fe2d::MeshQuality quality = fe2d::measure_quality(mesh);
    Table table = mesh_table(mesh);
    for (std::string& note : note_texts(given.notes)) table.notes.push_back(std::move(note));
    for (std::string& note : bond_messages(scene, mesh)) table.notes.push_back(std::move(note));
    if (scene.mesh.file) table.notes.push_back(import_note(scene, fe2d::import_mesh(scene, extension).summary));
    if (!arguments.out.empty()) {
        const auto version = arguments.format == "2.2" ? fe2d::GmshVersion::v2_2 : fe2d::GmshVersion::v4_1;
        const fe2d::Mesh corners = fe2d::build_mesh(of_first_order(scene), extension);
        write_file(arguments.out, fe2d::gmsh_text(fe2d::export_mesh(corners, base_nodes(arguments, corners)), version));
        table.notes.push_back(fmt::format("written: {} (Gmsh {})", arguments.out.string(), arguments.format));
    }
    Answer answer(json_header("mesh", given));
    answer += given.title + "\n\n";
    answer.add("mesh", table, {.brief = true});
    answer.headline_in_brief({fmt::format("{} nodes, {} elements, edges from {:.3g} to {:.3g} m.", mesh.nodes.size(),
                                          mesh.element_count(), quality.smallest_edge, quality.largest_edge)});
    answer.set("notes", note_texts(given.notes));
    for (const std::string& note : table.notes) answer.note_in_brief(note);
    put_answer(std::move(answer), "--out FILE.msh", streams);
    return exit_ok;
}

void mesh_flags(CLI::App& sub, MeshArguments& a)
{
    add_scene(sub, a.inputs);
    add_plane(sub, a.inputs);
    add_out(
        sub, a.out, OutputPath::file,
        "Gmsh file (.msh, ASCII) with physical groups, as mesh.file reads it; deck for CalculiX with --to calculix");
    sub.add_option("--format", a.format, "version of the Gmsh file")
        ->check(CLI::IsMember({"2.2", "4.1"}))
        ->capture_default_str();
    sub.add_option("--base", a.base, "nodes between dam and rock in the Gmsh file: twice, or shared by both")
        ->check(CLI::IsMember({"twice", "shared"}))
        ->capture_default_str();
    sub.add_option("--to", a.to,
                   "for whom --out is: gmsh (the mesh), or calculix (mesh, materials, loads: a deck to run)")
        ->check(CLI::IsMember({"gmsh", "calculix"}))
        ->capture_default_str();
    sub.add_option("--analysis", a.analysis, "what CalculiX is to compute")
        ->check(CLI::IsMember({"modes", "tied", "static-contact"}))
        ->capture_default_str();
    sub.add_option("--modes", a.modes, "modes that CalculiX finds, or superposes in a tied run")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    sub.add_option("--results", a.results, "the .dat file that ccx made of the deck: our results beside its own")
        ->check(CLI::ExistingFile);
}

} // namespace

Command mesh_command(Carry<MeshArguments> calculix)
{
    const auto carry = [calculix](const MeshArguments& arguments, const Streams& streams) {
        return arguments.to == "calculix" ? calculix(arguments, streams) : mesh(arguments, streams);
    };
    return {"mesh", "the finite-element mesh of a scene: sizes and shapes; written for Gmsh or CalculiX",
            "damslip mesh examples/reference_dam.toml --out dam.msh", with_flags<MeshArguments>(mesh_flags, carry)};
}

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
    add_out(sub, a.out, OutputPath::file, "SVG file (.svg); without it the drawing goes to standard output", "-o,--out")
        ->check([](const std::string& path) -> std::string {
            const std::string end = std::filesystem::path(path).extension().string();
            if (!end.empty() && end != ".svg" && end != ".SVG") // a device or a pipe has none
                refuse_usage(fmt::format("--out {} is no SVG file.", path), "a file that ends in .svg",
                             "write  " + std::filesystem::path(path).replace_extension(".svg").string() +
                                 " , and convert it with another program");
            return {};
        });
}

} // namespace

Command draw_command()
{
    return {"draw", "the section of a scene as SVG: water, uplift, curtain, drains, signs",
            "damslip draw examples/reference_dam.toml --out dam.svg", with_flags<DrawArguments>(draw_flags, draw)};
}

namespace {

constexpr double ratio_of_files = 0.05; ///< damping that the spectra of files are for [-]

std::function<double(double)> scaled(const records::TargetSpectrum& shape, double pga)
{
    return [shape, pga](double period) { return pga * shape.amplification(period); };
}

} // namespace

void check_spectrum_level(const SpectrumArguments& a, bool has_records)
{
    if (a.wanted && a.horizontal.empty() && !has_records)
        refuse_usage("--response-spectrum without a record.", "a record, or a spectrum",
                     "add  --record FILE , or  --spectrum FILE --spectrum-pga 1.0");
}

std::vector<LevelSpectrum> given_spectra(const SpectrumArguments& a)
{
    if (!a.wanted || a.horizontal.empty()) return {};
    const records::TargetSpectrum shape = records::read_target_spectrum(a.horizontal);
    LevelSpectrum spectrum{shape.name, ratio_of_files, scaled(shape, *a.pga)};
    if (!a.vertical.empty()) spectrum.vertical = scaled(records::read_target_spectrum(a.vertical), *a.vertical_pga);
    return {std::move(spectrum)};
}

std::shared_ptr<const SpectrumLevel> find_spectrum_level(const SpectrumArguments& a,
                                                         const std::vector<LevelSpectrum>& given, const Ready& ready)
{
    if (!a.wanted) return nullptr;
    check_spectrum_level(a, !ready.records().empty());
    return std::make_shared<const SpectrumLevel>(spectrum_level(ready, given));
}

namespace {

struct CalibrateArguments {
    RunInputs inputs;
    std::optional<double> frequency, empty, second; ///< first with the scene's water, and without; second mode [Hz]
    std::vector<std::string> at;                    ///< "94=3.47": level and first frequency
    double scatter = 0.02;
    std::optional<double> damping;
    std::filesystem::path out;
};

constexpr double lowest = 0.1, highest = 100.0; // [Hz]

/// "94=3.47". @throws UsageError
MeasuredFrequency measured_at(const std::string& text)
{
    const std::size_t equals = text.find('=');
    const auto level = parse_whole_number_text(text.substr(0, equals));
    const auto frequency =
        equals == std::string::npos ? std::nullopt : parse_whole_number_text(text.substr(equals + 1));
    if (!level || !frequency || !(*frequency >= lowest && *frequency <= highest))
        refuse_usage(fmt::format("--at {} is no water level with a frequency.", text),
                     fmt::format("metres above the heel, \"=\", a frequency of {:g} to {:g} Hz", lowest, highest),
                     "write  --at 94=3.47");
    return {*frequency, *level, 1};
}

std::vector<MeasuredFrequency> measured(const CalibrateArguments& a)
{
    std::vector<MeasuredFrequency> all;
    if (a.frequency) all.push_back({*a.frequency, {}, 1});
    for (const std::string& text : a.at) all.push_back(measured_at(text));
    if (a.empty) all.push_back({*a.empty, 0.0, 1});
    if (a.second) all.push_back({*a.second, {}, 2});
    if (a.frequency && a.second && *a.second <= *a.frequency)
        refuse_usage(fmt::format("--second {:g} is not above --frequency {:g}.", *a.second, *a.frequency),
                     "the second frequency of the dam, above the first", "exchange them, or leave --second out");
    if (all.empty())
        refuse_usage("no frequency is given.", "--frequency, or --at LEVEL=FREQUENCY, --frequency-empty, --second",
                     "add  --frequency 3.47");
    return all;
}

int calibrate_scene(const CalibrateArguments& arguments, const Streams& streams)
{
    const std::vector<MeasuredFrequency> frequencies = measured(arguments);
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip calibrate", "a wedge is rigid; damslip screen SCENE gives its slip");
    const Calibration c = calibrate(given, {frequencies, arguments.scatter, arguments.damping, streams.stop});
    put_answer(pages::calibration_answer(given, c), arguments.out.empty() ? "--out FILE" : "", streams);
    if (!arguments.out.empty()) pages::write_calibrated(arguments.out, c);
    return exit_ok;
}

void calibrate_flags(CLI::App& sub, CalibrateArguments& a)
{
    add_scene(sub, a.inputs);
    const CLI::Validator hertz = in_range(lowest, highest);
    sub.add_option("--frequency", a.frequency, "first frequency measured with the water of the scene [Hz]")
        ->check(hertz);
    sub.add_option("--at", a.at,
                   "first frequency at another water level: metres above the heel, =, Hz, as 94=3.47; repeated");
    sub.add_option("--frequency-empty", a.empty, "first frequency without water [Hz]")->check(hertz);
    sub.add_option("--second", a.second, "second frequency with the water of the scene [Hz]")->check(hertz);
    sub.add_option("--scatter", a.scatter, "standard deviation of a measured frequency over it")
        ->check(in_range(1e-4, 0.5))
        ->capture_default_str();
    sub.add_option("--damping", a.damping,
                   "damping ratio measured in the first mode, waves into rock and water included; sets damping.ratio")
        ->check(in_range(0.002, 0.3));
    add_out(sub, a.out, OutputPath::file, "scene file with the values found and all defaults");
}

} // namespace

Command calibrate_command()
{
    return {"calibrate", "moduli and damping from measured frequencies; their laws for fragility",
            "damslip calibrate examples/own_dam.toml --frequency 3.5",
            with_flags<CalibrateArguments>(calibrate_flags, calibrate_scene)};
}

} // namespace damslip::cli
