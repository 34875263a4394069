#include "analysis/modes/calibrate.hpp"
#include "cli/command.hpp"
#include "core/file.hpp"
#include "core/status.hpp"
#include "core/text.hpp"
#include "pages/modes/modes_pages.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

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
