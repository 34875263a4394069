#include "analysis/accuracy/rung.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace damslip {

namespace {

constexpr std::array<std::string_view, 4> fe_models{"fe-dry", "fe-hydrostatic", "fe-added-mass", "fe-acoustic"};

std::string_view water_model(RungWater water)
{
    return fe_models[static_cast<std::size_t>(water)];
}

/// Empty for the scene's.
std::string_view rock_word(RungRock rock)
{
    constexpr std::array<std::string_view, 3> words{"", ",rock=massless", ",rock=radiating"};
    return words[static_cast<std::size_t>(rock)];
}

std::string step_word(const Rung& rung)
{
    if (rung.step == StepChoice::by_tolerance) return "dt=auto";
    if (rung.step == StepChoice::adaptive) return "dt=adaptive";
    if (rung.step == StepChoice::as_the_scene) return "scene";
    return rung.halvings == 0 ? "dt" : fmt::format("dt/{}", 1 << rung.halvings);
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
bool apply_word(std::string_view word, Rung& rung)
{
    if (word == "dt") return true;
    if (word == "dt=auto") return rung.step = StepChoice::by_tolerance, true;
    if (word == "dt=adaptive") return rung.step = StepChoice::adaptive, true;
    if (word == "scene") return rung.step = StepChoice::as_the_scene, true;
    if (const auto parts = number_after(word, "dt/")) {
        rung.halvings = static_cast<int>(std::lround(std::log2(*parts)));
        return *parts >= 1 && rung.halvings <= 10 && *parts == std::exp2(rung.halvings);
    }
    if (const auto finer = number_after(word, "h/")) return rung.mesh = 1.0 / *finer, *finer >= 1 && *finer <= 64;
    if (std::find(quadratic_elements.begin(), quadratic_elements.end(), word) != quadratic_elements.end())
        return rung.element = word, true;
    if (const auto modes = number_after(word, "modes="))
        return rung.modes = static_cast<int>(*modes), *modes >= 2 && *modes <= 1000;
    if (const auto k = number_after(word, "stick=")) return rung.tangential_stiffness = *k, *k > 0;
    if (word == "rock=massless") return rung.rock = RungRock::massless, true;
    if (word == "rock=radiating") return rung.rock = RungRock::radiating, true;
    if (const auto size = number_after(word, "box=")) return rung.wave_box = *size, *size >= 0.2 && *size <= 5.0;
    if (const auto a = number_after(word, "alpha=")) return rung.alpha = *a, *a <= 0 && *a >= -1.0 / 3.0 - 1e-9;
    if (word.ends_with("h") && word.size() > 1) {
        const auto coarser = parse_whole_number_text(word.substr(0, word.size() - 1));
        if (coarser) rung.mesh = *coarser;
        return coarser && *coarser >= 1 && *coarser <= 64;
    }
    return false;
}

std::optional<Rung> parse_finite_elements(std::string_view model, std::string_view settings)
{
    Rung rung;
    rung.family = RungFamily::finite_elements;
    std::size_t water = 0;
    while (water < fe_models.size() && fe_models[water] != model) ++water;
    if (water == fe_models.size()) return std::nullopt;
    rung.water = static_cast<RungWater>(water);
    for (const std::string_view word : split(settings, ','))
        if (!apply_word(word, rung)) return std::nullopt;
    return rung;
}

} // namespace

std::string rung_id(const Rung& rung)
{
    switch (rung.family) {
    case RungFamily::regression:
        return "regression:" + rung.regression;
    case RungFamily::rigid:
        return model_of(rung) + (rung.scheme == RigidScheme::slammer ? ",slammer" : "");
    case RungFamily::finite_elements:
        break;
    }
    std::string id = fmt::format("{}:{}", water_model(rung.water), step_word(rung));
    if (rung.mesh != 1.0) id += "," + mesh_word(rung.mesh);
    if (!rung.element.empty()) id += "," + rung.element;
    if (rung.modes) id += fmt::format(",modes={}", *rung.modes);
    if (rung.tangential_stiffness) id += ",stick=" + shortest(*rung.tangential_stiffness);
    if (rung.alpha) id += ",alpha=" + shortest(*rung.alpha);
    id += rock_word(rung.rock);
    if (rung.wave_box != 1.0) id += ",box=" + shortest(rung.wave_box);
    return id;
}

std::optional<Rung> parse_rung(std::string_view id)
{
    const std::size_t colon = id.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const std::string_view model = id.substr(0, colon), settings = id.substr(colon + 1);
    Rung rung;
    if (model == "regression") {
        rung.family = RungFamily::regression;
        rung.regression = settings;
        return rung;
    }
    if (model != "rigid") return parse_finite_elements(model, settings);
    for (const Components components : {Components::horizontal, Components::both})
        for (const RigidScheme scheme : {RigidScheme::rocking, RigidScheme::exact, RigidScheme::slammer}) {
            rung.components = components;
            rung.scheme = scheme;
            if (rung_id(rung) == id) return rung;
        }
    return std::nullopt;
}

std::string model_of(const Rung& rung)
{
    switch (rung.family) {
    case RungFamily::regression:
        return rung_id(rung);
    case RungFamily::rigid:
        return std::string(rung.components == Components::both ? "rigid:h+v" : "rigid:h") +
               (rung.scheme == RigidScheme::rocking ? ",rocking" : "");
    case RungFamily::finite_elements:
        break;
    }
    return fmt::format("{}{}", water_model(rung.water), rock_word(rung.rock));
}

double RungResult::largest_slip() const
{
    return *std::max_element(slip.begin(), slip.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
}

std::string_view water_word(RungWater water)
{
    constexpr std::array<std::string_view, 4> words{"dry", "hydrostatic", "added mass", "acoustic"};
    return words[static_cast<std::size_t>(water)];
}

} // namespace damslip
