#include "cli/record_command.hpp"

#include "analysis/suite/record_suite.hpp"
#include "cli/command.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "pages/record/record_tables.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/table_text.hpp"
#include "records/generate/wavelet_match.hpp"
#include "records/measure/measures.hpp"
#include "records/record.hpp"
#include "records/transform/transform.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

/// The value that belongs to a word. @throws UsageError listing the words.
template <class T>
T choice(const std::string& flag, const std::string& word, const std::vector<std::pair<std::string, T>>& values)
{
    std::string all;
    for (const auto& [name, value] : values) {
        if (name == word) return value;
        all += (all.empty() ? "" : ", ") + name;
    }
    refuse_usage(fmt::format("{} {} is not known.", flag, word), all,
                 fmt::format("write  {} {}", flag, values.front().first));
}

void remark(const Record& record, const Streams& streams)
{
    if (streams.quiet) return;
    for (const std::string& warning : record.warnings) streams.talk << record.name << ": " << warning << "\n";
}

std::string text_of(const Record& record, RecordOutput form)
{
    if (form == RecordOutput::at2) return records::record_at2(record);
    return form == RecordOutput::csv ? records::record_csv(record) : records::record_csv_with_time(record);
}

/// To its file, or to standard output; a JSON object instead names file and measures.
void put(const Record& record, const RecordTarget& target, const std::string& what, const Streams& streams)
{
    remark(record, streams);
    const std::string text = text_of(record, record_output(target.to, target.out));
    if (!target.out.empty()) write_file(target.out, text);
    if (streams.form == Form::json) {
        auto j = json_header(what);
        j["out"] = target.out.string();
        j["sha256"] = sha256(text);
        j["record"] = json_of(record_info_table({record}, Checksums::shown))[0];
        streams.out << j.dump(2) << "\n";
    } else if (target.out.empty()) {
        streams.out << text;
    } else if (!streams.quiet) {
        streams.talk << fmt::format("{}: {} samples, dt = {} s\n", target.out.string(), record.acceleration.size(),
                                    record.dt);
    }
}

records::ReadOptions options_of(const RecordInput& input)
{
    return {input.unit, input.dt, input.resample ? records::UnevenTime::resample : records::UnevenTime::refuse,
            input.column};
}

/// All channels of an agency's file. The columns of a table may be anything: one of them is to be chosen.
std::vector<Record> channels_of(const RecordInput& input)
{
    std::vector<Record> channels = records::parse_record(read_file(input.file), input.file.string(), options_of(input));
    const std::string& format = channels.front().source.format;
    if (channels.size() > 1 && (format == "CSV" || format == "columns")) return {read(input)};
    for (Record& channel : channels)
        if (channels.size() > 1)
            channel.name += "-" + channel.source.component.substr(0, channel.source.component.find_first_of(" ,"));
    return channels;
}

} // namespace

Record read(const RecordInput& input)
{
    return records::read_record(input.file, options_of(input));
}

RecordOutput record_output(const std::string& word, const std::filesystem::path& out)
{
    const bool at2 = out.extension() == ".at2" || out.extension() == ".AT2";
    if (word.empty()) return at2 ? RecordOutput::at2 : RecordOutput::csv;
    return choice<RecordOutput>(
        "--to", word,
        {{"csv", RecordOutput::csv}, {"csv-time", RecordOutput::csv_with_time}, {"at2", RecordOutput::at2}});
}

int record_info(const RecordInfoArguments& arguments, const Streams& streams)
{
    std::vector<Record> records;
    RecordInput input = arguments.reading;
    for (const auto& file : arguments.files) {
        input.file = file;
        for (Record& record : channels_of(input)) records.push_back(std::move(record));
    }
    const Table table = record_info_table(records, Checksums::shown);
    Answer answer(json_header("record-info"));
    answer.add("records", table, {.text = false});
    answer.add("for_people", record_info_table(records, Checksums::left_out), {.brief = true, .data = false});
    answer.set("notes", table.notes);
    double peak = 0.0;
    for (const Record& record : records)
        for (const double a : record.acceleration) peak = std::max(peak, std::abs(a));
    answer.headline_in_brief({fmt::format("{} accelerogram{}, at most {:.4g} m/s².", records.size(),
                                          records.size() == 1 ? "" : "s", peak)});
    for (const std::string& note : table.notes) answer.note_in_brief(note);
    put_answer(std::move(answer), "", streams);
    return exit_ok;
}

int record_convert(const RecordConvertArguments& arguments, const Streams& streams)
{
    Record record = read(arguments.input);
    if (arguments.new_dt) {
        if (!(*arguments.new_dt >= 1e-6 && *arguments.new_dt <= 1.0))
            refuse_usage(fmt::format("--new-dt {} is not allowed.", *arguments.new_dt), "1e-06 to 1 s",
                         "write seconds");
        record = records::resampled(record, *arguments.new_dt);
    }
    put(record, arguments.target, "record-convert", streams);
    return exit_ok;
}

int record_baseline(const RecordBaselineArguments& arguments, const Streams& streams)
{
    using namespace records;
    const BaselineOptions options{
        choice<BaselineDegree>("--degree", arguments.degree,
                               {{"quadratic", BaselineDegree::quadratic},
                                {"linear", BaselineDegree::linear},
                                {"constant", BaselineDegree::constant}}),
        choice<BaselineFit>("--fit", arguments.fit,
                            {{"velocity", BaselineFit::velocity}, {"acceleration", BaselineFit::acceleration}})};
    const Record before = read(arguments.input);
    BaselineResult result = baseline_corrected(before, options);
    const Measures was = measure(before), is = measure(result.record);
    std::string polynomial;
    for (std::size_t p = 0; p < result.coefficients.size(); ++p)
        polynomial += fmt::format("{}{:.4g}{}", p ? " + " : "", result.coefficients[p],
                                  p == 0   ? ""
                                  : p == 1 ? " x"
                                           : " x^2");
    result.record.warnings = {fmt::format(
        "baseline {} m/s2 (x = t/duration) taken off: PGA {:.4g} to {:.4g} m/s2, final velocity {:.3g} to {:.3g} m/s, "
        "final displacement {:.3g} to {:.3g} m",
        polynomial, was.pga, is.pga, was.final_velocity, is.final_velocity, was.final_displacement,
        is.final_displacement)};
    put(result.record, arguments.target, "record-baseline", streams);
    return exit_ok;
}

int record_scale(const RecordScaleArguments& arguments, const Streams& streams)
{
    if (arguments.factor.has_value() == arguments.pga_m_s2.has_value())
        refuse_usage("record scale needs one of --factor and --pga-m-s2.", "one of them",
                     "write  --factor 1.5  or  --pga-m-s2 2.0");
    if (arguments.factor && (!std::isfinite(*arguments.factor) || *arguments.factor == 0.0))
        refuse_usage(fmt::format("--factor {} is not allowed.", *arguments.factor),
                     "a number other than 0; negative flips the polarity", "write  --factor 1.5");
    if (arguments.pga_m_s2 && !(*arguments.pga_m_s2 > 0.0 && *arguments.pga_m_s2 <= 1e4))
        refuse_usage(fmt::format("--pga-m-s2 {} is not allowed.", *arguments.pga_m_s2),
                     "a number > 0, at most 1e4 m/s2", "write  --pga-m-s2 2.0");
    Record record = read(arguments.input);
    const double factor = arguments.factor ? *arguments.factor : records::factor_to_pga(record, *arguments.pga_m_s2);
    record = records::scaled(std::move(record), factor);
    record.warnings.push_back(fmt::format("scaled by {:.6g}", factor));
    put(record, arguments.target, "record-scale", streams);
    return exit_ok;
}

records::ResponseSpectrum record_spectrum_of(const Record& record, const RecordSpectrumArguments& a)
{
    if (!(a.ratio >= 0.0 && a.ratio <= 1.0))
        refuse_usage(fmt::format("--damping {} is not allowed.", a.ratio), "0 to 1", "5 % is 0.05");
    if (!(a.from > 0.0 && a.to > a.from && a.to <= 100.0))
        refuse_usage(fmt::format("--from {} --to {} is not allowed.", a.from, a.to), "0 < from < to <= 100 s",
                     "write seconds");
    if (a.count < 2 || a.count > 10000)
        refuse_usage(fmt::format("--count {} is not allowed.", a.count), "2 to 10000", "leave it out");
    const auto periods = records::logarithmic_periods(a.from, a.to, a.count);
    return records::response_spectrum(record.acceleration, record.dt, periods, a.ratio);
}

int record_spectrum(const RecordSpectrumArguments& arguments, const Streams& streams)
{
    const Record record = read(arguments.input);
    remark(record, streams);
    const records::ResponseSpectrum spectrum = record_spectrum_of(record, arguments);
    const Table table = spectrum_table(record, spectrum, arguments.ratio);
    if (!arguments.out.empty()) write_file(arguments.out, csv(table, {table.title}));
    Answer answer(json_header("record-spectrum"));
    answer.set("damping_ratio", arguments.ratio);
    answer.add("points", table, {.brief = true});
    const records::SpectrumPoint& peak =
        *std::ranges::max_element(spectrum.points, {}, &records::SpectrumPoint::pseudo_acceleration);
    answer.headline_in_brief({fmt::format("{}: at most {:.4g} m/s² (PSA), at a period of {:.4g} s.", table.title,
                                          peak.pseudo_acceleration, peak.period)});
    if (streams.form == Form::json || arguments.out.empty()) put_answer(std::move(answer), "--out FILE.csv", streams);
    return exit_ok;
}

records::TargetSpectrum generate_target(const RecordGenerateArguments& arguments)
{
    using namespace records;
    const auto component = choice<MotionComponent>(
        "--component", arguments.component, {{"h", MotionComponent::horizontal}, {"v", MotionComponent::vertical}});
    const auto ground = choice<GroundType>(
        "--ground", arguments.ground,
        {{"A", GroundType::A}, {"B", GroundType::B}, {"C", GroundType::C}, {"D", GroundType::D}, {"E", GroundType::E}});
    const auto target = find_target_spectrum(arguments.target, arguments.target, ground, component);
    if (!target)
        refuse_usage(fmt::format("--target {} is not known.", arguments.target),
                     "rock, ec8-1, ec8-2, or a CSV file of period [s] and spectral acceleration",
                     "write  --target rock");
    return *target;
}

records::GeneratedRecord generate(const RecordGenerateArguments& arguments)
{
    using namespace records;
    const TargetSpectrum target = generate_target(arguments);
    if (arguments.seed < 0)
        refuse_usage(fmt::format("--seed {} is not allowed.", arguments.seed),
                     "a whole number from 0 to 9223372036854775807", "write  --seed 1");
    if (!(arguments.options.pga >= 1e-3 && arguments.options.pga <= 50.0))
        refuse_usage(fmt::format("--pga-m-s2 {} is not allowed.", arguments.options.pga), "0.001 to 50 m/s2",
                     "write  --pga-m-s2 1.0");
    GenerateOptions options = arguments.options;
    options.seed = static_cast<std::uint64_t>(arguments.seed);
    options.component = arguments.component == "v" ? MotionComponent::vertical : MotionComponent::horizontal;
    options.envelope.shape =
        choice<EnvelopeShape>("--envelope", arguments.envelope,
                              {{"compound", EnvelopeShape::compound}, {"trapezoid", EnvelopeShape::trapezoid}});
    GeneratedRecord result = generate_record(target, options);
    if (!arguments.destination.out.empty()) result.record.name = arguments.destination.out.stem().string();
    return result;
}

int record_generate(const RecordGenerateArguments& arguments, const Streams& streams)
{
    record_output(arguments.destination.to, arguments.destination.out); // refused before anything is made
    const records::GeneratedRecord result = generate(arguments);
    if (!streams.quiet)
        streams.talk << fmt::format(
            "{}\nspectrum within {:.1f} % of its target over {} to {} s (worst at {:.3g} s, {} passes)\n",
            result.record.source.title, 100.0 * result.worst_deviation, records::matched_from, records::matched_to,
            result.worst_period, result.passes);
    put(result.record, arguments.destination, "record-generate", streams);
    return result.within_tolerance ? exit_ok : exit_no_answer;
}

namespace {

void add_reading(CLI::App& sub, RecordInput& in)
{
    sub.option_defaults()->group("Reading");
    sub.add_option("--units", in.unit, "unit of files that do not say: g, m/s2, cm/s2, gal, mg, mm/s2");
    sub.add_option("--dt", in.dt, "time step of files without one [s]");
    sub.add_option("--column", in.column, "heading or number of the acceleration column where a file holds several");
    sub.add_flag("--resample", in.resample, "interpolate uneven times");
    sub.option_defaults()->group("Options");
}

void add_input(CLI::App& sub, RecordInput& in)
{
    sub.add_option("FILE", in.file, "accelerogram, recognised by its content")->required();
    add_reading(sub, in);
}

void add_target(CLI::App& sub, RecordTarget& target)
{
    add_out(sub, target.out, OutputPath::file, "file; without it: standard output", "-o,--out");
    sub.add_option("--to", target.to, "csv, csv-time or at2; default: by the ending of --out");
}

void info_flags(CLI::App& sub, RecordInfoArguments& a)
{
    sub.add_option("FILE", a.files, "accelerograms")->required();
    add_reading(sub, a.reading);
}

/// Command::declare of a command that reads a record and writes one. @param more  its own flags
template <class Arguments>
std::function<Run(CLI::App&)> with_filter_flags(void (*more)(CLI::App&, Arguments&),
                                                int (*run)(const Arguments&, const Streams&))
{
    const auto flags = [more](CLI::App& sub, Arguments& a) {
        add_input(sub, a.input);
        add_target(sub, a.target);
        more(sub, a);
    };
    const auto run_filter = [run](const Arguments& a, const Streams& streams) {
        record_output(a.target.to, a.target.out); // refused before anything is read
        return run(a, streams);
    };
    return with_flags<Arguments>(flags, run_filter);
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

void generate_flags(CLI::App& sub, RecordGenerateArguments& g)
{
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
    add_target(sub, g.destination);
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

} // namespace

Command record_command()
{
    return {
        .name = "record",
        .description = "accelerograms: info, convert, baseline, scale, spectrum, generate, suite",
        .example = "damslip record info records/data/rock_1.0_h.csv",
        .below = {{"info", "PGA, PGV, PGD, Arias intensity, CAV, durations, mean period, warnings",
                   "damslip record info records/data/rock_1.0_h.csv records/data/rock_1.0_v.csv",
                   with_flags<RecordInfoArguments>(info_flags, record_info)},
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
                   with_flags<RecordGenerateArguments>(generate_flags, record_generate)},
                  {"suite", "measures of many records; those that fit a target, each with its factor",
                   "damslip record suite 'records/data/*.csv' --target-spectrum ec8-1 --target-pga-m-s2 2 --select 2 "
                   "--out suite.csv",
                   with_flags<RecordSuiteArguments>(suite_flags, record_suite)}}};
}

namespace {

void check_suite(const RecordSuiteArguments& a)
{
    if (a.patterns.size() != 1)
        refuse_usage(fmt::format("record suite has {} patterns.", a.patterns.size()), "one folder, pattern or list",
                     "put a pattern in quotes:  damslip record suite 'suite/*.AT2'");
    const auto in_range = [](const char* flag, double value, double low, double high, const char* unit) {
        if (!(value >= low && value <= high))
            refuse_usage(fmt::format("{} {} is not allowed.", flag, value), fmt::format("{} to {}{}", low, high, unit),
                         "correct it");
    };
    if (a.pga) in_range("--target-pga-m-s2", *a.pga, 1e-3, 50.0, " m/s2");
    in_range("--max-scale", a.max_scale, 1.0, 1000.0, "");
    in_range("--from", a.from, 0.01, 10.0, " s");
    in_range("--to", a.to, 0.01, 10.0, " s");
    in_range("--tolerance", a.tolerance, 0.01, 0.5, "");
    if (!(a.from < a.to))
        refuse_usage(fmt::format("--from {} --to {} is not allowed.", a.from, a.to), "a band, from the shorter period",
                     "for example  --from 0.05 --to 2");
    if (!a.spectrum.empty() && !a.pga)
        refuse_usage("--target-spectrum without --target-pga-m-s2.", "both: of a spectrum only its shape counts",
                     "add  --target-pga-m-s2 2.0");
    if (a.select && !a.pga)
        refuse_usage("--select without a target.", "--target-pga-m-s2, and --target-spectrum for a whole spectrum",
                     "add  --target-pga-m-s2 2.0");
    if (a.match && a.spectrum.empty())
        refuse_usage("--match without --target-spectrum.", "both", "add  --target-spectrum rock");
    if (a.match && a.out.empty())
        refuse_usage("--match without --out.", "a list; the matched records go beside it",
                     "add  --out suite/suite.csv");
}

/// Matches the records of the lines, writes them beside the list and puts them in its lines.
/// @returns whether all are within the tolerance
bool match_lines(const RecordSuiteArguments& a, const RecordSuite& suite, const FittedSuite& fit,
                 const SuiteTarget& target, std::vector<SuiteLine>& lines, std::vector<std::string>& notes)
{
    bool good = true;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const records::ChosenRecord& chosen = fit.selection.chosen[i];
        const std::string& name = suite.rows[chosen.record].name;
        const MatchedMember member = match_member(suite, chosen, target, a.tolerance);
        const records::GeneratedRecord& matched = member.horizontal;
        good &= matched.within_tolerance;
        const std::filesystem::path file = a.out.parent_path() / (name + "_matched.csv");
        write_file(file, records::record_csv(matched.record));
        notes.push_back(fmt::format(
            "{}: scaled by {:.4g}, then matched: spectrum within {:.1f} % (worst at {:.3g} s, {} passes); Arias {:.3g} "
            "to {:.3g} m/s, PGV {:.3g} to {:.3g} m/s; {}{}",
            name, chosen.factor, 100.0 * matched.worst_deviation, matched.worst_period, matched.passes,
            member.before.arias_intensity, member.after.arias_intensity, member.before.pgv, member.after.pgv,
            file.string(),
            member.vertical ? "; its vertical component is scaled by the same factor and not matched" : ""));
        lines[i].horizontal = file;
        lines[i].column.clear();
        lines[i].other_horizontal.reset(); // not matched
        if (member.vertical) {
            lines[i].vertical = a.out.parent_path() / (name + "_scaled_v.csv");
            lines[i].vertical_column.clear();
            write_file(*lines[i].vertical, records::record_csv(*member.vertical));
        }
        lines[i].scale = 1.0;
    }
    return good;
}

/// @throws UsageError, InputError for a spectrum that is not known
SuiteTarget target_of(const RecordSuiteArguments& a)
{
    SuiteTarget target{*a.pga, {}, a.from, a.to};
    if (a.spectrum.empty()) return target;
    RecordGenerateArguments words;
    words.target = a.spectrum;
    words.ground = a.ground;
    target.spectrum = generate_target(words);
    return target;
}

} // namespace

int record_suite(const RecordSuiteArguments& a, const Streams& streams)
{
    check_suite(a);
    std::optional<SuiteTarget> target;
    if (a.pga) target = target_of(a);
    RecordSuite suite = read_suite(a.patterns.front());
    if (!suite.list.made.empty()) streams.remark(suite.list.made);
    std::vector<Table> tables{suite_index_table(suite.rows)};
    std::vector<std::string> names{"records"}, notes = suite.list.notes, comments{"damslip record suite"};
    std::vector<SuiteLine> lines;
    bool good = true;
    if (target) {
        const std::optional<std::size_t> select =
            a.select ? std::optional(static_cast<std::size_t>(*a.select)) : std::nullopt;
        const FittedSuite fit = fit_suite(suite, *target, select, a.max_scale);
        for (const records::ChosenRecord& c : fit.selection.chosen)
            lines.push_back(line_of(suite.list, c.record, c.factor));
        tables.push_back(suite_selection_table(suite.rows, fit.selection));
        names.emplace_back("selected");
        comments.push_back(fmt::format("target {}, PGA {} m/s2{}", target->spectrum ? target->spectrum->name : "PGA",
                                       *a.pga, target->spectrum ? fmt::format(", {} to {} s", a.from, a.to) : ""));
        if (target->spectrum) {
            tables.push_back(suite_spectrum_table(fit.periods, fit.target, fit.spectra, fit.selection));
            names.emplace_back("spectra");
        }
        if (a.match) good = match_lines(a, suite, fit, *target, lines, notes);
    } else {
        for (std::size_t i = 0; i < suite.rows.size(); ++i) lines.push_back(line_of(suite.list, i, 1.0));
    }
    suite.index.keep();
    if (!a.out.empty()) {
        comments.insert(comments.end(), notes.begin(), notes.end());
        write_file(a.out, suite_list_text(lines, a.out, comments));
    }
    Answer answer(json_header("record-suite"));
    for (std::size_t i = 0; i < tables.size(); ++i) answer.add(names[i], tables[i]);
    for (auto table = tables.rbegin(); table != tables.rend(); ++table) // what was chosen first
        answer.add("", *table, {.text = false, .brief = true, .data = false});
    for (const std::string& note : notes) {
        answer += note + "\n";
        answer.note_in_brief(note);
    }
    answer.set("notes", notes);
    answer.set("out", a.out.string());
    answer.headline_in_brief({target ? fmt::format("{} of {} records selected.", lines.size(), suite.rows.size())
                                     : fmt::format("{} records.", suite.rows.size())});
    put_answer(std::move(answer), "--out FILE.csv", streams);
    if (streams.form != Form::json && !a.out.empty() && !streams.quiet)
        streams.talk << fmt::format("{}: {} records; read it with  --records {}\n", a.out.string(), lines.size(),
                                    a.out.string());
    return good ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
