#include "cli/flags.hpp"
#include "cli/record_command.hpp"

namespace damslip::cli {

namespace {

/// What was typed of a command that reads a record and writes one.
template <class Arguments>
struct Filter {
    Arguments arguments;
    std::string form; ///< --to
};

struct RecordInfoFlags {
    std::vector<std::filesystem::path> files;
    RecordInput reading; ///< of all files
};

void add_reading(CLI::App& sub, RecordInput& in)
{
    sub.add_option("--units", in.unit, "unit of files that do not say: g, m/s2, cm/s2, gal, mg, mm/s2")
        ->group("Reading");
    sub.add_option("--dt", in.dt, "time step of files without one [s]")->group("Reading");
    sub.add_option("--column", in.column, "heading or number of the acceleration column where a file holds several")
        ->group("Reading");
    sub.add_flag("--resample", in.resample, "interpolate uneven times")->group("Reading");
}

void add_input(CLI::App& sub, RecordInput& in)
{
    sub.add_option("FILE", in.file, "accelerogram, recognised by its content")->required();
    add_reading(sub, in);
}

void add_target(CLI::App& sub, RecordTarget& target, std::string& form)
{
    add_out(sub, target.out, OutputPath::file, "file; without it: standard output", "-o,--out");
    sub.add_option("--to", form, "csv, csv-time or at2; default: by the ending of --out");
}

Command info_command()
{
    const auto flags = [](CLI::App& sub, RecordInfoFlags& a) {
        sub.add_option("FILE", a.files, "accelerograms")->required();
        add_reading(sub, a.reading);
    };
    const auto run = [](const RecordInfoFlags& a, const Streams& streams) {
        RecordInfoArguments arguments;
        for (const auto& file : a.files) {
            arguments.inputs.push_back(a.reading);
            arguments.inputs.back().file = file;
        }
        return record_info(arguments, streams);
    };
    return {"info", "PGA, PGV, PGD, Arias intensity, CAV, durations, mean period, warnings",
            "damslip record info records/data/rock_1.0_h.csv records/data/rock_1.0_v.csv",
            with_flags<RecordInfoFlags>(flags, run)};
}

/// Command::declare of a command that reads a record and writes one. @param more  its own flags
template <class Arguments>
std::function<Run(CLI::App&)> with_filter_flags(void (*more)(CLI::App&, Arguments&),
                                                int (*run)(const Arguments&, const Streams&))
{
    const auto flags = [more](CLI::App& sub, Filter<Arguments>& a) {
        add_input(sub, a.arguments.input);
        add_target(sub, a.arguments.target, a.form);
        more(sub, a.arguments);
    };
    const auto run_filter = [run](const Filter<Arguments>& a, const Streams& streams) {
        Arguments arguments = a.arguments;
        arguments.target.form = record_output(a.form, arguments.target.out);
        return run(arguments, streams);
    };
    return with_flags<Filter<Arguments>>(flags, run_filter);
}

void convert_flags(CLI::App& sub, RecordConvertArguments& a)
{
    sub.add_option("--new-dt", a.new_dt, "another time step [s]");
}

void baseline_flags(CLI::App& sub, RecordBaselineArguments& a)
{
    sub.add_option("--degree", a.degree, "constant, linear or quadratic")->capture_default_str();
    sub.add_option("--fit", a.fit, "velocity or acceleration")->capture_default_str();
}

void scale_flags(CLI::App& sub, RecordScaleArguments& a)
{
    sub.add_option("--factor", a.factor, "factor; negative flips the polarity");
    sub.add_option("--pga-m-s2", a.pga_m_s2, "peak acceleration to reach [m/s2]");
}

void spectrum_flags(CLI::App& sub, RecordSpectrumArguments& a)
{
    add_input(sub, a.input);
    add_out(sub, a.out, OutputPath::file, "CSV file; without it a table on standard output", "-o,--out");
    sub.add_option("--damping", a.ratio, "damping ratio")->capture_default_str();
    sub.add_option("--from", a.from, "first period [s]")->capture_default_str();
    sub.add_option("--to", a.to, "last period [s]")->capture_default_str();
    sub.add_option("--count", a.count, "number of periods")->capture_default_str();
}

void generate_flags(CLI::App& sub, Filter<RecordGenerateArguments>& filter)
{
    RecordGenerateArguments& g = filter.arguments;
    sub.add_option("--target", g.target, "rock, ec8-1, ec8-2, or a CSV file of period [s] and spectral acceleration")
        ->capture_default_str();
    sub.add_option("--ground", g.ground, "Eurocode 8 ground type A ... E")->capture_default_str();
    sub.add_option("--component", g.component, "h or v: each has its own random stream")->capture_default_str();
    sub.add_option("--pga-m-s2", g.options.pga, "peak ground acceleration [m/s2]")->capture_default_str();
    sub.add_option("--duration", g.options.duration, "[s]")->capture_default_str();
    sub.add_option("--dt", g.options.dt, "time step [s]")->capture_default_str();
    sub.add_option("--seed", g.seed, "random seed, a whole number >= 0")->capture_default_str();
    sub.add_option("--tolerance", g.options.tolerance, "largest deviation from the target over 0.05 to 2 s")
        ->capture_default_str();
    sub.add_option("--envelope", g.envelope, "compound or trapezoid")->capture_default_str();
    sub.add_option("--rise", g.options.envelope.rise, "end of the rise, share of the duration")->capture_default_str();
    sub.add_option("--level", g.options.envelope.level, "end of the strong part, share of the duration")
        ->capture_default_str();
    add_target(sub, g.destination, filter.form);
}

void suite_flags(CLI::App& sub, RecordSuiteArguments& a)
{
    sub.add_option("RECORDS", a.patterns, "a folder, a pattern in quotes, or a CSV with the column horizontal")
        ->required();
    sub.add_option("--target-spectrum", a.spectrum,
                   "rock, ec8-1, ec8-2, or a CSV file of period [s] and spectral acceleration; without it PGA alone");
    sub.add_option("--ground", a.ground, "Eurocode 8 ground type A ... E")->capture_default_str();
    sub.add_option("--target-pga-m-s2", a.pga, "PGA of the target [m/s2]");
    sub.add_option("--from", a.from, "first period of the band that is fitted [s]")->capture_default_str();
    sub.add_option("--to", a.to, "last period of it [s]")->capture_default_str();
    sub.add_option("--select", a.select, "how many records, of different events; default: all, each with its factor")
        ->check(CLI::Range(1, 100'000));
    sub.add_option("--max-scale", a.max_scale, "largest factor; the smallest is one over it")->capture_default_str();
    sub.add_flag("--match", a.match, "then match each by wavelets to the spectrum, over 0.05 to 2 s");
    sub.add_option("--tolerance", a.tolerance, "largest deviation of a matched spectrum")->capture_default_str();
    add_out(sub, a.out, OutputPath::file, "list of the records with their factors, for --records and [suite] files",
            "-o,--out");
}

int run_generate(const Filter<RecordGenerateArguments>& a, const Streams& streams)
{
    RecordGenerateArguments arguments = a.arguments;
    arguments.destination.form = record_output(a.form, arguments.destination.out);
    return record_generate(arguments, streams);
}

} // namespace

Command record_command()
{
    return {
        .name = "record",
        .description = "accelerograms: info, convert, baseline, scale, spectrum, generate, suite",
        .example = "damslip record info records/data/rock_1.0_h.csv",
        .below = {info_command(),
                  {"convert", "another file format or time step",
                   "damslip record convert records/data/rock_1.0_h.csv --out rock.at2",
                   with_filter_flags(convert_flags, record_convert)},
                  {"baseline", "remove a polynomial from acceleration or velocity",
                   "damslip record baseline records/data/rock_1.0_h.csv --degree quadratic --out rock.csv",
                   with_filter_flags(baseline_flags, record_baseline)},
                  {"scale", "multiply by a factor or to a peak",
                   "damslip record scale records/data/rock_1.0_h.csv --pga-m-s2 2.0 --out rock_2.csv",
                   with_filter_flags(scale_flags, record_scale)},
                  {"spectrum", "elastic response spectrum, exact for the piecewise-linear record",
                   "damslip record spectrum records/data/rock_1.0_h.csv --damping 0.05",
                   with_flags<RecordSpectrumArguments>(spectrum_flags, record_spectrum)},
                  {"generate", "artificial accelerogram that matches a response spectrum; same seed, same bytes",
                   "damslip record generate --target rock --pga-m-s2 1.0 --duration 20 --seed 2 --out rock.csv",
                   with_flags<Filter<RecordGenerateArguments>>(generate_flags, run_generate)},
                  {"suite", "measures of many records; those that fit a target, each with its factor",
                   "damslip record suite 'records/data/*.csv' --target-spectrum ec8-1 --target-pga-m-s2 2 --select 2 "
                   "--out suite.csv",
                   with_flags<RecordSuiteArguments>(suite_flags, record_suite)}}};
}

} // namespace damslip::cli
