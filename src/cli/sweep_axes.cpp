#include "cli/sweep_axes.hpp"

#include "cli/number_list.hpp"
#include "cli/usage_error.hpp"
#include "core/units.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::cli {

namespace {

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

} // namespace

bool Axes::has(const std::string& name) const
{
    return std::find(method.begin(), method.end(), name) != method.end();
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

} // namespace damslip::cli
