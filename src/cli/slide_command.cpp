#include "analysis/prepare/record_list.hpp"
#include "analysis/prepare/records.hpp"
#include "analysis/screen/regression_rows.hpp"
#include "cli/command.hpp"
#include "cli/input/make_axes.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/status.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/table_text.hpp"
#include "pages/screen/screen_pages.hpp"
#include "records/read/header.hpp"
#include "records/read/number_table.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace damslip::cli {

namespace {

/// A yield acceleration, what slides on it, and records. In the units of the flags.
struct SlideArguments {
    std::string yield_g, yield_m_s2;   ///< lists, as the axes of a sweep
    std::filesystem::path yield_table; ///< rows of slip and yield; one of the three is given
    std::vector<std::filesystem::path> records;
    std::string record_list; ///< folder, pattern or list in place of them
    std::string unit, column;
    std::optional<double> dt;    ///< [s]
    double scale = 1.0;          ///< factor on all records
    std::optional<double> pga_g; ///< all records to this peak, before the factor
    std::string methods;         ///< list; empty: rigid, of a flexible block all three
    std::optional<double> period_s, height_m, velocity_m_s, base_velocity_m_s, reference_strain_percent;
    std::optional<double> damping, mass_ratio; ///< 0.05, 8/pi^2
    bool two_way = false;
};

using units::standard_gravity;

constexpr double largest_yield_g = 10.0;

/// What a column of a yield table holds: one number of it is `factor` m, or `factor` m/s2.
struct YieldColumn {
    bool is_yield = false;
    double factor = 1.0;
    std::string unit; ///< for messages
};

constexpr std::string_view yield_headings =
    "slip_mm, slip_cm or slip_m, and yield_g, yield_m_s2 or yield_cm_s2, either first";

/// "slip_m", "Slip [cm]", "yield_m_s2", "a_y (g)"; without a unit mm and g. Nothing for others.
std::optional<YieldColumn> yield_column(std::string_view heading)
{
    std::string name = records::lower(records::trimmed(heading));
    const auto length = [](std::string_view unit) {
        return unit == "mm" ? units::mm : unit == "cm" ? units::cm : unit == "m" ? 1.0 : 0.0;
    };
    const std::string unit = records::take_unit(name, [&](std::string_view u) {
                                 return length(u) > 0.0 || records::acceleration_unit(u);
                             }).value_or("");
    std::replace(name.begin(), name.end(), '_', ' ');
    const auto is = [&](std::initializer_list<std::string_view> names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    const auto accel = records::acceleration_unit(unit.empty() ? "g" : unit);
    if (is({"slip", "displacement", "sliding"}) && (unit.empty() || length(unit) > 0.0))
        return YieldColumn{false, unit.empty() ? units::mm : length(unit), unit.empty() ? "mm" : unit};
    if (is({"yield", "a y", "ay", "yield acceleration", "yield accel", "k y", "ky", "yield coefficient"}) && accel)
        return YieldColumn{true, accel->factor, std::string(accel->name)};
    return std::nullopt;
}

/// The two columns by the heading above the numbers, or by the comment there that names both; without one slip [mm] and yield [g].
std::array<YieldColumn, 2> yield_columns(const records::RecordText& text, const records::NumberTable& table)
{
    std::array<YieldColumn, 2> columns{YieldColumn{false, units::mm, "mm"}, YieldColumn{true, standard_gravity, "g"}};
    const auto take = [&](const std::vector<std::string>& headings) {
        const auto first = yield_column(headings.front()), second = yield_column(headings.back());
        if (headings.size() != 2 || !first || !second || first->is_yield == second->is_yield) return false;
        columns = {*first, *second};
        return true;
    };
    if (!table.headings.empty() || !table.skipped_lines.empty()) {
        const std::size_t line = table.headings.empty() ? table.skipped_lines.back() : table.heading_line;
        if (table.headings.empty() || !take(table.headings))
            records::refuse(text, {line, 0},
                            fmt::format("{} is no heading of a yield acceleration over slip.",
                                        records::in_quotes(records::trimmed(text.lines[line - 1]))),
                            std::string(yield_headings), "write  slip_mm,yield_g  or put # before a remark");
        return columns;
    }
    if (const std::size_t line = table.row_line.front() - 1; line > 0 && records::is_comment(text.lines[line - 1])) {
        bool separated = false;
        const std::string_view words = records::trimmed(records::trimmed(text.lines[line - 1]).substr(1));
        if (const auto names = records::heading_fields(words, table.dialect.separator, 2, separated); !names.empty())
            take(names);
    }
    return columns;
}

/// Rows of slip and yield in the units of their headings, the first at slip 0. @throws InputError with file, line and column
std::vector<sliding::YieldPoint> read_yield_table(const std::filesystem::path& path)
{
    const std::string content = read_file(path), name = path.string();
    const records::RecordText text = records::split_lines(content, name);
    const records::NumberTable table = records::read_number_table(text);
    const std::array<YieldColumn, 2> columns = yield_columns(text, table);
    const std::size_t of_slip = columns[0].is_yield ? 1 : 0, of_yield = 1 - of_slip;
    const YieldColumn &slips = columns[of_slip], &yields = columns[of_yield];
    std::vector<sliding::YieldPoint> points;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.width(row) != 2)
            records::refuse(text, {table.row_line[row], 0},
                            fmt::format("{} numbers in a line of a yield acceleration over slip.", table.width(row)),
                            fmt::format("two: slip [{}] and yield acceleration [{}]", slips.unit, yields.unit),
                            "correct the line");
        const double slip = table.values[table.row_begin[row] + of_slip],
                     yield = table.values[table.row_begin[row] + of_yield];
        if (!(yield >= 0.0 && yield * yields.factor <= largest_yield_g * standard_gravity))
            records::refuse(text, table.place(row, of_yield, text),
                            fmt::format("a yield acceleration of {} {}.", shortest(yield), yields.unit),
                            fmt::format("a number from 0 to {:g} g", largest_yield_g),
                            "correct the number, or the unit of its heading");
        if (points.empty() && slip != 0.0)
            records::refuse(text, table.place(row, of_slip, text),
                            fmt::format("the first slip is {} {}.", shortest(slip), slips.unit),
                            "0, the block that has not slipped", "begin the table with its yield at slip 0");
        if (!points.empty() && slip * slips.factor < points.back().path)
            records::refuse(text, table.place(row, of_slip, text),
                            fmt::format("a slip of {} {} after a larger one.", shortest(slip), slips.unit),
                            "slips that ascend", "sort the rows by slip");
        points.push_back({slip * slips.factor, yield * yields.factor});
    }
    return points;
}

/// One yield over the slip for each of a list.
std::vector<std::vector<sliding::YieldPoint>> yields_of(const SlideArguments& a)
{
    if (!a.yield_g.empty() + !a.yield_m_s2.empty() + !a.yield_table.empty() != 1)
        refuse_usage("the yield acceleration is to be given once.", "one of --yield-g, --yield-m-s2, --yield-table",
                     "for example  --yield-g 0.1");
    if (!a.yield_table.empty()) return {read_yield_table(a.yield_table)};
    const bool in_g = !a.yield_g.empty();
    const char* const flag = in_g ? "--yield-g" : "--yield-m-s2";
    const double unit = in_g ? standard_gravity : 1.0, least = in_g ? 1e-6 : 1e-5,
                 most = in_g ? largest_yield_g : 10.0 * largest_yield_g;
    std::vector<std::vector<sliding::YieldPoint>> yields;
    for (const double yield : number_list(in_g ? a.yield_g : a.yield_m_s2, flag)) {
        if (!(yield >= least && yield <= most))
            refuse_usage(fmt::format("{} {} is not allowed.", flag, shortest(yield)),
                         fmt::format("numbers from {:g} to {:g}", least, most),
                         fmt::format("for example  {} 0.05:0.2:0.05", flag));
        yields.push_back({{0.0, yield * unit}});
    }
    return yields;
}

GivenYieldBlock block_of(const SlideArguments& a)
{
    GivenYieldBlock block;
    block.two_way = a.two_way;
    if (!a.period_s && !a.height_m) {
        if (a.damping || a.mass_ratio)
            refuse_usage(fmt::format("{} without a period.", a.damping ? "--damping" : "--mass-ratio"),
                         "a mode: --period-s, or --height and --shear-velocity", "add  --period-s 0.3");
        return block;
    }
    if (a.period_s && a.height_m)
        refuse_usage("--period-s and --height are both given.", "a period, or a column's height and velocity",
                     "leave one out");
    sliding::FlexibleBlock mode;
    mode.period = a.period_s.value_or(0.0);
    mode.damping_ratio = a.damping.value_or(mode.damping_ratio);
    mode.mass_ratio = a.mass_ratio.value_or(mode.mass_ratio);
    if (a.height_m)
        block.column =
            sliding::StrainColumn{*a.height_m, *a.velocity_m_s, mode.damping_ratio, a.base_velocity_m_s.value_or(0.0),
                                  0.01 * a.reference_strain_percent.value_or(0.0)};
    block.flexible = mode;
    return block;
}

std::vector<std::string> methods_of(const SlideArguments& a, bool flexible)
{
    if (a.methods.empty())
        return flexible ? std::vector<std::string>{"rigid", "decoupled", "coupled"} : std::vector<std::string>{"rigid"};
    const std::vector<std::string> methods = word_list(a.methods, "--method", {"rigid", "decoupled", "coupled"});
    for (const std::string& method : methods)
        if (method != "rigid" && !flexible)
            refuse_usage("--method " + method + " without a period.",
                         "a mode: --period-s, or --height and --shear-velocity", "add  --period-s 0.3");
    return methods;
}

/// Horizontal components, scaled.
std::vector<GroundMotion> motions_of(const SlideArguments& a, const Streams& streams)
{
    RecordList list;
    if (!a.record_list.empty()) list = record_list(a.record_list, a.column.empty());
    std::vector<RecordFiles> files;
    for (const std::filesystem::path& file : a.records) {
        files.emplace_back();
        files.back().name = file.stem().string();
        files.back().horizontal = file;
    }
    files.insert(files.end(), list.records.begin(), list.records.end());
    for (const std::string& note : list.notes) streams.remark("note: " + note);
    if (files.empty() && !a.record_list.empty())
        refuse_usage(fmt::format("--records {}: there is no record here.", a.record_list),
                     "a folder, a pattern in quotes such as 'suite/*.AT2', or a CSV with horizontal",
                     "correct the pattern");
    if (files.empty())
        refuse_usage("there is no record.", "accelerograms: --record FILE, or --records of a folder",
                     "add  --record FILE ; without a record:  damslip regress");
    records::ReadOptions options;
    options.unit = a.unit;
    options.dt = a.dt;
    std::vector<GroundMotion> motions;
    for (const RecordFiles& file : files) {
        const std::string& name = file.name;
        options.column = file.column.empty() ? a.column : file.column;
        const Record record = records::read_record(file.horizontal, options);
        for (const std::string& remark : component_remarks({file, record, std::nullopt}))
            streams.remark("note: " + remark);
        for (const std::string& warning : record.warnings) streams.remark("note: " + name + ": " + warning);
        records::MotionOptions scaling;
        scaling.scale = a.scale;
        if (a.pga_g) scaling.scale_to_pga = *a.pga_g * standard_gravity;
        motions.push_back(records::make_ground_motion(record, std::nullopt, scaling));
        motions.back().name = name;
    }
    return motions;
}

void slide_flags(CLI::App& sub, SlideArguments& a)
{
    const char* const yield = "Yield acceleration";
    sub.option_defaults()->group(yield);
    sub.add_option("--yield-g", a.yield_g, "yield acceleration a_y [g], or several: 0.05,0.1 or 0.05:0.2:0.05");
    sub.add_option("--yield-m-s2", a.yield_m_s2, "the same [m/s^2]");
    sub.add_option("--yield-table", a.yield_table,
                   "file of slip and a_y, units by its headings (slip_mm,yield_g; none: mm and g), the first at slip 0; "
                   "straight lines between, the last holds");
    sub.option_defaults()->group("Ground motion");
    sub.add_option("--record", a.records, "horizontal accelerogram(s)");
    sub.add_option("--records", a.record_list, "folder, pattern in quotes or list (CSV) of accelerograms");
    sub.add_option("--units", a.unit, "unit of record files that do not say: g, m/s2, cm/s2, gal, mg");
    sub.add_option("--dt", a.dt, "time step of one-column record files [s]")->check(in_range(1e-6, 1.0));
    sub.add_option("--column", a.column, "heading or number of the column where files hold several");
    sub.add_option("--scale", a.scale, "factor on all records")->check(in_range(0.0, 1e4));
    sub.add_option("--pga-g", a.pga_g, "every record to this peak, before --scale [g]")->check(in_range(1e-6, 10.0));
    sub.option_defaults()->group("Options");
    sub.add_flag("--two-way", a.two_way, "the block slides uphill, too, at the same yield");
    sub.add_option("--method", a.methods,
                   "rigid, decoupled, coupled; default: rigid, of a block with a period all of them");
    sub.option_defaults()->group("A block that vibrates on its base");
    sub.add_option("--period-s", a.period_s, "period of its mode [s]")->check(in_range(1e-3, 100.0));
    CLI::Option* height = sub.add_option("--height", a.height_m, "of a shear column in place of the period [m]")
                              ->check(in_range(0.01, 1000.0));
    CLI::Option* velocity =
        sub.add_option("--shear-velocity", a.velocity_m_s, "V_s of the column at small strain [m/s]")
            ->check(in_range(1.0, 10000.0))
            ->needs(height);
    height->needs(velocity);
    sub.add_option("--base-velocity", a.base_velocity_m_s,
                   "V_s of the rock below: what it radiates is added to the damping")
        ->check(in_range(1.0, 10000.0))
        ->needs(height);
    sub.add_option("--reference-strain", a.reference_strain_percent,
                   "at which the column's shear modulus is halved [%]: period and damping follow the strain")
        ->check(in_range(1e-4, 100.0))
        ->needs(height);
    sub.add_option("--damping", a.damping, "damping ratio of the mode (0.05)")->check(in_range(0.0, 0.5));
    sub.add_option("--mass-ratio", a.mass_ratio, "effective mass of the mode over the mass (8/pi^2)")
        ->check(in_range(1e-3, 0.95));
}

/// Slip on a given yield acceleration, without a section: every record both ways, and their mean.
int slide_on_yield(const SlideArguments& a, const Streams& streams)
{
    const std::vector<std::vector<sliding::YieldPoint>> yields = yields_of(a);
    GivenYieldBlock block = block_of(a);
    const std::vector<std::string> methods = methods_of(a, block.flexible.has_value());
    const std::vector<GroundMotion> motions = motions_of(a, streams);
    std::vector<GivenYieldRow> rows;
    for (const std::vector<sliding::YieldPoint>& yield : yields) {
        block.yield = yield;
        for (GivenYieldRow& row : given_yield_runs(block, motions, methods)) rows.push_back(std::move(row));
    }
    const Table table = pages::given_yield_table(block, rows);
    pages::Answer answer(pages::json_header("slide"));
    answer.set("two_way", block.two_way);
    answer.add("rows", table, {.brief = true});
    answer.set("notes", table.notes);
    double largest = 0.0;
    for (const GivenYieldRow& row : rows)
        for (const sliding::SlideResult* r : {&row.normal, &row.inverse})
            largest = std::max(largest, reported(r->status, r->max_slip).value_or(0.0));
    answer.headline_in_brief({fmt::format("Slip {:.4g} mm at most, of both polarities.", largest / units::mm)});
    put_answer(std::move(answer), "", streams);
    StatusCount statuses;
    for (const GivenYieldRow& row : rows) {
        statuses.add(row.normal.status);
        statuses.add(row.inverse.status);
    }
    return statuses.exit_code();
}

} // namespace

Command slide_command()
{
    return {"slide", "slip on a yield acceleration that is given, of records; without a scene",
            "damslip slide --yield-g 0.1 --record records/data/rock_1.0_h.csv --period-s 0.3",
            with_flags<SlideArguments>(slide_flags, slide_on_yield)};
}

} // namespace damslip::cli
