#include "records/generate/seed_list.hpp"

#include "core/file.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "core/parallel.hpp"
#include "records/generate/generate.hpp"
#include "records/generate/target_spectrum.hpp"
#include "records/write/write_record.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace damslip::records {

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
