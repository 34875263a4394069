#include "records/generate/generate.hpp"

#include "core/csv.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "records/generate/wavelet_match.hpp"
#include "records/measure/measures.hpp"
#include "records/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <set>

namespace damslip::records {

namespace {

constexpr int most_passes = 60;
constexpr int patience = 10; // passes without a better one, once within the tolerance

void check(const GenerateOptions& o)
{
    std::vector<Diagnostic> wrong;
    const auto in_range = [&](const char* name, double value, double low, double high, const char* unit) {
        if (!(value >= low && value <= high))
            wrong.push_back({"", 0, 0, fmt::format("record generate: {} = {} is not allowed.", name, value),
                             fmt::format("{} to {} {}", low, high, unit), "correct it"});
    };
    in_range("pga", o.pga, 1e-3, 50.0, "m/s2");
    in_range("duration", o.duration, 5.0, 600.0, "s");
    in_range("dt", o.dt, 0.001, 0.01, "s");
    in_range("tolerance", o.tolerance, 0.01, 0.5, "");
    in_range("envelope rise", o.envelope.rise, 0.001, 0.999, "of the duration");
    in_range("envelope level", o.envelope.level, o.envelope.rise, 0.999, "of the duration");
    if (wrong.empty() && std::abs(std::round(o.duration / o.dt) * o.dt - o.duration) > 1e-9 * o.duration)
        wrong.push_back(
            {"", 0, 0,
             fmt::format("record generate: duration = {} s is no whole number of dt = {} s.", o.duration, o.dt),
             "a multiple of dt", "change either"});
    if (!wrong.empty()) throw InputError(std::move(wrong));
}

std::vector<double> finished(std::vector<double> accel, double pga)
{
    end_at_rest(accel);
    set_peak(accel, pga);
    round_samples(accel, pga);
    return accel;
}

Record described(std::vector<double> accel, const TargetSpectrum& target, const GenerateOptions& o)
{
    const bool horizontal = o.component == MotionComponent::horizontal;
    Record record{horizontal ? "generated_h" : "generated_v", o.dt, std::move(accel), {}, {}};
    record.source.format = "generated";
    record.source.unit = "m/s2";
    record.source.component = horizontal ? "h" : "v";
    record.source.title = fmt::format("artificial accelerogram; target {}; PGA {} m/s2; {} s; seed {}", target.name,
                                      o.pga, o.duration, o.seed);
    return record;
}

/// Deviations over the band: the largest, where, and a smooth measure of their size (mean of 8th powers) to steer by.
struct Deviations {
    SpectrumMatch worst;
    double norm = 0.0;
};

Deviations deviations(const std::vector<double>& accel, double dt, const TargetSpectrum& target, double pga)
{
    const std::vector<double> periods = logarithmic_periods(matched_from, matched_to, 200);
    Deviations d;
    for (const SpectrumPoint& point : response_spectrum(accel, dt, periods, 0.05).points) {
        const double deviation = std::abs(point.pseudo_acceleration / (pga * target.amplification(point.period)) - 1.0);
        if (!(deviation <= d.worst.deviation)) d.worst = {deviation, point.period};
        const double squared = deviation * deviation;
        d.norm += squared * squared * squared * squared;
    }
    return d;
}

/// The best pass.
struct Matched {
    std::vector<double> accel;
    SpectrumMatch match;
    int passes = 0;
};

/// Wavelet passes, bolder after a good one, more careful after a bad one, which is dropped (Levenberg-Marquardt). Where no step helps any
/// more, one is taken all the same to get away. What counts is the finished record: rounded, at rest, with its PGA.
Matched match(std::vector<double> accel, double dt, const TargetSpectrum& target, double pga, double tolerance)
{
    constexpr double start = 1e-4, boldest = 1e-7, too_careful = 0.1;
    const std::vector<double> periods = logarithmic_periods(0.9 * matched_from, 1.1 * matched_to, 100);
    Deviations now = deviations(accel, dt, target, pga);
    Matched best{accel, now.worst, 0};
    double regularisation = start;
    int since_best = 0;
    const auto good_enough = [&] {
        return best.match.deviation <= 0.5 * tolerance || (best.match.deviation <= tolerance && since_best >= patience);
    };
    for (; best.passes < most_passes && !good_enough(); ++best.passes, ++since_best) {
        std::vector<double> trial = accel;
        match_by_wavelets(trial, dt, target, pga, periods, regularisation);
        trial = finished(std::move(trial), pga);
        const Deviations then = deviations(trial, dt, target, pga);
        const bool better = then.norm<now.norm, stalled = regularisation> too_careful;
        if (better || stalled) accel = std::move(trial), now = then;
        if (now.worst.deviation < best.match.deviation) best.accel = accel, best.match = now.worst, since_best = 0;
        regularisation = better ? std::max(regularisation / 3.0, boldest) : stalled ? start : 4.0 * regularisation;
    }
    return best;
}

GeneratedRecord with_story(Record record, const Matched& m, double tolerance)
{
    GeneratedRecord result{std::move(record), m.match.deviation, m.match.period, m.passes,
                           m.match.deviation <= tolerance};
    if (!result.within_tolerance)
        result.record.warnings.push_back(
            fmt::format("the spectrum is {:.1f} % off its target at {:.3g} s, more than the {:.1f} % asked for",
                        100.0 * result.worst_deviation, result.worst_period, 100.0 * tolerance));
    return result;
}

} // namespace

SpectrumMatch spectrum_match(const std::vector<double>& accel, double dt, const TargetSpectrum& target, double pga)
{
    return deviations(accel, dt, target, pga).worst;
}

GeneratedRecord generate_record(const TargetSpectrum& target, const GenerateOptions& o)
{
    check(o);
    // random phases under the envelope, spectrum roughly right; then wavelets
    const auto n = static_cast<std::size_t>(std::lround(o.duration / o.dt)) + 1;
    const std::vector<double> envelope = envelope_samples(o.envelope, n);
    const std::uint64_t stream = o.component == MotionComponent::horizontal ? 0 : 1;
    Matched m = match(finished(random_phase_record(target, envelope, {o.dt, o.pga, o.seed, stream}), o.pga), o.dt,
                      target, o.pga, o.tolerance);
    return with_story(described(std::move(m.accel), target, o), m, o.tolerance);
}

GeneratedRecord matched_record(const Record& record, const TargetSpectrum& target, double pga, double tolerance)
{
    GenerateOptions o;
    o.pga = pga;
    o.tolerance = tolerance;
    check(o);
    const std::string& file = record.source.file;
    if (!(record.dt >= 0.001 && record.dt <= 0.01))
        throw InputError(Diagnostic{file, 0, 0, fmt::format("dt = {} s is not allowed for a match.", record.dt),
                                    "0.001 to 0.01 s: five samples at the shortest period matched",
                                    fmt::format("damslip record convert {} --new-dt 0.01 --out ...", file)});
    if (record.duration() < 5.0)
        throw InputError(Diagnostic{file, 0, 0,
                                    fmt::format("a record of {:.4g} s is too short for a match.", record.duration()),
                                    "5 s or more", "leave it out, or do not match"});
    Matched m = match(finished(record.acceleration, pga), record.dt, target, pga, tolerance);
    Record changed = record;
    changed.acceleration = std::move(m.accel);
    changed.source.title = fmt::format("{}{}matched by wavelets to {}, PGA {} m/s2", record.source.title,
                                       record.source.title.empty() ? "" : "; ", target.name, pga);
    return with_story(std::move(changed), m, tolerance);
}

namespace {

struct EndState {
    double velocity = 0.0;     ///< in units of dt
    double displacement = 0.0; ///< in units of dt^2
};

EndState end_state(const std::vector<double>& accel)
{
    EndState s;
    for (std::size_t k = 1; k < accel.size(); ++k) {
        s.displacement += s.velocity + accel[k - 1] / 3.0 + accel[k] / 6.0;
        s.velocity += 0.5 * (accel[k - 1] + accel[k]);
    }
    return s;
}

std::size_t largest(const std::vector<double>& accel)
{
    return static_cast<std::size_t>(
        std::max_element(accel.begin(), accel.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
        accel.begin());
}

} // namespace

void end_at_rest(std::vector<double>& accel)
{
    const std::size_t n = accel.size();
    std::vector<double> bump(n), slope(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = static_cast<double>(k) / static_cast<double>(n - 1), s = std::sin(std::numbers::pi * x);
        bump[k] = s * s;
        slope[k] = x * bump[k];
    }
    const EndState a = end_state(bump), b = end_state(slope), now = end_state(accel);
    const double determinant = a.velocity * b.displacement - b.velocity * a.displacement;
    const double c0 = (now.velocity * b.displacement - b.velocity * now.displacement) / determinant;
    const double c1 = (a.velocity * now.displacement - now.velocity * a.displacement) / determinant;
    for (std::size_t k = 1; k + 1 < n; ++k) accel[k] -= c0 * bump[k] + c1 * slope[k];
}

void set_peak(std::vector<double>& accel, double pga)
{
    const auto move_to = [&](std::size_t k, double value) {
        const double d = value - accel[k];
        accel[k] = value;
        accel[k - 1] -= 0.5 * d;
        accel[k + 1] -= 0.5 * d;
    };
    const auto top = [&] { return std::clamp<std::size_t>(largest(accel), 2, accel.size() - 3); };
    if (const std::size_t k = top(); std::abs(accel[k]) < pga) move_to(k, std::copysign(pga, accel[k]));
    bool changed = true;
    for (int pass = 0; pass < 100 && changed; ++pass) {
        changed = false;
        for (std::size_t k = 2; k + 2 < accel.size(); ++k)
            if (std::abs(accel[k]) > pga) move_to(k, std::copysign(pga, accel[k])), changed = true;
    }
    // What the cuts left above or below, a common factor sets right; it too keeps an end at rest.
    const std::size_t k = largest(accel);
    const double factor = pga / std::abs(accel[k]);
    for (double& a : accel) a *= factor;
    accel[k] = std::copysign(pga, accel[k]);
}

void round_samples(std::vector<double>& accel, double pga)
{
    const std::size_t peak = largest(accel);
    for (std::size_t k = 0; k < accel.size(); ++k) {
        if (k == peak) continue;
        const double up = std::nearbyint(accel[k] * 1e6);
        const double millionths = std::abs(up / 1e6) > pga ? std::trunc(accel[k] * 1e6) : up;
        accel[k] = millionths / 1e6 + 0.0; // + 0.0: no negative zeros
    }
}

std::vector<double> envelope_samples(const Envelope& envelope, std::size_t n)
{
    assert(envelope.rise > 0.0 && envelope.level >= envelope.rise && envelope.level < 1.0 && n >= 2);
    constexpr double end_value = 0.05, taper = 0.025;
    const bool compound = envelope.shape == EnvelopeShape::compound;
    std::vector<double> values(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = static_cast<double>(k) / static_cast<double>(n - 1);
        double value = 1.0;
        if (x < envelope.rise) value = compound ? (x / envelope.rise) * (x / envelope.rise) : x / envelope.rise;
        if (x > envelope.level) {
            const double part = (x - envelope.level) / (1.0 - envelope.level);
            value = compound ? std::pow(end_value, part) : 1.0 - part;
        }
        if (x > 1.0 - taper) value *= 0.5 * (1.0 + std::cos(std::numbers::pi * (x - 1.0 + taper) / taper));
        values[k] = value;
    }
    values.back() = 0.0;
    return values;
}

namespace {

namespace fs = std::filesystem;

/// Raised when generate_record() makes other records of the same line: those that were made before are made again.
constexpr int generator = 1;
constexpr const char* made_of = "made_of.csv"; ///< the lines whose records are in the folder

/// One line of the list.
struct Seeds {
    SeededPair pair;
    GenerateOptions horizontal, vertical;
    TargetSpectrum target_h, target_v;
    std::string text; ///< what the records are made of
    int line = 0;
};

class SeedListReader {
public:
    explicit SeedListReader(fs::path list) : list_(std::move(list)), table_(parse_csv(read_file(list_))) {}

    std::vector<Seeds> read()
    {
        check_list(list_, table_,
                   {"name", "seed", "pga_m_s2", "target", "ground", "duration_s", "dt_s", "tolerance", "vertical",
                    "vertical_pga_m_s2", "vertical_tolerance", "event", "weight"},
                   {"name", "seed", "pga_m_s2"}, seed_columns);
        std::vector<Seeds> all;
        std::set<std::string> names;
        for (const CsvLine& row : table_.rows) {
            row_ = &row;
            all.push_back(line());
            if (!names.insert(all.back().pair.name).second)
                refuse_cell("name", "a name for each line: it is that of the files");
        }
        if (all.empty())
            throw InputError(Diagnostic{list_.string(), 0, 0, "this list has no line below its heading.",
                                        std::string(seed_columns), "add a line for each pair of records"});
        return all;
    }

private:
    std::size_t column(std::string_view name) const
    {
        const auto& names = table_.heading.cells;
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    }

    std::string cell(std::string_view name) const
    {
        const std::size_t at = column(name);
        return at < row_->cells.size() ? row_->cells[at] : std::string();
    }

    [[noreturn]] void refuse_cell(std::string_view name, const std::string& expected) const
    {
        throw InputError(Diagnostic{list_.string(), row_->number, 0,
                                    fmt::format("{} = \"{}\" is not allowed.", name, cell(name)), expected,
                                    "correct this line"});
    }

    double number(std::string_view name, double usual, double low, double high, const char* unit) const
    {
        if (cell(name).empty() && !std::isnan(usual)) return usual;
        const std::optional<double> value = parse_whole_number_text(cell(name));
        if (!value || !(*value >= low && *value <= high))
            refuse_cell(name, fmt::format("a number of {} to {}{}", low, high, unit));
        return *value;
    }

    TargetSpectrum target(MotionComponent component) const
    {
        const std::string ground = cell("ground").empty() ? "A" : cell("ground");
        if (ground.size() != 1 || ground[0] < 'A' || ground[0] > 'E') refuse_cell("ground", "A, B, C, D or E");
        const std::string word = cell("target").empty() ? "rock" : cell("target");
        const fs::path file = list_.parent_path() / word;
        const auto found = find_target_spectrum(
            word, file, static_cast<GroundType>(static_cast<int>(GroundType::A) + ground[0] - 'A'), component);
        if (!found) refuse_cell("target", "rock, ec8-1, ec8-2, or a CSV file of period [s] and spectral acceleration");
        return *found;
    }

    /// A seed has up to 19 digits: it is read as a whole number, without rounding.
    std::uint64_t seed() const
    {
        const std::string text = cell("seed");
        const bool digits = !text.empty() && text.size() <= 18 &&
                            std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
        if (!digits) refuse_cell("seed", "a whole number of 0 to 999999999999999999");
        return std::stoull(text);
    }

    Seeds line() const
    {
        const double needed = std::nan("");
        Seeds of;
        of.line = row_->number;
        of.pair.name = cell("name");
        if (of.pair.name.empty() || file_word(of.pair.name) != of.pair.name)
            refuse_cell("name", "letters, digits, -, +, . and _: it is that of the files");
        of.pair.event = cell("event").empty() ? of.pair.name : cell("event");
        of.pair.weight = number("weight", 1.0, 1e-9, 1e9, "");
        of.horizontal.seed = seed();
        of.horizontal.pga = number("pga_m_s2", needed, 1e-3, 50.0, " m/s2");
        of.horizontal.duration = number("duration_s", 20.0, 5.0, 600.0, " s");
        of.horizontal.dt = number("dt_s", 0.01, 0.001, 0.01, " s");
        of.horizontal.tolerance = number("tolerance", 0.10, 0.01, 0.5, "");
        of.target_h = target(MotionComponent::horizontal);
        const std::string vertical = cell("vertical").empty() ? "yes" : cell("vertical");
        if (vertical != "yes" && vertical != "no") refuse_cell("vertical", "yes or no");
        of.vertical = of.horizontal;
        of.vertical.component = MotionComponent::vertical;
        of.vertical.pga = number("vertical_pga_m_s2", of.horizontal.pga, 1e-3, 50.0, " m/s2");
        of.vertical.tolerance = number("vertical_tolerance", of.horizontal.tolerance, 0.01, 0.5, "");
        of.target_v = target(MotionComponent::vertical);
        if (vertical == "yes") of.pair.vertical = of.pair.name + "_v.csv";
        of.pair.horizontal = of.pair.name + "_h.csv";
        of.text = identity(of);
        return of;
    }

    /// Everything that decides the samples; a spectrum of a file by what it is at some periods.
    static std::string identity(const Seeds& of)
    {
        std::string text =
            fmt::format("{},{},{},{},{},{},{}", of.pair.name, of.horizontal.seed, shortest(of.horizontal.pga),
                        shortest(of.horizontal.duration), shortest(of.horizontal.dt), shortest(of.horizontal.tolerance),
                        spectrum_identity(of.target_h));
        if (of.pair.vertical)
            text += fmt::format(",{},{},{}", shortest(of.vertical.pga), shortest(of.vertical.tolerance),
                                spectrum_identity(of.target_v));
        return text;
    }

    static std::string spectrum_identity(const TargetSpectrum& target)
    {
        std::string values;
        for (double period = 0.01; period < 5.0; period *= 1.05) values += shortest(target.amplification(period)) + " ";
        return sha256(values).substr(0, 12);
    }

    fs::path list_;
    CsvTable table_;
    const CsvLine* row_ = nullptr;
};

/// The folder beside the list, or one of the cache where that cannot be written. @throws InputError where neither can
fs::path folder_of(const fs::path& list)
{
    fs::path beside = list;
    beside.replace_extension();
    if (!output_path_problem(beside, OutputPath::folder, beside.string())) {
        make_folder(beside);
        return beside;
    }
    const fs::path cache = cache_folder();
    if (cache.empty()) make_folder(beside); // says why not
    const fs::path in_cache = cache / "suites" / sha256(fs::absolute(list).lexically_normal().string()).substr(0, 16);
    make_folder(in_cache);
    return in_cache;
}

std::set<std::string> lines_made(const fs::path& folder)
{
    std::set<std::string> lines;
    if (!fs::is_regular_file(folder / made_of)) return lines;
    const CsvTable table = parse_csv(read_file(folder / made_of));
    if (table.heading.cells != std::vector<std::string>{"generator", std::to_string(generator)}) return lines;
    for (const CsvLine& row : table.rows) lines.insert(fmt::format("{}", fmt::join(row.cells, ",")));
    return lines;
}

void make_component(const fs::path& list, const Seeds& of, const fs::path& file, const GenerateOptions& options,
                    const TargetSpectrum& target)
{
    GeneratedRecord made = generate_record(target, options);
    if (!made.within_tolerance)
        throw InputError(Diagnostic{
            list.string(), of.line, 0,
            fmt::format("seed {} of {} misses its spectrum by {:.1f} %, at {:.3g} s.", of.horizontal.seed,
                        file.stem().string(), 100.0 * made.worst_deviation, made.worst_period),
            fmt::format("within {:.3g} %", 100.0 * options.tolerance), "take another seed, or widen the tolerance"});
    made.record.name = file.stem().string();
    write_file(file, record_csv(made.record));
}

} // namespace

void check_list(const fs::path& list, const CsvTable& table, const std::vector<std::string>& known,
                const std::vector<std::string>& needed, std::string_view columns)
{
    const std::vector<std::string>& headings = table.heading.cells;
    const auto heading_refused = [&](const std::string& problem) {
        return InputError(
            Diagnostic{list.string(), table.heading.number, 0, problem, std::string(columns), "correct the heading"});
    };
    for (auto name = headings.begin(); name != headings.end(); ++name) {
        if (std::find(known.begin(), known.end(), *name) == known.end())
            throw heading_refused(fmt::format("unknown column \"{}\".", *name));
        if (std::find(headings.begin(), name, *name) != name)
            throw heading_refused(fmt::format("the column {} stands twice.", *name));
    }
    for (const std::string& name : needed)
        if (std::find(headings.begin(), headings.end(), name) == headings.end())
            throw heading_refused(fmt::format("there is no column {}.", name));
    for (const CsvLine& row : table.rows) {
        std::size_t fields = row.cells.size(); // commas at the end of a line hold nothing
        while (fields > headings.size() && row.cells[fields - 1].empty()) --fields;
        if (fields > headings.size())
            throw InputError(Diagnostic{
                list.string(), row.number, 0,
                fmt::format("{} fields below {} heading{}.", fields, headings.size(), headings.size() == 1 ? "" : "s"),
                "at most as many fields as headings",
                "write decimals with a point, a field that holds a comma in quotes, or add the heading"});
    }
}

bool is_seed_list(std::string_view text)
{
    const std::vector<std::string> heading = parse_csv(text.substr(0, 4096)).heading.cells;
    return std::find(heading.begin(), heading.end(), "seed") != heading.end();
}

SeededSuite records_of_seeds(const fs::path& list, int jobs)
{
    const std::vector<Seeds> all = SeedListReader(list).read();
    SeededSuite suite;
    suite.folder = folder_of(list);
    const std::set<std::string> there = lines_made(suite.folder);
    std::vector<const Seeds*> missing;
    std::string kept_lines = fmt::format("generator,{}\n", generator), all_lines = kept_lines;
    for (const Seeds& of : all) {
        SeededPair pair = of.pair;
        pair.horizontal = suite.folder / pair.horizontal;
        if (pair.vertical) pair.vertical = suite.folder / *pair.vertical;
        const bool kept =
            there.contains(of.text) && fs::exists(pair.horizontal) && (!pair.vertical || fs::exists(*pair.vertical));
        if (kept)
            kept_lines += of.text + "\n";
        else
            missing.push_back(&of);
        all_lines += of.text + "\n";
        suite.pairs.push_back(std::move(pair));
    }
    suite.made = missing.size();
    if (missing.empty()) return suite;
    write_file(suite.folder / made_of, kept_lines); // what is interrupted now is made again
    parallel_for(2 * missing.size(), jobs, [&](std::size_t i) {
        const Seeds& of = *missing[i / 2];
        if (i % 2 == 0)
            make_component(list, of, suite.folder / of.pair.horizontal, of.horizontal, of.target_h);
        else if (of.pair.vertical)
            make_component(list, of, suite.folder / *of.pair.vertical, of.vertical, of.target_v);
    });
    write_file(suite.folder / made_of, all_lines);
    return suite;
}

} // namespace damslip::records
