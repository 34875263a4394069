#include "analysis/accuracy/model_level.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
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

} // namespace damslip
