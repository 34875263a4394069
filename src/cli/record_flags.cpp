#include "cli/parser.hpp"

namespace damslip::cli {

namespace {

void add_reading(CLI::App* sub, RecordInput& in)
{
    sub->add_option("--units", in.unit, "unit of files that do not say: g, m/s2, cm/s2, gal, mg, mm/s2")
        ->group("Reading");
    sub->add_option("--dt", in.dt, "time step of files without one [s]")->group("Reading");
    sub->add_option("--column", in.column, "heading or number of the acceleration column where a file holds several")
        ->group("Reading");
    sub->add_flag("--resample", in.resample, "interpolate uneven times")->group("Reading");
}

void add_input(CLI::App* sub, RecordInput& in)
{
    sub->add_option("FILE", in.file, "accelerogram, recognised by its content")->required();
    add_reading(sub, in);
}

void add_target(CLI::App* sub, RecordTarget& target, std::string& form)
{
    sub->add_option("-o,--out", target.out, "file; without it: standard output")
        ->check(output_to(OutputPath::file, "--out"));
    sub->add_option("--to", form, "csv, csv-time or at2; default: by the ending of --out");
}

void add_info(CLI::App* record, ParserBase& base, RecordArguments& a)
{
    CLI::App* sub =
        add_command(*record, base, "info", "PGA, PGV, PGD, Arias intensity, CAV, durations, mean period, warnings",
                    "damslip record info ns.at2 up.at2");
    sub->add_option("FILE", a.info_files, "accelerograms")->required();
    a.info.inputs.resize(1);
    add_reading(sub, a.info.inputs.front());
    sub->callback([&] {
        base.chosen = [files = a.info_files, options = a.info.inputs.front()](const Streams& s) {
            RecordInfoArguments arguments;
            for (const auto& file : files) {
                arguments.inputs.push_back(options);
                arguments.inputs.back().file = file;
            }
            return record_info(arguments, s);
        };
    });
}

/// One command that reads a record and writes one.
template <class Arguments>
CLI::App* add_filter(CLI::App* record, ParserBase& base, RecordArguments& a, Arguments& arguments,
                     int (*run)(const Arguments&, const Streams&), const std::string& name,
                     const std::string& description, const std::string& example)
{
    CLI::App* sub = add_command(*record, base, name, description, example);
    add_input(sub, arguments.input);
    add_target(sub, arguments.target, a.form);
    sub->callback([&base, &a, &arguments, run] {
        Arguments copy = arguments;
        copy.target.form = record_output(a.form, copy.target.out);
        base.chosen = [copy, run](const Streams& s) { return run(copy, s); };
    });
    return sub;
}

void add_spectrum(CLI::App* record, ParserBase& base, RecordArguments& a)
{
    RecordSpectrumArguments& s = a.spectrum;
    CLI::App* sub =
        add_command(*record, base, "spectrum", "elastic response spectrum, exact for the piecewise-linear record",
                    "damslip record spectrum ns.at2 --damping 0.05");
    add_input(sub, s.input);
    sub->add_option("-o,--out", s.out, "CSV file; without it a table on standard output")
        ->check(output_to(OutputPath::file, "--out"));
    sub->add_option("--damping", s.ratio, "damping ratio")->capture_default_str();
    sub->add_option("--from", s.from, "first period [s]")->capture_default_str();
    sub->add_option("--to", s.to, "last period [s]")->capture_default_str();
    sub->add_option("--count", s.count, "number of periods")->capture_default_str();
    sub->callback(
        [&] { base.chosen = [copy = a.spectrum](const Streams& streams) { return record_spectrum(copy, streams); }; });
}

void add_generate(CLI::App* record, ParserBase& base, RecordArguments& a)
{
    RecordGenerateArguments& g = a.generate;
    CLI::App* sub = add_command(
        *record, base, "generate", "artificial accelerogram that matches a response spectrum; same seed, same bytes",
        "damslip record generate --target rock --pga-m-s2 1.0 --duration 20 --seed 2 --out rock.csv");
    sub->add_option("--target", g.target, "rock, ec8-1, ec8-2, or a CSV file of period [s] and spectral acceleration")
        ->capture_default_str();
    sub->add_option("--ground", g.ground, "Eurocode 8 ground type A ... E")->capture_default_str();
    sub->add_option("--component", g.component, "h or v: each has its own random stream")->capture_default_str();
    sub->add_option("--pga-m-s2", g.options.pga, "peak ground acceleration [m/s2]")->capture_default_str();
    sub->add_option("--duration", g.options.duration, "[s]")->capture_default_str();
    sub->add_option("--dt", g.options.dt, "time step [s]")->capture_default_str();
    sub->add_option("--seed", g.seed, "random seed, a whole number >= 0")->capture_default_str();
    sub->add_option("--tolerance", g.options.tolerance, "largest deviation from the target over 0.05 to 2 s")
        ->capture_default_str();
    sub->add_option("--envelope", g.envelope, "compound or trapezoid")->capture_default_str();
    sub->add_option("--rise", g.options.envelope.rise, "end of the rise, share of the duration")->capture_default_str();
    sub->add_option("--level", g.options.envelope.level, "end of the strong part, share of the duration")
        ->capture_default_str();
    add_target(sub, g.destination, a.form);
    sub->callback([&] {
        RecordGenerateArguments copy = a.generate;
        copy.destination.form = record_output(a.form, copy.destination.out);
        base.chosen = [copy](const Streams& streams) { return record_generate(copy, streams); };
    });
}

} // namespace

void add_record_commands(CLI::App& app, ParserBase& base, RecordArguments& a)
{
    CLI::App* record =
        app.add_subcommand("record", "accelerograms: info, convert, baseline, scale, spectrum, generate");
    record->require_subcommand(1);
    record->footer("Example:\n  damslip record info ns.at2");
    add_info(record, base, a);
    add_filter(record, base, a, a.convert, record_convert, "convert", "another file format or time step",
               "damslip record convert ns.at2 --out ns.csv")
        ->add_option("--new-dt", a.convert.new_dt, "another time step [s]");
    CLI::App* baseline = add_filter(record, base, a, a.baseline, record_baseline, "baseline",
                                    "remove a polynomial from acceleration or velocity",
                                    "damslip record baseline ns.at2 --degree quadratic --out ns.csv");
    baseline->add_option("--degree", a.baseline.degree, "constant, linear or quadratic")->capture_default_str();
    baseline->add_option("--fit", a.baseline.fit, "velocity or acceleration")->capture_default_str();
    CLI::App* scale = add_filter(record, base, a, a.scale, record_scale, "scale", "multiply by a factor or to a peak",
                                 "damslip record scale ns.at2 --pga-m-s2 1.0 --out ns_1.csv");
    scale->add_option("--factor", a.scale.factor, "factor; negative flips the polarity");
    scale->add_option("--pga-m-s2", a.scale.pga_m_s2, "peak acceleration to reach [m/s2]");
    add_spectrum(record, base, a);
    add_generate(record, base, a);
}

} // namespace damslip::cli
