#include "cli/sweep_command.hpp"

#include "cli/number_list.hpp"
#include "cli/progress.hpp"
#include "cli/rigid_model.hpp"
#include "cli/seepage_source.hpp"
#include "cli/usage_error.hpp"
#include "core/file.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "report/table_text.hpp"
#include "scene/section.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

namespace {

/// One value of every axis of the grid.
struct Axes {
    std::vector<double> friction, level, scale;
    std::vector<int> polarity;
    std::vector<std::string> uplift, reservoir, method;
};

const std::vector<std::pair<std::string, UpliftModel>> uplift_words{
    {"none", UpliftModel::none},     {"linear", UpliftModel::linear}, {"curtain", UpliftModel::curtain},
    {"drains", UpliftModel::drains}, {"points", UpliftModel::points}, {"seepage", UpliftModel::seepage}};
const std::vector<std::pair<std::string, AddedMassFormula>> formula_words{
    {"westergaard", AddedMassFormula::westergaard},
    {"westergaard-simplified", AddedMassFormula::westergaard_simplified},
    {"zangar", AddedMassFormula::zangar},
    {"goldgruber", AddedMassFormula::goldgruber}};

template <class Enum>
std::string word_of(const std::vector<std::pair<std::string, Enum>>& words, Enum value)
{
    return std::find_if(words.begin(), words.end(), [value](const auto& w) { return w.second == value; })->first;
}

template <class Enum>
Enum value_of(const std::vector<std::pair<std::string, Enum>>& words, const std::string& word)
{
    return std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == word; })->second;
}

template <class Enum>
std::vector<std::string> keys_of(const std::vector<std::pair<std::string, Enum>>& words)
{
    std::vector<std::string> keys;
    for (const auto& [key, value] : words) keys.push_back(key);
    return keys;
}

[[noreturn]] void usage(std::string problem, std::string expected, std::string fix)
{
    throw UsageError(Diagnostic{"", 0, 0, std::move(problem), std::move(expected), std::move(fix)});
}

std::vector<double> checked_numbers(const std::string& text, const std::string& flag, double own, double low,
                                    double high, const std::string& meaning)
{
    if (text.empty()) return {own};
    std::vector<double> values = number_list(text, flag);
    for (const double v : values)
        if (!(v >= low && v <= high))
            usage(fmt::format("{}: {} is not allowed.", flag, v), meaning,
                  fmt::format("give values from {} to {}", low, high));
    return values;
}

std::string reservoir_word(const Scene& scene)
{
    if (!scene.reservoir) return "none";
    return scene.reservoir->model == ReservoirModel::hydrostatic ? "hydrostatic"
                                                                 : word_of(formula_words, scene.added_mass.formula);
}

std::vector<double> friction_axis(const SweepArguments& a, const Scene& scene)
{
    if (!a.friction.empty() && !a.friction_deg.empty())
        usage("--friction and --friction-deg are both given.", "one of them", "delete one");
    if (a.friction_deg.empty())
        return checked_numbers(a.friction, "--friction", scene.contact.friction, 0, 10, "Coulomb mu, 0 ... 10");
    std::vector<double> values =
        checked_numbers(a.friction_deg, "--friction-deg", 0, 0, 84, "friction angle [deg], 0 ... 84");
    for (double& v : values) v = std::tan(v * units::degree);
    return values;
}

Axes make_axes(const SweepArguments& a, const Scene& scene)
{
    Axes axes;
    axes.friction = friction_axis(a, scene);
    if (!a.level.empty() && !scene.reservoir)
        usage("--level is given, but the scene has no [reservoir].", "a scene with [reservoir]",
              "add [reservoir] to the scene");
    axes.level = checked_numbers(a.level, "--level", scene.reservoir ? scene.reservoir->level : 0.0, 0,
                                 3 * crest_level(scene.section), "water level above the heel [m]");
    axes.scale = checked_numbers(a.scale, "--scale", 1.0, 0, 1e3, "factor on the records, 0 ... 1000");
    for (const double p : checked_numbers(a.polarity, "--polarity", 1, -1, 1, "1, -1 or 1,-1")) {
        if (p != 1 && p != -1)
            usage(fmt::format("--polarity {} is not allowed.", p), "1, -1 or 1,-1", "write  --polarity 1,-1");
        axes.polarity.push_back(static_cast<int>(p));
    }
    axes.uplift = a.uplift.empty()
                      ? std::vector<std::string>{scene.uplift ? word_of(uplift_words, scene.uplift->model) : "none"}
                      : word_list(a.uplift, "--uplift", keys_of(uplift_words));
    for (const std::string& u : axes.uplift) {
        const bool possible = (u != "curtain" || scene.curtain) && (u != "drains" || scene.drains) &&
                              (u != "points" || (scene.uplift && !scene.uplift->points.empty()));
        if (!possible)
            usage(fmt::format("--uplift {}: the scene lacks what this profile needs.", u),
                  "[curtain] for curtain, [drains] for drains, uplift.points_m for points",
                  "add it to the scene or leave the profile out");
    }
    std::vector<std::string> reservoirs = keys_of(formula_words);
    reservoirs.insert(reservoirs.begin(), "hydrostatic");
    axes.reservoir = a.reservoir.empty() ? std::vector<std::string>{reservoir_word(scene)}
                                         : word_list(a.reservoir, "--reservoir", reservoirs);
    if (!a.reservoir.empty() && !scene.reservoir)
        usage("--reservoir is given, but the scene has no [reservoir].", "a scene with [reservoir]",
              "add [reservoir] to the scene");
    if (!a.method.empty())
        axes.method = word_list(a.method, "--method", sweep_methods());
    else if (std::any_of(scene.motion.records.begin(), scene.motion.records.end(),
                         [](const RecordFiles& r) { return r.vertical.has_value(); }) &&
             scene.motion.vertical)
        axes.method = {"rigid", "rigid-v"};
    else
        axes.method = {"rigid"};
    return axes;
}

Scene variant(Scene scene, double level, const std::string& uplift, const std::string& reservoir)
{
    if (scene.reservoir) {
        scene.reservoir->level = level;
        if (reservoir == "hydrostatic")
            scene.reservoir->model = ReservoirModel::hydrostatic;
        else {
            scene.added_mass.formula = value_of(formula_words, reservoir);
            if (scene.reservoir->model == ReservoirModel::hydrostatic)
                scene.reservoir->model = ReservoirModel::added_mass;
        }
    }
    if (uplift == "none")
        scene.uplift.reset();
    else {
        if (!scene.uplift) scene.uplift.emplace();
        scene.uplift->model = value_of(uplift_words, uplift);
    }
    return scene;
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
                 {"status", "status", "", 4}};
    return t;
}

/// Position of a flat index in the grid, the last axis fastest.
struct GridIndex {
    std::size_t friction, level, uplift, reservoir, scale, polarity, record, method;
};

GridIndex grid_index(const Axes& axes, std::size_t records, std::size_t id)
{
    const auto take = [&id](std::size_t n) {
        const std::size_t i = id % n;
        id /= n;
        return i;
    };
    GridIndex g{};
    g.method = take(axes.method.size());
    g.record = take(records);
    g.polarity = take(axes.polarity.size());
    g.scale = take(axes.scale.size());
    g.reservoir = take(axes.reservoir.size());
    g.uplift = take(axes.uplift.size());
    g.level = take(axes.level.size());
    g.friction = take(axes.friction.size());
    return g;
}

/// What all rows share, made once: a model per friction, level, uplift and reservoir, a motion per record and scale.
struct Grid {
    Axes axes;
    std::vector<RigidModel> models;
    std::vector<sliding::SkippingMotion> motions,
        horizontal_motions;                          ///< of each record and scale, with and without the vertical
    std::vector<sliding::RegressionInputs> measured; ///< of each motion; the yield coefficient is the row's
    std::vector<std::string> records;

    std::size_t size() const { return models.size() * motions.size() * axes.polarity.size() * axes.method.size(); }
    const RigidModel& model(const GridIndex& g) const
    {
        return models[((g.friction * axes.level.size() + g.level) * axes.uplift.size() + g.uplift) *
                          axes.reservoir.size() +
                      g.reservoir];
    }
    sliding::RegressionInputs inputs_of(const GridIndex& g) const
    {
        sliding::RegressionInputs inputs = measured[g.record * axes.scale.size() + g.scale];
        inputs.yield_coefficient = model(g).downstream.law.constant / units::standard_gravity;
        return inputs;
    }
    const sliding::SkippingMotion& motion(const GridIndex& g) const
    {
        return motions[g.record * axes.scale.size() + g.scale];
    }
    const sliding::SkippingMotion& horizontal(const GridIndex& g) const
    {
        return horizontal_motions[g.record * axes.scale.size() + g.scale];
    }
};

Grid make_grid(const Scene& scene, const Axes& axes, const std::vector<RecordPair>& records, int jobs)
{
    Grid grid;
    grid.axes = axes;
    SeepageSource source;
    grid.models.resize(axes.friction.size() * axes.level.size() * axes.uplift.size() * axes.reservoir.size());
    parallel_for(grid.models.size(), jobs, [&](std::size_t i) {
        std::size_t rest = i;
        const std::string& reservoir = axes.reservoir[rest % axes.reservoir.size()];
        rest /= axes.reservoir.size();
        const std::string& uplift = axes.uplift[rest % axes.uplift.size()];
        rest /= axes.uplift.size();
        Scene here = variant(scene, axes.level[rest % axes.level.size()], uplift, reservoir);
        const double friction = axes.friction[rest / axes.level.size()];
        if (friction != here.contact.friction) here = with_friction(std::move(here), friction);
        grid.models[i] = make_rigid_model(here, source.profile_of(here));
    });
    for (const RecordPair& pair : records) {
        grid.records.push_back(pair.files.name);
        for (const double scale : axes.scale) {
            const GroundMotion motion = ground_motion(scene, pair, scale);
            grid.measured.push_back(regression_inputs(pair, motion, grid.models.front()));
            grid.horizontal_motions.emplace_back(horizontal_only(motion));
            grid.motions.emplace_back(motion);
        }
    }
    return grid;
}

/// Median and band of a regression in the columns of a row.
std::vector<Cell> regression_cells(const sliding::Regression& regression, const sliding::RegressionInputs& inputs)
{
    const sliding::RegressionResult r = sliding::evaluate(regression, inputs);
    const auto metres = [](const std::optional<double>& value_cm) {
        return value_cm ? Cell(*value_cm * units::cm) : Cell();
    };
    std::string status;
    for (const std::string& warning : r.warnings) status += (status.empty() ? "" : "; ") + warning;
    return {metres(r.median_cm), metres(r.median_cm), Cell{}, metres(r.minus_sd_cm), metres(r.plus_sd_cm), status};
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
    if (method == "rigid-v" && !grid.motion(g).has_vertical())
        return rest({Cell{}, Cell{}, Cell{}, Cell{}, Cell{}, std::string("no vertical component")});
    if (const sliding::Regression* regression = sliding::find_regression(method))
        return rest(regression_cells(*regression, grid.inputs_of(g)));
    const sliding::SlideResult r =
        slide_model(scene, model, method == "rigid" ? grid.horizontal(g) : grid.motion(g), polarity);
    return rest({r.slip, r.max_slip, r.upstream_slip, Cell{}, Cell{}, status_word(r.status)});
}

} // namespace

std::vector<std::string> sweep_methods()
{
    std::vector<std::string> methods{"rigid", "rigid-v"};
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
    const Grid grid = make_grid(given, axes, records, arguments.jobs);
    if (grid.size() > 20'000'000)
        usage(fmt::format("the grid has {} rows.", grid.size()), "at most 20 million", "split it");

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
        text = j.dump(2) + "\n";
    } else {
        text = report::csv(table, {"damslip " + program_version() + " sweep", "scene " + scene_hash(given)});
    }
    if (arguments.out.empty())
        streams.out << text;
    else
        write_file(arguments.out, text);
    if (!streams.quiet)
        streams.talk << fmt::format("{} rows{}\n", grid.size(),
                                    arguments.out.empty() ? "" : " in " + arguments.out.string());
    return exit_ok;
}

} // namespace damslip::cli
