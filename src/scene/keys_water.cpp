#include "scene/added_mass_row.hpp"
#include "scene/key_parts.hpp"
#include "scene/keys.hpp"

namespace damslip::keys {

namespace {

std::vector<std::pair<std::string, AddedMassFormula>> formula_words()
{
    std::vector<std::pair<std::string, AddedMassFormula>> words;
    for (const AddedMassRow& row : added_mass_rows()) words.emplace_back(row.word, AddedMassFormula(words.size()));
    return words;
}

std::string formula_meanings()
{
    std::string text;
    for (const AddedMassRow& row : added_mass_rows())
        text += (text.empty() ? "" : ", ") + row.word + (row.meaning.empty() ? "" : " (" + row.meaning + ")");
    return text;
}

/// Left out of resolved scenes elsewhere: a floor on rock has no coefficient of its own, nor has one whose material is given; water
/// without waves has no floor on rock.
Key only_where_floor_is(ReservoirFloor floor, Key key)
{
    key.applies = [floor](const void* reservoir) {
        const auto& water = *static_cast<const Reservoir*>(reservoir);
        const bool on_rock = water.floor == ReservoirFloor::rock && water.model == ReservoirModel::acoustic;
        if (floor == ReservoirFloor::rock) return on_rock;
        return !on_rock && !water.bottom_density && !water.bottom_modulus;
    };
    return key;
}

} // namespace

std::vector<KeyGroup> water_groups()
{
    std::vector<KeyGroup> groups;
    groups.push_back(optional_group(
        "reservoir", "Water upstream. Without this table there is none.", &Scene::reservoir,
        {number("level", length, Range::at_least(0), "crest level", "water surface above the heel", "62.5",
                at(&Reservoir::level)),
         number("density", density, Range::half_open(0, 1e5), "1000", "density of water", "1000",
                at(&Reservoir::density)),
         number("bulk_modulus", bulk, Range::above(0), "2200", "bulk modulus of water", "2200",
                at(&Reservoir::bulk_modulus)),
         number("length", length, Range::above(0), "1 x level with an absorbing far end, else 2.4",
                "length of an acoustic reservoir", "150", at(&Reservoir::length)),
         word("model", "auto",
              "how the water takes part in the shaking: not at all (hydrostatic), as added mass, acoustic, or by the "
              "compressibility criterion (auto)",
              "\"added-mass\"",
              choice(&Reservoir::model,
                     std::vector<std::pair<std::string, ReservoirModel>>{{"auto", ReservoirModel::automatic},
                                                                         {"hydrostatic", ReservoirModel::hydrostatic},
                                                                         {"added-mass", ReservoirModel::added_mass},
                                                                         {"acoustic", ReservoirModel::acoustic}})),
         word("floor_pressure", "false", "water pressure on the reservoir floor loads the rock", "true",
              at(&Reservoir::floor_pressure)),
         word("overtopped", "false",
              "true: water above the crest flows over it and stands on it; a level above the crest needs this or [gate]",
              "true", at(&Reservoir::overtopped)),
         word("surface", "free", "surface of acoustic water: p = 0, or rising and falling under gravity",
              "\"sloshing\"",
              choice(&Reservoir::surface,
                     std::vector<std::pair<std::string, WaterSurface>>{{"free", WaterSurface::free},
                                                                       {"sloshing", WaterSurface::sloshing}})),
         word("far_end", "absorbing",
              "upstream end of acoustic water: waves leave it (absorbing), leave it at normal incidence only (damper), "
              "meet "
              "a wall (closed) or p = 0 (open)",
              "\"damper\"",
              choice(&Reservoir::far_end, std::vector<std::pair<std::string, FarEnd>>{{"absorbing", FarEnd::absorbing},
                                                                                      {"damper", FarEnd::damper},
                                                                                      {"closed", FarEnd::closed},
                                                                                      {"open", FarEnd::open}})),
         word("bottom_motion", "ground",
              "the reservoir bottom moves with the ground, or is still; its dynamic pressure loads the rock with floor "
              "= \"rock\" only",
              "\"still\"",
              choice(&Reservoir::bottom_motion,
                     std::vector<std::pair<std::string, BottomMotion>>{{"ground", BottomMotion::ground},
                                                                       {"still", BottomMotion::still}})),
         only_where_floor_is(ReservoirFloor::rock, word("floor", "absorbing",
                                                        "the floor under acoustic water: waves are absorbed by its "
                                                        "reflection coefficient (absorbing), or it is "
                                                        "the radiating rock of [foundation], which the water's "
                                                        "pressure moves and which moves the water (rock)",
                                                        "\"rock\"",
                                                        choice(&Reservoir::floor,
                                                               std::vector<std::pair<std::string, ReservoirFloor>>{
                                                                   {"absorbing", ReservoirFloor::absorbing},
                                                                   {"rock", ReservoirFloor::rock}}))),
         only_where_floor_is(
             ReservoirFloor::absorbing,
             number("bottom_reflection", none, Range::between(-1, 1), "0.75",
                    "wave reflection coefficient of the bottom under acoustic water: 1 rigid, 0 absorbs all, -1 p = 0; "
                    "measured at dams: up to 0.77, rock 0.5 and more, sediments 0.1 ... 0.5 (Ghanaat & Redpath 1995)",
                    "1", at(&Reservoir::bottom_reflection))),
         number("bottom_density", density, Range::half_open(0, 1e5), "none",
                "of the bottom's material; gives the reflection coefficient together with bottom_modulus", "2600",
                at(&Reservoir::bottom_density)),
         number("bottom_modulus", modulus, Range::above(0), "none", "Young's modulus of the bottom's material", "30",
                at(&Reservoir::bottom_modulus)),
         number("mesh_size", length, Range::above(0), "level / 20", "element height in acoustic water", "2",
                at(&Reservoir::mesh_size))}));
    Key period = number(
        "period", seconds, Range::above(0), "infinite (incompressible water)",
        "T of Westergaard's rigorous formula (3-1): the period of excitation or dam, longer than 4 h/c; or \"dam\"",
        "0.5", {});
    period.slot = [](void* object) -> Slot {
        auto* a = static_cast<AddedMass*>(object);
        return NumberOrWord{&a->period, &a->period_of_dam, "dam"};
    };
    groups.push_back(
        group("added_mass", "Hydrodynamic added mass, used when the reservoir moves as added mass.", &Scene::added_mass,
              {word("formula", "westergaard", "formula: " + formula_meanings(), "\"westergaard-simplified\"",
                    choice(&AddedMass::formula, formula_words())),
               period,
               word("inclined_face", "normal-component",
                    "mass normal to a sloping face: m/cos(phi) (normal-component) or the printed m", "\"printed\"",
                    choice(&AddedMass::inclined_face,
                           std::vector<std::pair<std::string, InclinedFaceRule>>{
                               {"normal-component", InclinedFaceRule::normal_component},
                               {"printed", InclinedFaceRule::printed}})),
               pairs("zangar_table", angle, none, Range::between(0, 2), "C_m = 0.73 (1 - phi/90 deg)",
                     "Zangar's C_m over the face angle from the vertical", "[[0, 0.73], [30, 0.54]]",
                     at(&AddedMass::zangar_table))}));
    groups.push_back(optional_group(
        "gate", "Gates of a spillway, in the plane of the upstream face above its upper end: their thrust, a dry crest.",
        &Scene::gate,
        {number("top", length, Range::at_least(0), "required", "top of the gates above the heel", "63",
                at(&Gate::top))}));
    groups.push_back(optional_group("tailwater", "Water downstream.", &Scene::tailwater,
                                    {number("level", length, Range::at_least(0), "required",
                                            "water surface above the heel", "5", at(&Tailwater::level))}));
    groups.push_back(optional_group("silt", "Sediment on the upstream face: thrust 1/2 K_s gamma' h^2.", &Scene::silt,
                                    {number("level", length, Range::above(0), "required",
                                            "top of the sediment above the heel", "10", at(&Silt::level)),
                                     number("submerged_unit_weight", unit_weight, Range::above(0), "required", "gamma'",
                                            "9", at(&Silt::submerged_unit_weight)),
                                     number("pressure_coefficient", none, Range::between(0, 3), "required", "K_s",
                                            "0.5", at(&Silt::pressure_coefficient))}));
    groups.push_back(optional_group(
        "ice", "Ice thrust; acts in the sliding computations, in the response-spectrum level and in the load combinations that name it.", &Scene::ice,
        {number("force", line_force, Range::any(), "required", "thrust, positive downstream", "100", at(&Ice::force)),
         number("level", length, Range::at_least(0), "reservoir level", "where it acts above the heel", "62",
                at(&Ice::level))}));
    return groups;
}

} // namespace damslip::keys
