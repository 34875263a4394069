#include "scene/added_mass_formulas.hpp"
#include "scene/keys.hpp"

namespace damslip::keys {

KeyGroup section_group(SectionInput& input)
{
    using S = SectionInput;
    KeyGroup g{
        "section",
        Presence::always,
        "Cross-section: either `polygon_m`, or `height_m`, `base_m`, `crest_m` and what refines them, or the block of "
        "a "
        "rock slope above a plane and before a tension crack: `slope_height_m`, `face_dip_deg`, `plane_dip_deg`, "
        "`crack_distance_m`.",
        {pairs("polygon", length, length, Range::any(), "from the dimensions below",
               "vertices counter-clockwise from the heel at (0, 0); the second is the toe; the edge between them is "
               "the base",
               "[[0, 0], [45, 0], [12, 51.5], [12, 62.5], [0, 62.5]]", at(&S::polygon)),
         number("height", length, Range::above(0), "required without polygon", "crest above the heel", "62.5",
                at(&S::height)),
         number("base", length, Range::above(0), "required without polygon", "horizontal length of the base", "45",
                at(&S::base)),
         number("crest", length, Range::at_least(0), "0 (triangle)", "width of the crest", "12", at(&S::crest)),
         number("neck", length, Range::at_least(0), "0",
                "the downstream face is vertical over this height below the crest, then runs straight to the toe", "11",
                at(&S::neck)),
         number("upstream_slope", none, Range::at_least(0), "0 (vertical)",
                "batter of the upstream face, horizontal per vertical", "0.1", at(&S::upstream_slope)),
         number("upstream_slope_height", length, Range::above(0), "the whole height",
                "the upstream face slopes from the heel to this height and is vertical above", "30",
                at(&S::upstream_slope_height)),
         number("base_inclination", angle, Range::inside(-45, 45), "0",
                "dip of the base, positive downstream: the toe lies below the heel", "5", at(&S::base_inclination)),
         number("slope_height", length, Range::above(0), "no rock slope",
                "rock slope: crest above the line where the plane comes out in the face", "12", at(&S::slope_height)),
         number("face_dip", angle, Range::inside(0, 90), "required with slope_height", "rock slope: dip of the face",
                "60", at(&S::face_dip)),
         number("plane_dip", angle, Range::inside(0, 45), "required with slope_height",
                "rock slope: dip of the plane the block slides on", "35", at(&S::plane_dip)),
         number("crack_distance", length, Range::any(), "required with slope_height",
                "rock slope: the vertical tension crack behind the crest, horizontally; negative: in the face. Water "
                "in the crack is [reservoir], its level_m the depth above the foot of the crack",
                "4", at(&S::crack_distance)),
         number("upper_dip", angle, Range::inside(-45, 45), "0",
                "rock slope: dip of the ground behind the crest, positive: it falls towards the crest", "5",
                at(&S::upper_dip)),
         pairs("thickness", none, none, Range::half_open(0, 1), "1 (solid)",
               "share of the monolith's width that is concrete, over the height: [metres above the heel, share], linear in "
               "between, an elevation given twice is a step; water acts on the full width, but where gates are open",
               "[[0, 1], [48, 1], [48, 0.3], [62, 0.3]]", at(&S::thickness))},
        [&input](Scene&) -> void* { return &input; },
        [&input](const Scene& s) {
            input = SectionInput{};
            input.polygon = s.section.polygon;
            input.thickness = s.section.thickness;
            return std::vector<const void*>{&input};
        }};
    return g;
}

KeyGroup project_group()
{
    using P = Project;
    return group("project", "Title block of every report: whose work it is, and which issue of it.", &Scene::project,
                 {word("name", "none", "of the project", "\"Safety review 2026\"", at(&P::name)),
                  word("client", "none", "for whom the work is done", "\"Owner of the dam\"", at(&P::client)),
                  word("author", "none", "who made the assessment", "\"Name of the engineer\"", at(&P::author)),
                  word("checker", "none", "who has checked it", "\"Name of the checker\"", at(&P::checker)),
                  word("date", "none", "of the report, as it is to be read", "\"2026-11-23\"", at(&P::date)),
                  word("revision", "none", "issue of the report", "\"A\"", at(&P::revision)),
                  word("notes", "none", "what the reader has to know first", "\"Level by the survey of 2024.\"",
                       at(&P::notes))});
}

namespace {

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
              choice(&Reservoir::model, {{"auto", ReservoirModel::automatic},
                                         {"hydrostatic", ReservoirModel::hydrostatic},
                                         {"added-mass", ReservoirModel::added_mass},
                                         {"acoustic", ReservoirModel::acoustic}})),
         word("floor_pressure", "false", "water pressure on the reservoir floor loads the rock", "true",
              at(&Reservoir::floor_pressure)),
         word(
             "overtopped", "false",
             "true: water above the crest flows over it and stands on it; a level above the crest needs this or [gate]",
             "true", at(&Reservoir::overtopped)),
         word("surface", "free", "surface of acoustic water: p = 0, or rising and falling under gravity",
              "\"sloshing\"",
              choice(&Reservoir::surface, {{"free", WaterSurface::free}, {"sloshing", WaterSurface::sloshing}})),
         word("far_end", "absorbing",
              "upstream end of acoustic water: waves leave it (absorbing), leave it at normal incidence only (damper), "
              "meet "
              "a wall (closed) or p = 0 (open)",
              "\"damper\"",
              choice(&Reservoir::far_end, {{"absorbing", FarEnd::absorbing},
                                           {"damper", FarEnd::damper},
                                           {"closed", FarEnd::closed},
                                           {"open", FarEnd::open}})),
         word("bottom_motion", "ground",
              "the reservoir bottom moves with the ground, or is still; its dynamic pressure loads the rock with floor "
              "= \"rock\" only",
              "\"still\"",
              choice(&Reservoir::bottom_motion, {{"ground", BottomMotion::ground}, {"still", BottomMotion::still}})),
         only_where_floor_is(ReservoirFloor::rock,
                             word("floor", "absorbing",
                                  "the floor under acoustic water: waves are absorbed by its reflection coefficient "
                                  "(absorbing), or it is the radiating rock of [foundation], which the water's "
                                  "pressure moves and which moves the water (rock)",
                                  "\"rock\"",
                                  choice(&Reservoir::floor,
                                         {{"absorbing", ReservoirFloor::absorbing}, {"rock", ReservoirFloor::rock}}))),
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
    groups.push_back(
        group("added_mass", "Hydrodynamic added mass, used when the reservoir moves as added mass.", &Scene::added_mass,
              {word("formula", "westergaard", "formula: " + meanings_of(added_mass_rows(), ", "),
                    "\"westergaard-simplified\"",
                    choice(&AddedMass::formula, choices_of<AddedMassFormula>(added_mass_rows()))),
               number("period", seconds, Range::above(0), "infinite (incompressible water)",
                      "T of Westergaard's rigorous formula (3-1): the period of excitation or dam, longer than 4 h/c; "
                      "or \"dam\"",
                      "0.5", number_or_word(&AddedMass::period, &AddedMass::period_of_dam, "dam")),
               word("inclined_face", "normal-component",
                    "mass normal to a sloping face: m/cos(phi) (normal-component), the printed m, or of the first only "
                    "the push downstream, without its vertical part (horizontal), as in codes and textbooks",
                    "\"printed\"",
                    choice(&AddedMass::inclined_face, {{"normal-component", InclinedFaceRule::normal_component},
                                                       {"printed", InclinedFaceRule::printed},
                                                       {"horizontal", InclinedFaceRule::horizontal}})),
               pairs("zangar_table", angle, none, Range::between(0, 2), "C_m = 0.73 (1 - phi/90 deg)",
                     "Zangar's C_m over the face angle from the vertical", "[[0, 0.73], [30, 0.54]]",
                     at(&AddedMass::zangar_table))}));
    groups.push_back(optional_group(
        "gate",
        "Gates of a spillway, in the plane of the upstream face above its upper end: their thrust, a dry crest. Where "
        "section.thickness has the piers in the outline, they close the openings up to their top.",
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
        "ice",
        "Ice thrust; acts in the sliding computations, in the response-spectrum level and in the load combinations "
        "that name it.",
        &Scene::ice,
        {number("force", line_force, Range::any(), "required", "thrust, positive downstream", "100", at(&Ice::force)),
         number("level", length, Range::at_least(0), "reservoir level", "where it acts above the heel", "62",
                at(&Ice::level))}));
    return groups;
}

KeyGroup combination_group()
{
    using C = Combination;
    return list_group(
        "combination",
        "A load combination of the limit equilibrium. None given: usual, seismic and post-seismic are made from the "
        "scene.",
        &Scene::combinations,
        {word("name", "required", "name in the tables", "\"flood\"", at(&C::name)),
         word("kind", "usual", "how probable: decides which required values apply", "\"unusual\"",
              choice(&C::kind, {{"usual", CombinationKind::usual},
                                {"unusual", CombinationKind::unusual},
                                {"extreme", CombinationKind::extreme},
                                {"post-seismic", CombinationKind::post_seismic}})),
         word("follows", "the extreme combination after which its sliding factor is smallest",
              "post-seismic: name of the extreme combination that opened the joint", "\"seismic\"", at(&C::follows)),
         number("reservoir_level", length, Range::at_least(0), "reservoir.level_m", "water surface above the heel",
                "63", at(&C::reservoir_level)),
         number("tailwater_level", length, Range::at_least(0), "tailwater.level_m", "tailwater surface above the heel",
                "5", at(&C::tailwater_level)),
         word("ice", "false", "the [ice] thrust acts", "true", at(&C::ice)),
         word("drains_effective", "true", "false: drains without effect", "false", at(&C::drains_effective)),
         word("curtain_intact", "true", "false: ruptured curtain, linear uplift", "false", at(&C::curtain_intact)),
         word("residual_strength", "false", "true: residual friction, no cohesion", "true", at(&C::residual_strength)),
         word("gates_open", "false", "true: the gates of [gate] are open, the water flows over the crest", "true",
              at(&C::gates_open)),
         word("crack", "uplift.crack", "uplift in a base crack", "\"static\"", choice(&C::crack, crack_rules())),
         number("friction", friction, Range::above(0), "contact.friction", "Coulomb mu", "0.84", at(&C::friction)),
         number("cohesion", stress, Range::at_least(0), "contact.cohesion_kPa", "cohesion on the compressed length",
                "100", at(&C::cohesion)),
         number("k_h", none, Range::between(-5, 5), "0",
                "seismic coefficient a_h / 9.80665 m/s2, positive drives downstream", "0.1", at(&C::k_h)),
         number("k_v", none, Range::between(-5, 5), "0",
                "seismic coefficient a_v / 9.80665 m/s2, positive up: makes the dam heavier", "-0.05", at(&C::k_v)),
         pairs("k_profile", length, none, Range::between(0, 10), "1",
               "factor on k_h and k_v over the height above the heel, for the dam's inertia; the water takes k_h. IS "
               "1893: 1.5 at the crest, 0 at the base",
               "[[0, 0], [62.5, 1.5]]", at(&C::k_profile)),
         number("friction_divisor", none, Range::at_least(1), "1",
                "partial factor of safety that mu is divided by (IS 6512: F_phi)", "1.5", at(&C::friction_divisor)),
         number("cohesion_divisor", none, Range::at_least(1), "1",
                "partial factor of safety that the cohesion is divided by (IS 6512: F_c)", "3.6",
                at(&C::cohesion_divisor)),
         number("pga_fraction", none, Range::half_open(0, 2), "none",
                "in place of k_h: share of the largest PGA of the records, drives downstream", "0.67",
                at(&C::pga_fraction)),
         number("pga_v_fraction", none, Range::between(0, 2), "none",
                "in place of k_v: share of the records' largest vertical acceleration; it lightens the dam", "0.3",
                at(&C::pga_v_fraction)),
         number("weight_factor", none, Range::above(0), "1", "load factor on the dam's weight", "0.9",
                at(&C::weight_factor)),
         number("water_factor", none, Range::at_least(0), "1", "load factor on the water pressure", "1.1",
                at(&C::water_factor)),
         number("uplift_factor", none, Range::at_least(0), "1", "load factor on the uplift", "1.1",
                at(&C::uplift_factor)),
         number("silt_factor", none, Range::at_least(0), "1", "load factor on the silt thrust", "1.1",
                at(&C::silt_factor)),
         number("ice_factor", none, Range::at_least(0), "1", "load factor on the ice thrust", "1.1",
                at(&C::ice_factor)),
         number("required_sliding_factor", none, Range::above(0), "from criteria.document, else none",
                "required factor of safety against sliding", "1.5", at(&C::required_sliding_factor)),
         number("required_residual_factor", none, Range::above(0), "from criteria.document, else none",
                "required factor of safety against sliding, of the residual strength", "1.1",
                at(&C::required_residual_factor)),
         number("required_flotation_factor", none, Range::above(0), "none",
                "required factor of safety against flotation", "1.2", at(&C::required_flotation_factor)),
         number("required_overturning_factor", none, Range::above(0), "none",
                "required factor of safety against overturning", "1.5", at(&C::required_overturning_factor)),
         word("required_resultant", "none",
              "where the resultant must lie: kern (the middle third), middle-half, or base (anywhere within it)",
              "\"middle-half\"", at(&C::required_resultant)),
         word("source", "empty", "document the required values are taken from", "\"EM 1110-2-2100, table 3-2\"",
              at(&C::source))});
}

} // namespace damslip::keys
