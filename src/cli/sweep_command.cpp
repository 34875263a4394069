#include "cli/sweep_command.hpp"

#include "cli/progress.hpp"
#include "cli/sweep_comparison.hpp"
#include "cli/usage_error.hpp"
#include "core/file.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "report/table_text.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

namespace {

[[noreturn]] void usage(std::string problem, std::string expected, std::string fix)
{
    throw UsageError(Diagnostic{"", 0, 0, std::move(problem), std::move(expected), std::move(fix)});
}

Table empty_table()
{
    Table t;
    t.columns = {{"id", "id", "", 4},
                 {"friction", "μ", "–", 4},
                 {"level_m", "level", "m", 4},
                 {"uplift", "uplift", "", 4},
                 {"reservoir", "reservoir", "", 4},
                 {"scale", "scale", "–", 4},
                 {"polarity", "polarity", "", 4},
                 {"record", "record", "", 4},
                 {"method", "method", "", 4},
                 {"yield_acceleration_m_s2", "a_y", "m/s²", 5},
                 {"yield_coefficient_g", "a_y", "g", 5},
                 {"pga_m_s2", "PGA", "m/s²", 4},
                 {"slip_m", "slip", "m", 5},
                 {"max_slip_m", "largest", "m", 5},
                 {"upstream_slip_m", "upstream", "m", 4},
                 {"slip_low_m", "−1σ", "m", 4},
                 {"slip_high_m", "+1σ", "m", 4},
                 {"slip_error_m", "± step", "m", 2},
                 {"critical_friction", "critical μ", "–", 6},
                 {"status", "status", "", 4}};
    return t;
}

/// Median and band of a regression in the columns of a row.
std::vector<Cell> regression_cells(const sliding::Regression& regression, const sliding::RegressionInputs& inputs,
                                   const RigidModel& model)
{
    const sliding::RegressionResult r = sliding::evaluate(regression, inputs);
    const auto metres = [](const std::optional<double>& value_cm) {
        return value_cm ? Cell(*value_cm * units::cm) : Cell();
    };
    std::string status;
    for (const std::string& warning : r.warnings) status += (status.empty() ? "" : "; ") + warning;
    return {metres(r.median_cm),
            metres(r.median_cm),
            Cell{},
            metres(r.minus_sd_cm),
            metres(r.plus_sd_cm),
            Cell{},
            model.critical_friction,
            status};
}

std::vector<Cell> make_row(const Scene& scene, const Grid& grid, std::size_t id)
{
    const GridIndex g = grid_index(grid.axes, grid.records.size(), id);
    const RigidModel& model = grid.model(g);
    const int polarity = grid.axes.polarity[g.polarity];
    const std::string& method = grid.axes.method[g.method];
    const double a_y = model.downstream.law.constant;
    std::vector<Cell> row{static_cast<std::int64_t>(id),
                          grid.axes.friction[g.friction],
                          grid.axes.level[g.level],
                          grid.axes.uplift[g.uplift],
                          grid.axes.reservoir[g.reservoir],
                          grid.axes.scale[g.scale],
                          static_cast<std::int64_t>(polarity),
                          grid.records[g.record],
                          method,
                          a_y,
                          a_y / units::standard_gravity,
                          grid.inputs_of(g).pga_g * units::standard_gravity};
    const auto rest = [&row](std::vector<Cell> cells) {
        row.insert(row.end(), cells.begin(), cells.end());
        return row;
    };
    const auto number = [](const std::optional<double>& value) { return value ? Cell(*value) : Cell(); };
    if (method == "fe") {
        const FeSlip& r = grid.fe_slip(g);
        return rest({number(r.slip), number(r.max_slip), Cell{}, Cell{}, Cell{}, number(r.slip_error),
                     number(r.critical_friction), r.status});
    }
    if (method == "rigid-v" && !grid.motion(g).has_vertical())
        return rest({Cell{}, Cell{}, Cell{}, Cell{}, Cell{}, Cell{}, model.critical_friction,
                     std::string("no vertical component")});
    if (const sliding::Regression* regression = sliding::find_regression(method))
        return rest(regression_cells(*regression, grid.inputs_of(g), model));
    const sliding::SlideResult r =
        slide_model(scene, model, method == "rigid" ? grid.horizontal(g) : grid.motion(g), polarity);
    return rest(
        {r.slip, r.max_slip, r.upstream_slip, Cell{}, Cell{}, Cell{}, model.critical_friction, status_word(r.status)});
}

/// Tables for people; the rows have standard output for themselves.
void talk_of(const FeSweepCounts& c, const Table& compared, const Streams& streams)
{
    streams.talk << "\n" << report::text(compared) << "\n" << report::text(count_table(c));
    streams.talk << fmt::format(
        "  set-up {:.2f} s, statics {:.1f} ms a run, earthquakes {:.1f} s\n\n", c.set_up_seconds,
        1e3 * c.static_seconds / static_cast<double>(std::max<std::int64_t>(1, c.runs)), c.dynamic_seconds);
}

} // namespace

std::vector<std::string> sweep_methods()
{
    std::vector<std::string> methods{"rigid", "rigid-v", "fe"};
    for (const sliding::Regression& r : sliding::regressions()) methods.emplace_back(r.id);
    return methods;
}

int sweep(const SweepArguments& arguments, const Streams& streams)
{
    const Scene given = read_run_scene(arguments.inputs);
    const EffectPlan plan = make_effect_plan(given, Method::rigid_block);
    const Axes axes = make_axes(arguments, given);
    if (given.motion.records.empty())
        usage("there is no record to sweep over.", "a [[motion.record]] in the scene or --record",
              "add  --record FILE");
    const Scene scene = called_for(plan, given);
    const std::vector<RecordPair> records = read_records(scene, plan);
    // Axes may bring back what the scene itself leaves off (another uplift model), so the grid starts from the scene as given.
    Grid grid = make_grid(given, axes, records, arguments.jobs);
    if (grid.size() > 20'000'000)
        usage(fmt::format("the grid has {} rows.", grid.size()), "at most 20 million", "split it");

    std::optional<FeSweepCounts> fe;
    if (axes.has("fe")) {
        const InterruptGuard interrupt;
        Progress progress(streams, "sweep, finite elements", grid.size() / axes.method.size());
        fe = run_fe(given, records, arguments.jobs, progress, interrupt, grid);
    }
    Table table = empty_table();
    table.rows.resize(grid.size());
    {
        Progress progress(streams, "sweep", grid.size());
        parallel_for(grid.size(), arguments.jobs, [&](std::size_t id) {
            table.rows[id] = make_row(scene, grid, id);
            progress.advance();
        });
    }
    std::string text;
    if (streams.form == Form::json) {
        auto j = json_header("sweep");
        j["scene"] = {{"title", given.title}, {"file", given.file.string()}, {"hash", scene_hash(given)}};
        j["rows"] = json_of(table);
        if (fe) {
            j["comparison"] = json_of(comparison(scene, grid));
            j["counts"] = json_of(count_table(*fe))[0];
        }
        text = j.dump(2) + "\n";
    } else {
        text = report::csv(table, {"damslip " + program_version() + " sweep", "scene " + scene_hash(given)});
    }
    if (arguments.out.empty())
        streams.out << text;
    else
        write_file(arguments.out, text);
    if (!streams.quiet) {
        if (fe) talk_of(*fe, comparison(scene, grid), streams);
        streams.talk << fmt::format("{} rows{}\n", grid.size(),
                                    arguments.out.empty() ? "" : " in " + arguments.out.string());
    }
    return std::all_of(grid.fe.begin(), grid.fe.end(), [](const FeSlip& r) { return r.good; }) ? exit_ok
                                                                                               : exit_no_convergence;
}

} // namespace damslip::cli
