#pragma once

#include "scene/scene.hpp"
#include "scene/word_rows.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

/// The table of added-mass formulas: one row for each word of added_mass.formula.
namespace damslip {

/// The water in front of the dam, seen by the added-mass formulas.
struct WaterColumn {
    double depth = 0.0;           ///< h, surface above the heel [m], > 0
    double density = 1000.0;      ///< rho [kg/m^3]
    double bulk_modulus = 2200e6; ///< K [Pa]; used by the rigorous series with a finite period only
};

struct AddedMassRow {
    std::string word;                      ///< as in a scene file: "zangar"
    std::string meaning;                   ///< in brackets after the word, for the documents: "3-8"
    std::string name;                      ///< as the ablation names it: "Zangar's"
    std::string needs = {};                ///< what the scene must have for it: "an upright face"; empty: nothing
    bool (*there)(const Scene&) = nullptr; ///< it has; null: nothing is needed
    /// m_n [kg/m^2] at a point of the face, as sliding/loads/added_mass.hpp defines it. null: the formula is a matter of sliding/loads.
    /// @param depth  z below the surface [m], 0 < z <= h
    /// @param face_angle  phi from the vertical [rad], positive: the face leans away from the water
    double (*per_area)(const AddedMass&, const WaterColumn&, double depth, double face_angle) = nullptr;
    std::optional<AddedMassFormula> named = {}; ///< the enumerator, for formulas the program asks for by name
};

/// All rows; the place of a row is the value of its AddedMassFormula.
std::span<const AddedMassRow> added_mass_rows();
const AddedMassRow& added_mass_row(AddedMassFormula formula);

} // namespace damslip
