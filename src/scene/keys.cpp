#include "core/units.hpp"
#include "scene/key_table.hpp"

#include <set>

namespace damslip {

namespace {

// Units by quantity; the first is canonical.
const Units none{{"", 1.0}};
const Units length{{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"ft", 0.3048}};
const Units small_length{{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"ft", 0.3048}, {"in", 0.0254}};
const Units angle{{"deg", units::degree}, {"rad", 1.0}};
const Units seconds{{"s", 1.0}, {"ms", 1e-3}};
const Units acceleration{{"m_s2", 1.0}, {"g", units::standard_gravity}, {"cm_s2", 0.01}};
const Units density{{"kg_m3", 1.0}, {"t_m3", 1000.0}};
const Units modulus{{"GPa", 1e9}, {"MPa", 1e6}, {"Pa", 1.0}};
const Units bulk{{"MPa", 1e6}, {"GPa", 1e9}, {"Pa", 1.0}};
const Units stress{{"kPa", 1e3}, {"MPa", 1e6}, {"Pa", 1.0}};
const Units line_force{{"kN_m", 1e3}, {"MN_m", 1e6}, {"N_m", 1.0}};
const Units unit_weight{{"kN_m3", 1e3}, {"N_m3", 1.0}};
const Units conductivity{{"m_s", 1.0}, {"cm_s", 0.01}};
const Units friction{{"", 1.0}, {"deg", 1.0, true}};
const Units subgrade{{"N_m3", 1.0}, {"MN_m3", 1e6}, {"GN_m3", 1e9}};
const Units per_second{{"1_s", 1.0}};

template <class T, class Member>
std::function<Slot(void*)> at(Member T::*member)
{
    return [member](void* object) -> Slot { return &(static_cast<T*>(object)->*member); };
}

template <class T, class Enum>
std::function<Slot(void*)> choice(Enum T::*member, std::vector<std::pair<std::string, Enum>> words)
{
    return [member, words](void* object) -> Slot {
        Choice c;
        for (const auto& [word, value] : words) c.words.push_back(word);
        Enum* slot = &(static_cast<T*>(object)->*member);
        c.set = [slot, words](int i) { *slot = words[static_cast<std::size_t>(i)].second; };
        c.get = [slot, words] {
            for (std::size_t i = 0; i < words.size(); ++i)
                if (words[i].second == *slot) return static_cast<int>(i);
            return 0;
        };
        return c;
    };
}

/// An optional enumeration: absent until the file names a word.
template <class T, class Enum>
std::function<Slot(void*)> optional_choice(std::optional<Enum> T::*member,
                                           std::vector<std::pair<std::string, Enum>> words)
{
    return [member, words](void* object) -> Slot {
        Choice c;
        for (const auto& [word, value] : words) c.words.push_back(word);
        std::optional<Enum>* slot = &(static_cast<T*>(object)->*member);
        c.set = [slot, words](int i) { *slot = words[static_cast<std::size_t>(i)].second; };
        c.get = [slot, words] {
            for (std::size_t i = 0; i < words.size(); ++i)
                if (*slot == words[i].second) return static_cast<int>(i);
            return -1;
        };
        return c;
    };
}

Key number(std::string name, Units units, Range range, std::string default_text, std::string meaning,
           std::string example, std::function<Slot(void*)> slot)
{
    const bool required = default_text == "required";
    return {std::move(name),    std::move(units), {}, range, required, std::move(default_text), std::move(meaning),
            std::move(example), std::move(slot)};
}

Key word(std::string name, std::string default_text, std::string meaning, std::string example,
         std::function<Slot(void*)> slot)
{
    const bool required = default_text == "required";
    return {std::move(name), {}, {}, {}, required, std::move(default_text), std::move(meaning), std::move(example),
            std::move(slot)};
}

Key pairs(std::string name, Units first, Units second, Range range, std::string default_text, std::string meaning,
          std::string example, std::function<Slot(void*)> slot)
{
    return {std::move(name),         std::move(first),   std::move(second),  range,          false,
            std::move(default_text), std::move(meaning), std::move(example), std::move(slot)};
}

template <class T>
KeyGroup group(std::string name, std::string meaning, T Scene::*member, std::vector<Key> keys)
{
    return {std::move(name),
            Presence::always,
            std::move(meaning),
            std::move(keys),
            [member](Scene& s) -> void* { return &(s.*member); },
            [member](const Scene& s) { return std::vector<const void*>{&(s.*member)}; }};
}

template <class T>
KeyGroup optional_group(std::string name, std::string meaning, std::optional<T> Scene::*member, std::vector<Key> keys)
{
    return {std::move(name),
            Presence::optional,
            std::move(meaning),
            std::move(keys),
            [member](Scene& s) -> void* { return &(s.*member).emplace(); },
            [member](const Scene& s) {
                return (s.*member) ? std::vector<const void*>{&*(s.*member)} : std::vector<const void*>{};
            }};
}

template <class T, class List>
KeyGroup list_group(std::string name, std::string meaning, List list, std::vector<Key> keys)
{
    return {std::move(name),
            Presence::list,
            std::move(meaning),
            std::move(keys),
            [list](Scene& s) -> void* { return &list(s).emplace_back(); },
            [list](const Scene& s) {
                std::vector<const void*> items;
                for (const T& item : list(const_cast<Scene&>(s))) items.push_back(&item);
                return items;
            }};
}

const std::vector<std::pair<std::string, CrackRule>> crack_rules{{"none", CrackRule::none},
                                                                 {"static", CrackRule::fixed_static},
                                                                 {"seismic-zero", CrackRule::seismic_zero},
                                                                 {"seismic-unchanged", CrackRule::seismic_unchanged},
                                                                 {"seismic-full", CrackRule::seismic_full}};

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
                at(&S::upper_dip))},
        [&input](Scene&) -> void* { return &input; },
        [&input](const Scene& s) {
            input = SectionInput{};
            input.polygon = s.section.polygon;
            return std::vector<const void*>{&input};
        }};
    return g;
}

std::vector<Key> combination_keys()
{
    using C = Combination;
    std::vector<Key> keys{
        word("name", "required", "name in the tables", "\"flood\"", at(&C::name)),
        word(
            "kind", "usual", "how probable: decides which required values apply", "\"unusual\"",
            choice(&C::kind, std::vector<std::pair<std::string, CombinationKind>>{{"usual", CombinationKind::usual},
                                                                                  {"unusual", CombinationKind::unusual},
                                                                                  {"extreme", CombinationKind::extreme},
                                                                                  {"post-seismic",
                                                                                   CombinationKind::post_seismic}})),
        number("reservoir_level", length, Range::at_least(0), "reservoir.level_m", "water surface above the heel", "63",
               at(&C::reservoir_level)),
        number("tailwater_level", length, Range::at_least(0), "tailwater.level_m", "tailwater surface above the heel",
               "5", at(&C::tailwater_level)),
        word("ice", "false", "the [ice] thrust acts", "true", at(&C::ice)),
        word("drains_effective", "true", "false: drains without effect", "false", at(&C::drains_effective)),
        word("curtain_intact", "true", "false: ruptured curtain, linear uplift", "false", at(&C::curtain_intact)),
        word("residual_strength", "false", "true: residual friction, no cohesion", "true", at(&C::residual_strength)),
        word("crack", "uplift.crack", "uplift in a base crack", "\"static\"", optional_choice(&C::crack, crack_rules)),
        number("friction", friction, Range::above(0), "contact.friction", "Coulomb mu", "0.84", at(&C::friction)),
        number("cohesion", stress, Range::at_least(0), "contact.cohesion_kPa", "cohesion on the compressed length",
               "100", at(&C::cohesion)),
        number("k_h", none, Range::between(-5, 5), "0",
               "seismic coefficient a_h / 9.80665 m/s2, positive drives downstream", "0.1", at(&C::k_h)),
        number("k_v", none, Range::between(-5, 5), "0",
               "seismic coefficient a_v / 9.80665 m/s2, positive up: makes the dam heavier", "-0.05", at(&C::k_v)),
        number("weight_factor", none, Range::above(0), "1", "load factor on the dam's weight", "0.9",
               at(&C::weight_factor)),
        number("water_factor", none, Range::at_least(0), "1", "load factor on the water pressure", "1.1",
               at(&C::water_factor)),
        number("uplift_factor", none, Range::at_least(0), "1", "load factor on the uplift", "1.1",
               at(&C::uplift_factor)),
        number("silt_factor", none, Range::at_least(0), "1", "load factor on the silt thrust", "1.1",
               at(&C::silt_factor)),
        number("ice_factor", none, Range::at_least(0), "1", "load factor on the ice thrust", "1.1", at(&C::ice_factor)),
        number("required_sliding_factor", none, Range::above(0), "from criteria.document, else none",
               "required factor of safety against sliding", "1.5", at(&C::required_sliding_factor)),
        number("required_flotation_factor", none, Range::above(0), "none",
               "required factor of safety against flotation", "1.2", at(&C::required_flotation_factor)),
        number("required_overturning_factor", none, Range::above(0), "none",
               "required factor of safety against overturning", "1.5", at(&C::required_overturning_factor)),
        word("required_resultant", "none", "where the resultant must lie: kern, middle-half or base", "\"middle-half\"",
             at(&C::required_resultant)),
        word("source", "empty", "document the required values are taken from", "\"EM 1110-2-2100, table 3-2\"",
             at(&C::source))};
    return keys;
}

Key only_with(TimeScheme scheme, Key key)
{
    key.applies = [scheme](const void* options) { return static_cast<const TimeOptions*>(options)->scheme == scheme; };
    return key;
}

Key only_with(ContactEnforcement enforcement, Key key)
{
    key.applies = [enforcement](const void* contact) {
        return static_cast<const Contact*>(contact)->enforcement == enforcement;
    };
    return key;
}

Key only_with(NormalContact normal, Key key)
{
    key.applies = [normal](const void* contact) { return static_cast<const Contact*>(contact)->normal == normal; };
    return key;
}

Key only_with(JointPath sliding, Key key)
{
    key.applies = [sliding](const void* contact) { return static_cast<const Contact*>(contact)->sliding == sliding; };
    return key;
}

Key without_substeps(Key key)
{
    key.applies = [](const void* options) { return !static_cast<const TimeOptions*>(options)->substeps; };
    return key;
}

Key with_residual(Key key)
{
    key.applies = [](const void* contact) {
        return static_cast<const Contact*>(contact)->residual_friction.has_value();
    };
    return key;
}

/// A key of the contact strength as a key of the lift joint that has it.
Key of_joint(Key key)
{
    const auto strength = [](const void* joint) { return &static_cast<const LiftJoint*>(joint)->strength; };
    key.slot = [slot = key.slot, strength](void* joint) { return slot(const_cast<Contact*>(strength(joint))); };
    if (key.applies)
        key.applies = [applies = key.applies, strength](const void* joint) { return applies(strength(joint)); };
    return key;
}

/// @param contact  keys of [contact]; those of the strength are keys of every joint
std::vector<Key> lift_joint_keys(const std::vector<Key>& contact)
{
    using J = LiftJoint;
    static const std::set<std::string> of_strength{"friction",      "cohesion",      "cohesion_lost_at_slip",
                                                   "residual_slip", "residual_path", "residual_friction",
                                                   "friction_table"};
    std::vector<Key> keys{word("name", "lift joint and its number", "name in the tables", "\"neck\"", at(&J::name)),
                          number("elevation", length, Range::any(), "required", "of the joint above the heel", "51.5",
                                 at(&J::elevation))};
    for (const Key& key : contact)
        if (of_strength.contains(key.name)) keys.push_back(of_joint(key));
    keys.push_back(word(
        "water", "none",
        "water in the joint, open or not: none, or linear from the head of the reservoir at the upstream face to that "
        "of the tailwater at the downstream face, 0 at a dry face",
        "\"linear\"",
        choice(&J::water, std::vector<std::pair<std::string, JointWater>>{{"none", JointWater::none},
                                                                          {"linear", JointWater::linear}})));
    return keys;
}

std::vector<KeyGroup> fe_groups()
{
    std::vector<KeyGroup> groups;
    groups.push_back(group(
        "mesh", "Finite-element mesh.", &Scene::mesh,
        {number("size", length, Range::above(0), "height / 40", "element size in the dam", "1.5",
                at(&MeshOptions::size)),
         number("contact_size", length, Range::above(0), "base / 60, at most size", "element size on the contact plane",
                "0.75", at(&MeshOptions::contact_size)),
         number("rock_contact_size", length, Range::above(0), "the dam's nodes",
                "element size on the rock's side of the contact plane, whose nodes then need not face the dam's; runs "
                "with a tied base have facing nodes always",
                "1.125", at(&MeshOptions::rock_contact_size)),
         number("growth", none, Range::between(1, 3), "1.15",
                "ratio of neighbouring element sizes away from the contact plane", "1.2", at(&MeshOptions::growth)),
         word("element", "q4-incompatible", "element type", "\"q4\"",
              choice(&MeshOptions::element,
                     std::vector<std::pair<std::string, ElementKind>>{{"q4-incompatible", ElementKind::q4_incompatible},
                                                                      {"q4", ElementKind::q4},
                                                                      {"t3", ElementKind::t3}}))}));
    groups.push_back(group(
        "stages", "How the static state before the earthquake comes about.", &Scene::stages,
        {word("gravity", "dam", "what has weight", "\"dam-and-rock\"",
              choice(&Stages::gravity,
                     std::vector<std::pair<std::string, GravityStage>>{
                         {"dam", GravityStage::dam}, {"dam-and-rock", GravityStage::dam_and_rock}})),
         word("geostatic", "false", "displacements are set to zero after the gravity stage, stresses stay", "true",
              at(&Stages::geostatic)),
         word("pore_pressure", "none",
              "water in the rock: `total` (pressures on both joint faces, internal term) or `effective` (body force)",
              "\"total\"",
              choice(&Stages::pore_pressure,
                     std::vector<std::pair<std::string, PorePressure>>{{"none", PorePressure::none},
                                                                       {"total", PorePressure::total},
                                                                       {"effective", PorePressure::effective}}))}));
    groups.push_back(
        group("damping", "Structural damping of the FE model.", &Scene::damping,
              {word("method", "rayleigh", "how the coefficients are found", "\"modified-rayleigh\"",
                    choice(&Damping::method,
                           std::vector<std::pair<std::string, DampingMethod>>{
                               {"rayleigh", DampingMethod::rayleigh},
                               {"modified-rayleigh", DampingMethod::modified_rayleigh},
                               {"none", DampingMethod::none}})),
               number("ratio", none, Range::between(0, 1), "0.05", "damping ratio of the two modes", "0.05",
                      at(&Damping::ratio)),
               word("first_mode", "1", "first mode that gets the ratio, from 1", "1", at(&Damping::first_mode)),
               word("second_mode", "5", "second mode that gets the ratio", "5", at(&Damping::second_mode)),
               number("mass_coefficient", per_second, Range::at_least(0), "from ratio and modes", "a_M given directly",
                      "1.8", at(&Damping::mass_coefficient)),
               number("stiffness_coefficient", seconds, Range::at_least(0), "from ratio and modes",
                      "b_K given directly", "0.0008", at(&Damping::stiffness_coefficient)),
               word("mass", "deformation-only", "velocity the mass-proportional part resists", "\"relative\"",
                    choice(&Damping::mass, std::vector<std::pair<std::string, MassDamping>>{
                                               {"deformation-only", MassDamping::deformation_only},
                                               {"relative", MassDamping::relative},
                                               {"total", MassDamping::total}}))}));
    groups.push_back(group(
        "time", "Time integration of the FE model.", &Scene::time,
        {word("scheme", "hht", "integrator", "\"newmark\"",
              choice(&TimeOptions::scheme,
                     std::vector<std::pair<std::string, TimeScheme>>{{"hht", TimeScheme::hht},
                                                                     {"newmark", TimeScheme::newmark}})),
         only_with(TimeScheme::hht, number("alpha", none, Range::between(-1.0 / 3.0, 0), "-0.05", "HHT alpha", "-0.05",
                                           at(&TimeOptions::alpha))),
         only_with(TimeScheme::newmark, number("gamma", none, Range::between(0.5, 1.5), "0.5", "Newmark gamma", "0.5",
                                               at(&TimeOptions::gamma))),
         only_with(TimeScheme::newmark, number("beta", none, Range::half_open(0, 1), "0.25", "Newmark beta", "0.25",
                                               at(&TimeOptions::beta))),
         number("dt", seconds, Range::above(0), "the record's", "time step", "0.005", at(&TimeOptions::dt)),
         word("substeps", "chosen by slip_tolerance",
              "k of the steps dt / 2^k of FE runs with contact, 0 ... 10; fixed, without an estimate of the error", "2",
              at(&TimeOptions::substeps)),
         without_substeps(
             word("stepping", "uniform",
                  "how chosen sub-steps are spread: all alike, or small ones only where the local error of "
                  "the slip asks for them, around its beginnings, ends and turns",
                  "\"adaptive\"",
                  choice(&TimeOptions::stepping,
                         std::vector<std::pair<std::string, Stepping>>{{"uniform", Stepping::uniform},
                                                                       {"adaptive", Stepping::adaptive}}))),
         without_substeps(number("slip_tolerance", none, Range::half_open(0, 1), "0.01",
                                 "error of the FE slip over its size, to which the sub-steps are chosen", "0.01",
                                 at(&TimeOptions::slip_tolerance)))}));
    groups.push_back(
        group("analysis", "Settings of a published study as defaults; keys of the file win.", &Scene::analysis,
              {word("preset", "none",
                    "goldgruber-2015: slip-tolerance 0.005, no separation, HHT alpha -1/3, time step 0.01 s without "
                    "sub-steps, mass damping of the relative velocity",
                    "\"goldgruber-2015\"",
                    choice(&Analysis::preset, std::vector<std::pair<std::string, AnalysisPreset>>{
                                                  {"none", AnalysisPreset::none},
                                                  {"goldgruber-2015", AnalysisPreset::goldgruber_2015}}))}));
    return groups;
}

std::vector<KeyGroup> water_groups()
{
    std::vector<KeyGroup> groups;
    groups.push_back(optional_group(
        "reservoir", "Water upstream. Without this table there is none.", &Scene::reservoir,
        {number("level", length, Range::at_least(0), "crest level", "water surface above the heel", "62.5",
                at(&Reservoir::level)),
         number("density", density, Range::above(0), "1000", "density of water", "1000", at(&Reservoir::density)),
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
              "the reservoir bottom moves with the ground, or is still; its dynamic pressure never loads the rock",
              "\"still\"",
              choice(&Reservoir::bottom_motion,
                     std::vector<std::pair<std::string, BottomMotion>>{{"ground", BottomMotion::ground},
                                                                       {"still", BottomMotion::still}})),
         number("bottom_reflection", none, Range::between(-1, 1), "0.75",
                "wave reflection coefficient of the bottom under acoustic water: 1 rigid, 0 absorbs all, -1 p = 0; "
                "measured at dams: up to 0.77, rock 0.5 and more, sediments 0.1 ... 0.5 (Ghanaat & Redpath 1995)",
                "1", at(&Reservoir::bottom_reflection)),
         number("bottom_density", density, Range::above(0), "none",
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
    groups.push_back(group(
        "added_mass", "Hydrodynamic added mass, used when the reservoir moves as added mass.", &Scene::added_mass,
        {word("formula", "westergaard",
              "formula: westergaard (rigorous, 3-1), westergaard-simplified (3-4), zangar (3-8), goldgruber (3-10)",
              "\"westergaard-simplified\"",
              choice(&AddedMass::formula,
                     std::vector<std::pair<std::string, AddedMassFormula>>{
                         {"westergaard", AddedMassFormula::westergaard},
                         {"westergaard-simplified", AddedMassFormula::westergaard_simplified},
                         {"zangar", AddedMassFormula::zangar},
                         {"goldgruber", AddedMassFormula::goldgruber}})),
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
        "ice", "Ice thrust; acts in the sliding computations and in the load combinations that name it.", &Scene::ice,
        {number("force", line_force, Range::any(), "required", "thrust, positive downstream", "100", at(&Ice::force)),
         number("level", length, Range::at_least(0), "reservoir level", "where it acts above the heel", "62",
                at(&Ice::level))}));
    return groups;
}

std::vector<KeyGroup> base_groups()
{
    std::vector<KeyGroup> groups;
    groups.push_back(group(
        "contact", "Strength of the base.", &Scene::contact,
        {number("friction", friction, Range::between(0, 10), "required",
                "Coulomb mu, peak; or friction_deg, its angle (a dam on rock: 0.6 to 1.2)", "0.77",
                at(&Contact::friction)),
         number("cohesion", stress, Range::at_least(0), "0", "cohesion on the compressed length", "100",
                at(&Contact::cohesion)),
         word("cohesion_lost_at_slip", "true", "cohesion is gone from the first slip on", "false",
              at(&Contact::cohesion_lost_at_slip)),
         word("sliding", "small",
              "FE: each dam node stays opposite its rock node (small: slips well below an element), or faces the "
              "rock it has slid to (finite)",
              "\"finite\"",
              choice(&Contact::sliding, std::vector<std::pair<std::string, JointPath>>{{"small", JointPath::small},
                                                                                       {"finite", JointPath::finite}})),
         only_with(
             JointPath::finite,
             number("max_slip", length, Range::between(0.01, 100), "1",
                    "FE, sliding finite: largest slip downstream, 1 m upstream; a run that goes further stops and "
                    "says so",
                    "5", at(&Contact::max_slip))),
         number("residual_friction", friction, Range::between(0, 10), "the peak value",
                "Coulomb mu after residual_slip", "0.65", at(&Contact::residual_friction)),
         with_residual(number("residual_slip", small_length, Range::at_least(0), "0 (at first slip)",
                              "accumulated slip at which the residual value is reached", "0.01",
                              at(&Contact::residual_slip))),
         word("residual_path", "steps", "between peak and residual: a step at residual_slip, or linear in slip",
              "\"linear\"",
              choice(&Contact::residual_path,
                     std::vector<std::pair<std::string, Interpolation>>{{"steps", Interpolation::steps},
                                                                        {"linear", Interpolation::linear}})),
         pairs("friction_table", small_length, none, Range::between(0, 10), "none",
               "mu over accumulated slip, instead of peak and residual; steps or linear as residual_path says",
               "[[0, 0.84], [0.01, 0.7]]", at(&Contact::friction_table)),
         word("separation", "allowed",
              "FE: the joint opens (allowed), or carries tension without shear (none), which lowers the slip and "
              "breaks the rigid limit",
              "\"none\"",
              choice(&Contact::separation,
                     std::vector<std::pair<std::string, JointOpening>>{{"allowed", JointOpening::allowed},
                                                                       {"none", JointOpening::none}})),
         word("enforcement", "exact",
              "FE, before slip: rigid (exact), elastic with tangential_stiffness (penalty), or with elastic slip "
              "up to slip_tolerance x contact element length (slip-tolerance); the last two also run exact and "
              "state the error of the slip",
              "\"penalty\"",
              choice(&Contact::enforcement,
                     std::vector<std::pair<std::string, ContactEnforcement>>{
                         {"exact", ContactEnforcement::exact},
                         {"penalty", ContactEnforcement::penalty},
                         {"slip-tolerance", ContactEnforcement::slip_tolerance}})),
         only_with(ContactEnforcement::penalty,
                   number("tangential_stiffness", subgrade, Range::above(0), "required with penalty",
                          "enforcement penalty: shear stress per elastic slip", "1e11",
                          at(&Contact::tangential_stiffness))),
         only_with(ContactEnforcement::slip_tolerance,
                   number("slip_tolerance", none, Range::half_open(0, 1), "0.005",
                          "enforcement slip-tolerance: F_f, elastic slip at the strength over the mean length of "
                          "the contact elements (4-10)",
                          "0.005", at(&Contact::slip_tolerance))),
         word("normal", "hard",
              "FE, across the joint: no penetration (hard), or a pressure that falls with the clearance g "
              "(exponential): p = p0/(e - 1) z (exp z - 1), z = 1 - g/c0; it also runs hard contact and states the "
              "error of the slip",
              "\"exponential\"",
              choice(&Contact::normal,
                     std::vector<std::pair<std::string, NormalContact>>{{"hard", NormalContact::hard},
                                                                        {"exponential", NormalContact::exponential}})),
         only_with(NormalContact::exponential,
                   number("pressure_at_zero_clearance", stress, Range::above(0), "1000", "normal exponential: p0",
                          "1000", at(&Contact::pressure_at_zero_clearance))),
         only_with(NormalContact::exponential,
                   number("clearance_at_zero_pressure", small_length, Range::between(1e-6, 1), "0.001",
                          "normal exponential: c0, the pressure acts from this clearance on", "0.001",
                          at(&Contact::clearance_at_zero_pressure)))}));
    groups.push_back(list_group<LiftJoint>(
        "lift_joint",
        "A horizontal joint through the dam that may slide and open, for `fe`: the block above a lift or a crack. Its "
        "separation, enforcement and slip tolerance are those of [contact].",
        [](Scene& s) -> std::vector<LiftJoint>& { return s.lift_joints; }, lift_joint_keys(groups.back().keys)));
    groups.push_back(optional_group(
        "uplift", "Water pressure in the base. Without this table: seepage where a [curtain] is given, else none.",
        &Scene::uplift,
        {word("model", "seepage with [curtain], drains with [drains], else linear",
              "none; linear (heel to toe, ruptured curtain); curtain (printed 2/3 rule); drains (USACE); points; "
              "seepage (Darcy solution)",
              "\"points\"",
              choice(
                  &Uplift::model, std::vector<std::pair<std::string, UpliftModel>>{{"none", UpliftModel::none},
                                                                                   {"linear", UpliftModel::linear},
                                                                                   {"curtain", UpliftModel::curtain},
                                                                                   {"drains", UpliftModel::drains},
                                                                                   {"points", UpliftModel::points},
                                                                                   {"seepage", UpliftModel::seepage}})),
         number("curtain_ratio", none, Range::between(0, 1), "0.6666666666666666",
                "model curtain: pressure behind the curtain over that at the heel, above the toe's", "0.6667",
                at(&Uplift::curtain_ratio)),
         pairs("points", length, none, Range::between(0, 2), "none",
               "model points: distance along the base from the heel, pressure over the pressure at the heel; a "
               "repeated distance is a jump",
               "[[0, 1], [7, 0.938], [7, 0.315], [45, 0]]", at(&Uplift::points)),
         word("crack", "none", "uplift in a base crack: none, static, seismic-zero, seismic-unchanged, seismic-full",
              "\"static\"", choice(&Uplift::crack, crack_rules))}));
    groups.push_back(
        optional_group("curtain", "Grout curtain below the base.", &Scene::curtain,
                       {number("distance", length, Range::at_least(0), "required",
                               "upstream side of the curtain, from the heel", "7", at(&Curtain::distance)),
                        number("depth", length, Range::above(0), "30", "below the base", "30", at(&Curtain::depth)),
                        number("thickness", length, Range::above(0), "1", "thickness", "1", at(&Curtain::thickness)),
                        number("young_modulus", modulus, Range::above(0), "the rock's", "Young's modulus", "27",
                               at(&Curtain::young_modulus)),
                        number("poisson_ratio", none, Range{0, 0.5, false, true}, "0.2", "Poisson's ratio", "0.2",
                               at(&Curtain::poisson_ratio)),
                        number("permeability", conductivity, Range::above(0), "1e-8", "hydraulic conductivity", "1e-8",
                               at(&Curtain::permeability)),
                        word("intact", "true", "false: ruptured, it neither holds water back nor lowers the uplift",
                             "false", at(&Curtain::intact))}));
    groups.push_back(optional_group(
        "drains", "Drain line below the base (USACE EM 1110-2-2200).", &Scene::drains,
        {number("distance", length, Range::above(0), "required", "from the heel", "10", at(&Drains::distance)),
         number("efficiency", none, Range::between(0, 1), "0.6666666666666666", "E", "0.5", at(&Drains::efficiency)),
         number("depth", length, Range::above(0), "half curtain.depth_m, without curtain a quarter of the base",
                "of the line below the base, for uplift by seepage", "15", at(&Drains::depth)),
         number("gallery_level", length, Range::any(), "none",
                "drainage gallery above the heel; takes the place of a lower tailwater", "3",
                at(&Drains::gallery_level)),
         number("lost_at_slip", small_length, Range::at_least(0), "never", "slip at which the drains shear off", "0.05",
                at(&Drains::lost_at_slip))}));
    Key rock_density = number("density", density, Range::at_least(0), "0 (massless)", "rock density", "0",
                              [](void* o) -> Slot { return &static_cast<Foundation*>(o)->material.density; });
    groups.push_back(optional_group(
        "foundation", "Flexible rock. Without this table the FE base is rigid.", &Scene::foundation,
        {number("young_modulus", modulus, Range::above(0), "required", "Young's modulus of the rock", "30",
                [](void* o) -> Slot { return &static_cast<Foundation*>(o)->material.young_modulus; }),
         number("poisson_ratio", none, Range{0, 0.5, false, true}, "0.2", "Poisson's ratio", "0.2",
                [](void* o) -> Slot { return &static_cast<Foundation*>(o)->material.poisson_ratio; }),
         rock_density,
         number("width", length, Range::above(0), "6.6667 x base", "of the rock box, centred on the base", "300",
                at(&Foundation::width)),
         number("depth", length, Range::above(0), "2.2222 x base", "of the rock box below the heel", "100",
                at(&Foundation::depth)),
         number("permeability", conductivity, Range::above(0), "1e-4", "hydraulic conductivity", "1e-4",
                at(&Foundation::permeability))}));
    return groups;
}

std::vector<KeyGroup> motion_groups()
{
    std::vector<KeyGroup> groups;
    Key polarity = word("polarity", "1", "1 or -1: -1 flips the horizontal components", "-1", at(&Motion::polarity));
    groups.push_back(group(
        "motion", "Ground motion. a_h positive upstream drives the dam downstream, a_v positive up.", &Scene::motion,
        {number("scale", none, Range::at_least(0), "1", "factor on all components", "1.5", at(&Motion::scale)),
         number("scale_to_pga", acceleration, Range::above(0), "as recorded",
                "horizontal peak is made equal to this, the vertical by the same factor", "1.0",
                at(&Motion::scale_to_pga)),
         polarity,
         word("vertical", "true", "false: vertical components are left out", "false", at(&Motion::vertical))}));
    using R = RecordFiles;
    groups.push_back(list_group<R>(
        "motion.record", "One record: a horizontal component and, if there is one, its vertical.",
        [](Scene& s) -> std::vector<R>& { return s.motion.records; },
        {word("name", "file name", "name in the tables", "\"El Centro NS\"", at(&R::name)),
         word("horizontal", "required", "accelerogram file, relative to the scene file", "\"elcentro_ns.at2\"",
              at(&R::horizontal)),
         word("vertical", "none", "accelerogram file, positive up", "\"elcentro_up.at2\"", at(&R::vertical)),
         word("unit", "the file says", "unit of the samples where the file does not say: g, m/s2, cm/s2, gal, mg",
              "\"g\"", at(&R::unit)),
         number("dt", seconds, Range::above(0), "the file says", "time step of one-column files", "0.02", at(&R::dt)),
         number("magnitude", none, Range::between(2, 10), "none",
                "moment magnitude of the earthquake, for the regressions that ask for it", "6.9", at(&R::magnitude)),
         number("scale", none, Range::at_least(0), "1", "factor on this record, on top of motion.scale", "1.2",
                at(&R::scale))}));
    groups.push_back(group(
        "sliding", "Rigid-block integration.", &Scene::sliding,
        {word("scheme", "exact", "exact (events located) or slammer (the trapezoid scheme of SLAMMER)", "\"slammer\"",
              choice(&SlidingOptions::scheme,
                     std::vector<std::pair<std::string, SlidingScheme>>{{"exact", SlidingScheme::exact},
                                                                        {"slammer", SlidingScheme::slammer}})),
         word("lift_off", "no-friction",
              "while the normal force is zero: no resistance (no-friction) or vertical flight and plastic landing "
              "(ballistic)",
              "\"ballistic\"",
              choice(&SlidingOptions::lift_off,
                     std::vector<std::pair<std::string, LiftOff>>{{"no-friction", LiftOff::no_friction},
                                                                  {"ballistic", LiftOff::ballistic}})),
         word("two_way", "true", "false: no upstream sliding", "false", at(&SlidingOptions::two_way)),
         number("run_out_max", seconds, Range::between(0, 600), "60", "integration after the record's end at most",
                "60", at(&SlidingOptions::run_out_max))}));
    return groups;
}

} // namespace

std::vector<KeyGroup> key_groups(SectionInput& section)
{
    std::vector<KeyGroup> groups;
    groups.push_back({"",
                      Presence::always,
                      "Top level.",
                      {word("title", "file name", "what the scene is", "\"Reference dam\"", at(&Scene::title))},
                      [](Scene& s) -> void* { return &s; },
                      [](const Scene& s) { return std::vector<const void*>{&s}; }});
    groups.push_back(
        {"site",
         Presence::always,
         "Where the dam stands.",
         {number("gravity", {{"m_s2", 1.0}}, Range::inside(9, 10.5), "9.81",
                 "gravity in loads; the unit g of records is always 9.80665", "9.81", at(&Scene::gravity))},
         [](Scene& s) -> void* { return &s; },
         [](const Scene& s) { return std::vector<const void*>{&s}; }});
    groups.push_back(section_group(section));
    groups.push_back(
        group("dam", "Concrete of the dam, or rock of the block.", &Scene::dam,
              {number("density", density, Range::above(0), "required", "density", "2500", at(&Material::density)),
               number("young_modulus", modulus, Range::above(0), "none; FE commands ask for it", "Young's modulus",
                      "25", at(&Material::young_modulus)),
               number("poisson_ratio", none, Range{0, 0.5, false, true}, "0.2", "Poisson's ratio", "0.17",
                      at(&Material::poisson_ratio))}));
    const auto append = [&groups](std::vector<KeyGroup> more) {
        for (KeyGroup& g : more) groups.push_back(std::move(g));
    };
    append(base_groups());
    append(water_groups());
    using F = PointForce;
    groups.push_back(list_group<F>(
        "force", "A force on the dam given by the user.", [](Scene& s) -> std::vector<F>& { return s.forces; },
        {word("name", "force", "name in the tables", "\"gate\"", at(&F::name)),
         number("x", length, Range::any(), "0", "where it acts, downstream of the heel", "6",
                [](void* o) -> Slot { return &static_cast<F*>(o)->at.x; }),
         number("y", length, Range::any(), "0", "where it acts, above the heel", "60",
                [](void* o) -> Slot { return &static_cast<F*>(o)->at.y; }),
         number("force_x", line_force, Range::any(), "0", "positive downstream", "50", at(&F::force_x)),
         number("force_y", line_force, Range::any(), "0", "positive up", "-200", at(&F::force_y))}));
    append(motion_groups());
    groups.push_back(group(
        "regressions", "Empirical regressions of the slip: what they need beyond the record.", &Scene::regressions,
        {number("period", seconds, Range::between(0, 10), "0 (rigid)",
                "fundamental period of the sliding mass: for the regressions of flexible masses; above 0 `screen` also "
                "follows its vibration, decoupled from the slip and coupled to it",
                "0.3", at(&RegressionOptions::period))}));
    using W = RegressionWeightKey;
    groups.push_back(list_group<W>(
        "regressions.weight",
        "Weight of one regression in the weighted mean and band; without any, all that are valid count equally.",
        [](Scene& s) -> std::vector<W>& { return s.regressions.weights; },
        {word("model", "required", "id of a regression, as listed in docs/regressions.md", "\"jibson-2007-ratio\"",
              at(&W::model)),
         number("weight", none, Range::at_least(0), "1", "relative to the other weights", "2", at(&W::weight))}));
    groups.push_back(group(
        "criteria", "What is allowed.", &Scene::criteria,
        {number("allowable_slip", {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}}, Range::at_least(0), "none",
                "slip verdicts compare with this", "0.1", at(&Criteria::allowable_slip)),
         word("document", "none", "shipped set of required safety factors", "\"cadam3d\"", at(&Criteria::document))}));
    groups.push_back(list_group<Combination>(
        "combination",
        "A load combination of the limit equilibrium. None given: usual, seismic and post-seismic are made from the "
        "scene.",
        [](Scene& s) -> std::vector<Combination>& { return s.combinations; }, combination_keys()));
    append(fe_groups());
    return groups;
}

} // namespace damslip
