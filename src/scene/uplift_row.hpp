#pragma once

#include "scene/pressure_profile.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The table of uplift models: one row for each word of uplift.model.
namespace damslip {

/// The base as an uplift model sees it.
struct WetBase {
    double length = 0.0;        ///< along the base from heel to toe [m]
    double heel_pressure = 0.0; ///< [Pa]
    double toe_pressure = 0.0;  ///< [Pa]
};

struct UpliftRow {
    std::string word;                      ///< as in a scene file: "curtain"
    std::string meaning;                   ///< in brackets after the word, for the documents: "printed 2/3 rule"
    std::string needs;                     ///< what the scene must have for it: "a [curtain] with its distance_m"
    bool (*there)(const Scene&) = nullptr; ///< it has; null: nothing is needed
    /// Under the uncracked base, from 0 to its length. A crack puts the full head of its own end in its place as far as it goes. null: the profile
    /// is a matter of sliding/uplift, as with the models that have a rule of their own for cracks.
    PressureProfile (*profile)(const Scene&, const WetBase&) = nullptr;
    bool by_drains = false;                ///< linear where a load combination takes the drains as ineffective
    std::optional<UpliftModel> named = {}; ///< the enumerator, for models the program asks for by name
};

/// All rows; the place of a row is the value of its UpliftModel.
std::span<const UpliftRow> uplift_rows();
const UpliftRow& uplift_row(UpliftModel model);

/// The model of a word that is in the table.
UpliftModel uplift_model(std::string_view word);

/// The scene has what the model needs.
bool has_what_it_needs(const Scene& scene, const UpliftRow& row);

/// "none, linear, curtain", for help texts.
std::string uplift_words();

} // namespace damslip
