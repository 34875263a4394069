#include "analysis/accuracy/hierarchy.hpp"

#include "analysis/accuracy/accuracy.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace damslip {

namespace {

constexpr std::array<std::string_view, 4> fe_models{"fe-dry", "fe-hydrostatic", "fe-added-mass", "fe-acoustic"};

std::string_view water_model(ModelLevelWater water)
{
    return fe_models[static_cast<std::size_t>(water)];
}

/// Empty for the scene's.
std::string other_model_word(const ModelLevel& model_level)
{
    return model_level.other_model.empty() ? "" : "," + model_level.other_model;
}

std::string step_word(const ModelLevel& model_level)
{
    if (model_level.step == StepChoice::by_tolerance) return "dt=auto";
    if (model_level.step == StepChoice::adaptive) return "dt=adaptive";
    if (model_level.step == StepChoice::as_the_scene) return "scene";
    return model_level.halvings == 0 ? "dt" : fmt::format("dt/{}", 1 << model_level.halvings);
}

std::string mesh_word(double mesh)
{
    return mesh > 1.0 ? fmt::format("{:g}h", mesh) : fmt::format("h/{:g}", 1.0 / mesh);
}

constexpr std::array<std::string_view, 3> quadratic_elements{"q8", "q9", "t6"}; ///< words of mesh.element

std::vector<std::string_view> split(std::string_view text, char at)
{
    std::vector<std::string_view> words;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(at, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

/// The number after a prefix; nothing where the word does not begin with it.
std::optional<double> number_after(std::string_view word, std::string_view prefix)
{
    if (!word.starts_with(prefix)) return std::nullopt;
    return parse_whole_number_text(word.substr(prefix.size()));
}

/// @returns false for a word that says nothing
bool apply_word(std::string_view word, ModelLevel& model_level)
{
    if (word == "dt") return true;
    if (word == "dt=auto") return model_level.step = StepChoice::by_tolerance, true;
    if (word == "dt=adaptive") return model_level.step = StepChoice::adaptive, true;
    if (word == "scene") return model_level.step = StepChoice::as_the_scene, true;
    if (const auto parts = number_after(word, "dt/")) {
        model_level.halvings = static_cast<int>(std::lround(std::log2(*parts)));
        return *parts >= 1 && model_level.halvings <= 10 && *parts == std::exp2(model_level.halvings);
    }
    if (const auto finer = number_after(word, "h/")) return model_level.mesh = 1.0 / *finer, *finer >= 1 && *finer <= 64;
    if (std::find(quadratic_elements.begin(), quadratic_elements.end(), word) != quadratic_elements.end())
        return model_level.element = word, true;
    if (const auto modes = number_after(word, "modes="))
        return model_level.modes = static_cast<int>(*modes), *modes >= 2 && *modes <= 1000;
    if (const auto k = number_after(word, "stick=")) return model_level.tangential_stiffness = *k, *k > 0;
    if (find_other_model(word)) return model_level.other_model = word, true;
    if (const auto size = number_after(word, "box=")) return model_level.wave_box = *size, *size >= 0.2 && *size <= 5.0;
    if (const auto a = number_after(word, "alpha=")) return model_level.alpha = *a, *a <= 0 && *a >= -1.0 / 3.0 - 1e-9;
    if (word.ends_with("h") && word.size() > 1) {
        const auto coarser = parse_whole_number_text(word.substr(0, word.size() - 1));
        if (coarser) model_level.mesh = *coarser;
        return coarser && *coarser >= 1 && *coarser <= 64;
    }
    return false;
}

std::optional<ModelLevel> parse_finite_elements(std::string_view model, std::string_view settings)
{
    ModelLevel model_level;
    model_level.family = ModelLevelFamily::finite_elements;
    std::size_t water = 0;
    while (water < fe_models.size() && fe_models[water] != model) ++water;
    if (water == fe_models.size()) return std::nullopt;
    model_level.water = static_cast<ModelLevelWater>(water);
    for (const std::string_view word : split(settings, ','))
        if (!apply_word(word, model_level)) return std::nullopt;
    return model_level;
}

} // namespace

ModelLevel fe_model_level(ModelLevelWater water, int halvings, double mesh)
{
    ModelLevel model_level;
    model_level.family = ModelLevelFamily::finite_elements;
    model_level.water = water;
    model_level.halvings = halvings;
    model_level.mesh = mesh;
    return model_level;
}

std::string model_level_id(const ModelLevel& model_level)
{
    switch (model_level.family) {
    case ModelLevelFamily::regression:
        return "regression:" + model_level.regression;
    case ModelLevelFamily::rigid:
        return model_of(model_level) + (model_level.scheme == RigidScheme::slammer ? ",slammer" : "");
    case ModelLevelFamily::finite_elements:
        break;
    }
    std::string id = fmt::format("{}:{}", water_model(model_level.water), step_word(model_level));
    if (model_level.mesh != 1.0) id += "," + mesh_word(model_level.mesh);
    if (!model_level.element.empty()) id += "," + model_level.element;
    if (model_level.modes) id += fmt::format(",modes={}", *model_level.modes);
    if (model_level.tangential_stiffness) id += ",stick=" + shortest(*model_level.tangential_stiffness);
    if (model_level.alpha) id += ",alpha=" + shortest(*model_level.alpha);
    id += other_model_word(model_level);
    if (model_level.wave_box != 1.0) id += ",box=" + shortest(model_level.wave_box);
    return id;
}

std::optional<ModelLevel> parse_model_level(std::string_view id)
{
    const std::size_t colon = id.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const std::string_view model = id.substr(0, colon), settings = id.substr(colon + 1);
    ModelLevel model_level;
    if (model == "regression") {
        model_level.family = ModelLevelFamily::regression;
        model_level.regression = settings;
        return model_level;
    }
    if (model != "rigid") return parse_finite_elements(model, settings);
    for (const Components components : {Components::horizontal, Components::both})
        for (const RigidScheme scheme : {RigidScheme::rocking, RigidScheme::exact, RigidScheme::slammer}) {
            model_level.components = components;
            model_level.scheme = scheme;
            if (model_level_id(model_level) == id) return model_level;
        }
    return std::nullopt;
}

std::string model_of(const ModelLevel& model_level)
{
    switch (model_level.family) {
    case ModelLevelFamily::regression:
        return model_level_id(model_level);
    case ModelLevelFamily::rigid:
        return std::string(model_level.components == Components::both ? "rigid:h+v" : "rigid:h") +
               (model_level.scheme == RigidScheme::rocking ? ",rocking" : "");
    case ModelLevelFamily::finite_elements:
        break;
    }
    return fmt::format("{}{}", water_model(model_level.water), other_model_word(model_level));
}

double ModelLevelResult::largest_slip() const
{
    return *std::max_element(motions.begin(), motions.end(), [](const MotionOutcome& a, const MotionOutcome& b) {
        return std::abs(*a.slip) < std::abs(*b.slip);
    })->slip;
}

std::string_view water_word(ModelLevelWater water)
{
    constexpr std::array<std::string_view, 4> words{"dry", "hydrostatic", "added mass", "acoustic"};
    return words[static_cast<std::size_t>(water)];
}

namespace {

constexpr int reduced_modes[] = {6, 12, 24};
constexpr double penalties[] = {2e8, 1e10, 1e11}; // [N/m^3]; the first is about Abaqus' slip tolerance of 0.005
constexpr double wave_boxes[] = {0.7, 1.4};       // of radiating rock, over the automatic one
constexpr int finest_step = 7;                    // halvings
constexpr double finest_mesh = 0.125;             // element sizes over the scene's
constexpr double quadratic_unknowns = 3.0;        // of Q8 over those of Q4 of the same size
constexpr double settled_slip = 1e-4;             // [m]: changes below the tolerance's share of it do not matter

const ModelLevelResult* find(const std::vector<ModelLevelResult>& results, const ModelLevel& model_level)
{
    const auto at = std::find_if(results.begin(), results.end(), [&](const ModelLevelResult& r) { return r.model_level == model_level; });
    return at == results.end() ? nullptr : &*at;
}

bool of_model(const ModelLevelResult& r, ModelLevelWater water)
{
    return r.done() && r.model_level.family == ModelLevelFamily::finite_elements && r.model_level.water == water && r.model_level.plain();
}

/// Does what the finest model level of a row or column leaves open no longer matter, for every motion, by an order that can be
/// believed?
/// @param elsewhere  row that shows an order where this one has two model levels only; may be empty
bool settled(const std::vector<const ModelLevelResult*>& row, double tolerance,
             const std::vector<const ModelLevelResult*>& elsewhere = {})
{
    for (std::size_t motion = 0; motion < row.back()->motions.size(); ++motion) {
        const std::vector<double> slips = slips_of(row, motion);
        const std::optional<Limit> limit = extrapolated(slips, 2.0, observed_order(slips_of(elsewhere, motion)));
        if (!limit || !limit->plausible() ||
            std::abs(limit->correction) > tolerance * std::max(std::abs(slips.back()), settled_slip))
            return false;
    }
    return true;
}

/// How far the row of a model goes: the halvings to run next, or the end of it.
struct Row {
    bool complete = false;
    int last = -1; ///< halvings of the last done; of the one to run next where not complete
};

Row row_of(ModelLevelWater water, const HierarchyOptions& options, const std::vector<ModelLevelResult>& so_far)
{
    const int least = options.effort == Effort::quick ? 2 : 3, most = options.effort == Effort::quick ? 4 : 6;
    const std::vector<const ModelLevelResult*> done = step_row(so_far, water);
    const int n = static_cast<int>(done.size());
    const ModelLevelResult* next = find(so_far, fe_model_level(water, n));
    if (next || n > most || (n > least && settled(done, 0.25 * options.tolerance))) return {true, n - 1};
    return {false, n};
}

void add_variants(const HierarchyFacts& facts, ModelLevelWater water, int halvings, std::vector<ModelLevel>& model_levels)
{
    const auto variant = [&](auto&& change) {
        ModelLevel model_level = fe_model_level(water, halvings);
        change(model_level);
        model_levels.push_back(model_level);
    };
    if (facts.reducible)
        for (const int modes : reduced_modes) variant([&](ModelLevel& r) { r.modes = modes; });
    for (const double stiffness : penalties) variant([&](ModelLevel& r) { r.tangential_stiffness = stiffness; });
    for (const double alpha : facts.alphas) variant([&](ModelLevel& r) { r.alpha = alpha; });
    if (facts.radiates)
        for (const double size : wave_boxes) variant([&](ModelLevel& r) { r.wave_box = size; });
}

/// Quadratic elements of the scene's size and, where it leaves enough of them, of twice that: about as many unknowns as
/// linear ones of half and of the same size, which are model levels with the same step.
void add_elements(const HierarchyFacts& facts, ModelLevelWater water, int halvings, std::vector<ModelLevel>& model_levels)
{
    for (const double mesh : {2.0, 1.0}) {
        if (mesh > facts.coarsest) continue;
        model_levels.push_back(fe_model_level(water, halvings, mesh));
        model_levels.back().element = "q8";
    }
}

void add_cheap(const HierarchyFacts& facts, std::vector<ModelLevel>& model_levels)
{
    for (const std::string& id : facts.regressions) {
        ModelLevel model_level;
        model_level.family = ModelLevelFamily::regression;
        model_level.regression = id;
        model_levels.push_back(model_level);
    }
    for (const Components components : {Components::horizontal, Components::both}) {
        if (components == Components::both && !facts.vertical) continue;
        ModelLevel model_level;
        model_level.components = components;
        model_levels.push_back(model_level);
        model_level.scheme = RigidScheme::slammer;
        if (facts.slammer) model_levels.push_back(model_level);
        model_level.scheme = RigidScheme::rocking;
        if (facts.rocks) model_levels.push_back(model_level);
    }
}

} // namespace

std::vector<ModelLevel> hierarchy(const HierarchyFacts& facts, const HierarchyOptions& options, const std::vector<ModelLevelResult>& so_far)
{
    std::vector<ModelLevel> model_levels;
    add_cheap(facts, model_levels);
    std::vector<int> ends;
    for (const ModelLevelWater water : facts.waters) {
        const Row row = row_of(water, options, so_far);
        for (int k = 0; k <= row.last; ++k) model_levels.push_back(fe_model_level(water, k));
        if (!row.complete) return model_levels;
        ends.push_back(row.last);
        if (row.last < 1) continue; // not even two steps: nothing to compare beside
        ModelLevel chosen = fe_model_level(water, 0);
        chosen.step = StepChoice::by_tolerance;
        model_levels.push_back(chosen);
        chosen.step = StepChoice::adaptive;
        model_levels.push_back(chosen);
        chosen.step = StepChoice::as_the_scene;
        if (facts.own_settings) model_levels.push_back(chosen);
        for (double mesh = facts.coarsest; mesh > 1.0; mesh /= 2.0) model_levels.push_back(fe_model_level(water, row.last - 1, mesh));
        if (water == facts.waters.back() && facts.quadratic && options.effort == Effort::full)
            add_elements(facts, water, row.last - 1, model_levels);
        for (const std::string& other : facts.other_models) {
            model_levels.push_back(fe_model_level(water, row.last - 1));
            model_levels.back().other_model = other;
        }
        if (water == facts.waters.front() && options.effort == Effort::full)
            add_variants(facts, water, row.last - 1, model_levels);
        else if (water == facts.waters.front() && facts.reducible) {
            model_levels.push_back(fe_model_level(water, row.last - 1));
            model_levels.back().modes = reduced_modes[1];
        }
    }
    if (options.effort == Effort::quick || facts.waters.empty()) return model_levels;
    for (std::size_t i = 0; i < facts.waters.size(); ++i)
        if (ends[i] >= 1) model_levels.push_back(fe_model_level(facts.waters[i], ends[i] - 1, 0.5));
    const ModelLevelWater rich = facts.waters.back();
    if (ends.back() < 1) return model_levels;
    double mesh = 0.5; // of the rich model halved on until the slip is settled in the mesh too
    const ModelLevelResult* last = find(so_far, fe_model_level(rich, ends.back() - 1, mesh));
    while (last && last->done() && mesh > finest_mesh) {
        last = find(so_far, fe_model_level(rich, ends.back() - 1, 0.5 * mesh));
        if (!last && settled(mesh_column(so_far, rich), 0.25 * options.tolerance)) break;
        model_levels.push_back(fe_model_level(rich, ends.back() - 1, 0.5 * mesh));
        if (!last) return model_levels;
        if (last->done()) mesh *= 0.5;
    }
    model_levels.push_back(fe_model_level(rich, ends.back(), mesh));
    for (int k = ends.back(); k < finest_step; ++k) { // on fine meshes slips may need smaller steps than on the scene's
        const ModelLevelResult* done = find(so_far, fe_model_level(rich, k, mesh));
        if (!done || !done->done()) break;
        if (!find(so_far, fe_model_level(rich, k + 1, mesh)) &&
            settled(fine_row(so_far, rich), 0.25 * options.tolerance, step_row(so_far, rich)))
            break;
        model_levels.push_back(fe_model_level(rich, k + 1, mesh));
    }
    return model_levels;
}

bool below(const ModelLevel& a, const ModelLevel& b)
{
    if (a.family != b.family) return a.family < b.family;
    if (a.family == ModelLevelFamily::rigid) // the block that may rock above the exact one, that above SLAMMER's
        return std::pair(a.components, b.scheme) < std::pair(b.components, a.scheme);
    if (a.family == ModelLevelFamily::regression) return b.regression == "ensemble" && a.regression != "ensemble";
    if (a.water != b.water) return a.water < b.water;
    if (a.mesh != b.mesh) return a.mesh > b.mesh;
    return a.halvings < b.halvings;
}

std::optional<std::size_t> top_model_level(const std::vector<ModelLevelResult>& results)
{
    std::optional<std::size_t> top;
    for (std::size_t i = 0; i < results.size(); ++i) {
        const ModelLevelResult& r = results[i];
        if (!r.done() || (r.model_level.family == ModelLevelFamily::finite_elements && !r.model_level.plain())) continue;
        if (!top || below(results[*top].model_level, r.model_level)) top = i;
    }
    return top;
}

std::vector<const ModelLevelResult*> step_row(const std::vector<ModelLevelResult>& results, ModelLevelWater water)
{
    std::vector<const ModelLevelResult*> row;
    for (;;) {
        const ModelLevelResult* next = find(results, fe_model_level(water, static_cast<int>(row.size())));
        if (!next || !next->done()) return row;
        row.push_back(next);
    }
}

std::vector<const ModelLevelResult*> fine_row(const std::vector<ModelLevelResult>& results, ModelLevelWater water)
{
    std::vector<const ModelLevelResult*> best = step_row(results, water);
    for (double mesh = 0.5; mesh > 1e-3; mesh *= 0.5) {
        std::vector<const ModelLevelResult*> row;
        for (int k = 0; k <= 10; ++k) {
            const ModelLevelResult* next = find(results, fe_model_level(water, k, mesh));
            if (next && next->done())
                row.push_back(next);
            else if (!row.empty())
                break;
        }
        if (row.size() > 1) best = std::move(row);
    }
    return best;
}

std::vector<double> slips_of(const std::vector<const ModelLevelResult*>& model_levels, std::size_t motion)
{
    std::vector<double> slips;
    for (const ModelLevelResult* r : model_levels) slips.push_back(r->slip(motion));
    return slips;
}

std::vector<const ModelLevelResult*> mesh_column(const std::vector<ModelLevelResult>& results, ModelLevelWater water)
{
    std::vector<const ModelLevelResult*> best;
    for (int halvings = 0; halvings <= 10; ++halvings) {
        std::vector<const ModelLevelResult*> column;
        for (const ModelLevelResult& r : results)
            if (of_model(r, water) && r.model_level.halvings == halvings) column.push_back(&r);
        if (column.size() >= best.size()) best = std::move(column);
    }
    std::sort(best.begin(), best.end(),
              [](const ModelLevelResult* a, const ModelLevelResult* b) { return a->model_level.mesh > b->model_level.mesh; });
    return best;
}

std::optional<double> expected_seconds(const ModelLevel& model_level, const std::vector<ModelLevelResult>& so_far, bool corrects_steps)
{
    if (model_level.family != ModelLevelFamily::finite_elements) return std::nullopt;
    const ModelLevelResult* nearest = nullptr;
    const auto distance = [&](const ModelLevelResult& r) {
        return 10.0 * (r.model_level.water != model_level.water) + std::abs(std::log2(r.model_level.mesh / model_level.mesh)) +
               0.1 * std::abs(r.model_level.halvings - model_level.halvings);
    };
    for (const ModelLevelResult& r : so_far)
        if (r.done() && r.model_level.family == ModelLevelFamily::finite_elements && r.model_level.plain() &&
            (!nearest || distance(r) < distance(*nearest)))
            nearest = &r;
    if (!nearest) return std::nullopt;
    const double more = model_level.element.empty() ? 1.0 : std::pow(quadratic_unknowns, 1.25);
    const double unknowns = more * std::pow(nearest->model_level.mesh / model_level.mesh, 2.5);
    double steps = std::exp2(model_level.halvings);
    if (model_level.step == StepChoice::adaptive) steps = 16.0; // passes with whole steps to eighths
    if (model_level.step == StepChoice::by_tolerance) steps = corrects_steps ? 6.0 : 16.0; // quarters and few modes; the same passes
    const double run = nearest->seconds - nearest->set_up_seconds;
    const double water = nearest->model_level.water == model_level.water ? 1.0 : 2.0;
    return water * unknowns * (nearest->set_up_seconds + run * steps / std::exp2(nearest->model_level.halvings));
}

namespace {

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// The first model level of the hierarchy without a result; nothing when it has run.
std::optional<ModelLevel> next_model_level(const HierarchyFacts& facts, const HierarchyOptions& options,
                                           const std::vector<ModelLevelResult>& so_far)
{
    for (const ModelLevel& model_level : hierarchy(facts, options, so_far))
        if (!find(so_far, model_level)) return model_level;
    return std::nullopt;
}

ModelLevelResult skipped(const ModelLevel& model_level, double expected, double left)
{
    ModelLevelResult result;
    result.model_level = model_level;
    result.skipped = true;
    result.seconds = expected;
    result.remark = fmt::format("about {:.3g} s, {:.3g} s of the budget left", expected, std::max(0.0, left));
    return result;
}

} // namespace

ModelLevelResult run_repeatedly(const ModelLevel& model_level, int repeats, const HierarchyCalls& calls)
{
    ModelLevelResult result = calls.run(model_level);
    std::vector<double> seconds{result.seconds}, set_up{result.set_up_seconds};
    double spent = result.seconds;
    while (result.done() && static_cast<int>(seconds.size()) < repeats && spent + result.seconds < repeat_seconds) {
        const ModelLevelResult again = calls.run(model_level);
        if (!again.done()) break; // interrupted: the first run counts
        seconds.push_back(again.seconds);
        set_up.push_back(again.set_up_seconds);
        spent += again.seconds;
    }
    result.repeats = static_cast<int>(seconds.size());
    result.seconds = median(seconds);
    result.set_up_seconds = median(set_up);
    return result;
}

std::vector<ModelLevelResult> run_hierarchy(const HierarchyFacts& facts, const HierarchyRunOptions& options, const HierarchyCalls& calls)
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    std::vector<ModelLevelResult> results;
    while (const std::optional<ModelLevel> model_level = next_model_level(facts, options.hierarchy, results)) {
        if (calls.interrupted && calls.interrupted()) break;
        const double left = options.budget ? *options.budget - clock.seconds() : 0.0;
        const double least = calls.least_seconds ? calls.least_seconds(*model_level) : 0.0;
        const double expected = std::max(least, expected_seconds(*model_level, results, facts.corrects_steps).value_or(0.0));
        if (options.budget && expected >= left)
            results.push_back(skipped(*model_level, expected, left));
        else {
            if (calls.begins) calls.begins(*model_level);
            ModelLevelResult result = run_repeatedly(*model_level, options.repeats, calls);
            if (result.status == Status::interrupted) {
                if (!options.budget || (calls.interrupted && calls.interrupted())) break;
                result.skipped = true;
                result.remark = fmt::format("ended after {:.3g} s, when the budget was spent", result.seconds);
            }
            results.push_back(std::move(result));
        }
        if (calls.ends) calls.ends(results);
    }
    return results;
}

} // namespace damslip
