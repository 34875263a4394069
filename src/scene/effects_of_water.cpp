#include "scene/added_mass_formulas.hpp"
#include "scene/check.hpp"
#include "scene/uplift_models.hpp"
#include "scene/effect_plan.hpp"
#include "scene/joint_bond.hpp"
#include "scene/rock_mass.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

/// Bulk modulus of water that counts as incompressible over the given one: waves a hundred times as fast, so pressures of
/// frequencies up to the reservoir's first differ from incompressible water's by less than (1/100)^2 [-].
constexpr double stiff_water_factor = 1e4;

Decision decide_hydrodynamic_mass(const Scene& s, Method method)
{
    if (!s.reservoir) return {false, "no [reservoir]", ""};
    switch (s.reservoir->model) {
    case ReservoirModel::hydrostatic:
        return {false, "reservoir.model = \"hydrostatic\"", ""};
    case ReservoirModel::acoustic:
        if (method == Method::finite_elements) return {false, "reservoir.model = \"acoustic\" takes its place", ""};
        return {true, "reservoir.model = \"acoustic\": a rigid block has added mass instead",
                "one quadrature over the wet face"};
    case ReservoirModel::automatic:
        return {true, "reservoir.model = \"auto\": added mass", "one quadrature over the wet face"};
    case ReservoirModel::added_mass:
        break;
    }
    return {true, "reservoir.model = \"added-mass\"", "one quadrature over the wet face"};
}

bool is_acoustic(const Scene& s, Method method)
{
    return method == Method::finite_elements && s.reservoir && s.reservoir->model == ReservoirModel::acoustic;
}

Decision decide_table(bool there, const char* table, const char* cost)
{
    return decided(there, fmt::format("[{}] is given", table), fmt::format("no [{}]", table), cost);
}

/// Effects of acoustic water alone.
Decision of_acoustic_water(const Scene& s, Method method, bool on, std::string yes, std::string no, std::string cost)
{
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    if (!is_acoustic(s, method)) return {false, "reservoir is not acoustic", ""};
    return decided(on, std::move(yes), std::move(no), std::move(cost));
}

Decision decide_water_compressibility(const Scene& s, Method method)
{
    if (!s.reservoir) return {false, "no [reservoir]", ""};
    if (s.reservoir->model == ReservoirModel::hydrostatic) return {false, "reservoir.model = \"hydrostatic\"", ""};
    if (is_acoustic(s, method))
        return {true, "reservoir.bulk_modulus_MPa of acoustic water", "part of the water's matrix"};
    if (s.added_mass.formula == AddedMassFormula::westergaard && (s.added_mass.period || s.added_mass.period_of_dam))
        return {true, "added_mass.period_s",
                s.added_mass.period_of_dam ? "modes of the dam until the period agrees" : "none"};
    return {false, "added mass of incompressible water", ""};
}

Decision decide_bottom_absorption(const Scene& s, Method method)
{
    if (floor_on_rock(s))
        return of_acoustic_water(s, method, true, "reservoir.floor = \"rock\"", "",
                                 "the floor's nodes in every product with the rock");
    const bool by_material = s.reservoir && s.reservoir->bottom_density && s.reservoir->bottom_modulus;
    return of_acoustic_water(s, method, by_material || (s.reservoir && s.reservoir->bottom_reflection < 1.0),
                             by_material ? "reservoir.bottom_density_kg_m3 and bottom_modulus_GPa"
                                         : "reservoir.bottom_reflection < 1",
                             "reservoir.bottom_reflection = 1", "a damper on each node of the bottom");
}

Decision decide_moving_bottom(const Scene& s, Method method)
{
    const bool moves = s.reservoir && s.reservoir->bottom_motion == BottomMotion::ground;
    const bool vertical = any_vertical_record(s) && s.motion.vertical;
    return of_acoustic_water(s, method, moves && vertical, "reservoir.bottom_motion = \"ground\", vertical motion",
                             moves ? "no vertical motion" : "reservoir.bottom_motion = \"still\"",
                             "one more load on the water");
}

Decision decide_wave_radiation(const Scene& s, Method method)
{
    const FarEnd end = s.reservoir ? s.reservoir->far_end : FarEnd::closed;
    const bool leaves = end == FarEnd::absorbing || end == FarEnd::damper;
    return of_acoustic_water(
        s, method, leaves,
        end == FarEnd::absorbing ? "reservoir.far_end = \"absorbing\"" : "reservoir.far_end = \"damper\"",
        end == FarEnd::closed ? "reservoir.far_end = \"closed\"" : "reservoir.far_end = \"open\"",
        end == FarEnd::absorbing ? "layers at the far end" : "a damper on each node of the far end");
}

Decision decide_floor_pressure(const Scene& s, Method method)
{
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    const bool wanted = s.reservoir && s.reservoir->floor_pressure;
    if (!wanted) return {false, s.reservoir ? "reservoir.floor_pressure = false" : "no [reservoir]", ""};
    if (!s.foundation) return {false, "no [foundation]: rigid base", ""};
    return {true, "reservoir.floor_pressure = true", "static nodal forces on the rock"};
}

std::string formula_name(const AddedMass& mass)
{
    if (mass.formula == AddedMassFormula::westergaard && (mass.period || mass.period_of_dam))
        return "Westergaard's series with its period";
    return added_mass_row(mass.formula).name;
}

RemovalAnswer without_compressibility(Scene s, const SeepagePoints&)
{
    if (s.reservoir->model == ReservoirModel::acoustic) {
        s.reservoir->bulk_modulus *= stiff_water_factor;
        return Removal{s, fmt::format("reservoir.bulk_modulus times {:.0e}, acoustic water still", stiff_water_factor)};
    }
    s.added_mass.period.reset();
    s.added_mass.period_of_dam = false;
    return Removal{s, "added mass without its period: incompressible water"};
}

RemovalAnswer without_wave_radiation(Scene s, const SeepagePoints&)
{
    s.reservoir->far_end = FarEnd::closed;
    s.reservoir->length = std::max(s.reservoir->length, 2.4 * s.reservoir->level);
    return Removal{s, fmt::format("reservoir.far_end = \"closed\", a wall {:.4g} m upstream", s.reservoir->length)};
}

} // namespace

std::vector<EffectRow> water_effects()
{
    return {
        {.name = "hydrodynamic added mass",
         .decide = decide_hydrodynamic_mass,
         .take_out = [](Scene& s) { s.reservoir->model = ReservoirModel::hydrostatic; },
         .instead = "reservoir.model = \"hydrostatic\": water that does not move",
         .leave_out =
             [](Scene& s, const EffectPlan& plan) {
                 if (s.reservoir && !plan.on(Effect::acoustic_water)) s.reservoir->model = ReservoirModel::hydrostatic;
             },
         .named = Effect::hydrodynamic_mass},
        {.name = "acoustic water",
         .decide =
             [](const Scene& s, Method method) {
                 return of_acoustic_water(s, method, true, "reservoir.model = \"acoustic\"", "",
                                          "one unknown per water node");
             },
         .answer = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.reservoir->model = ReservoirModel::added_mass;
             return Removal{s, fmt::format("reservoir.model = \"added-mass\": {}", formula_name(s.added_mass))};
         },
         .named = Effect::acoustic_water},
        {.name = "water compressibility",
         .decide = decide_water_compressibility,
         .answer = without_compressibility,
         .part_of = {Effect::acoustic_water, Effect::hydrodynamic_mass},
         .named = Effect::water_compressibility},
        {.name = "bottom absorption",
         .decide = decide_bottom_absorption,
         .take_out =
             [](Scene& s) {
                 s.reservoir->floor = ReservoirFloor::absorbing;
                 s.reservoir->bottom_reflection = 1.0;
                 s.reservoir->bottom_density.reset();
                 s.reservoir->bottom_modulus.reset();
             },
         .instead = "reservoir.bottom_reflection = 1: every wave comes back from the bottom",
         .part_of = {Effect::acoustic_water},
         .named = Effect::bottom_absorption},
        {.name = "moving reservoir bottom",
         .decide = decide_moving_bottom,
         .take_out = [](Scene& s) { s.reservoir->bottom_motion = BottomMotion::still; },
         .instead = "reservoir.bottom_motion = \"still\": no pressure by the floor's vertical motion",
         .part_of = {Effect::acoustic_water},
         .named = Effect::moving_bottom},
        {.name = "wave radiation upstream",
         .decide = decide_wave_radiation,
         .answer = without_wave_radiation,
         .part_of = {Effect::acoustic_water},
         .named = Effect::wave_radiation},
        {.name = "surface waves",
         .decide =
             [](const Scene& s, Method method) {
                 return of_acoustic_water(s, method, s.reservoir && s.reservoir->surface == WaterSurface::sloshing,
                                          "reservoir.surface = \"sloshing\"", "reservoir.surface = \"free\": p = 0",
                                          "pressures of the surface");
             },
         .take_out = [](Scene& s) { s.reservoir->surface = WaterSurface::free; },
         .instead = "reservoir.surface = \"free\": p = 0",
         .part_of = {Effect::acoustic_water},
         .named = Effect::surface_waves},
        {.name = "floor pressure",
         .decide = decide_floor_pressure,
         .take_out = [](Scene& s) { s.reservoir->floor_pressure = false; },
         .instead = "reservoir.floor_pressure = false",
         .part_of = {Effect::rock_flexibility},
         .named = Effect::floor_pressure},
    };
}

namespace {

bool uplift_acts(const Scene& s)
{
    return s.uplift && s.uplift->model != UpliftModel::none;
}

Decision decide_uplift(const Scene& s, Method)
{
    if (!s.uplift) return {false, "no [uplift]", ""};
    if (!uplift_acts(s))
        return {false,
                std::string("uplift.model = \"none\"") + (base_taken_as_dry(s) ? ": the base is taken as dry" : ""),
                ""};
    return {true, std::string("uplift.model = \"") + word(s.uplift->model) + "\"", "one pressure profile"};
}

Decision decide_base_crack(const Scene& s, Method method)
{
    if (method == Method::finite_elements)
        return {false,
                s.uplift && s.uplift->water.opening != OpeningWater::unchanged
                    ? "finite elements: the joint opens by itself, its water by uplift.opening"
                    : "finite elements: the joint opens by itself, the uplift stays",
                ""};
    const bool on = uplift_acts(s) && s.uplift->crack != CrackRule::none;
    return {on, on ? "uplift.crack" : "uplift.crack = \"none\" (limit equilibrium shows both)",
            "crack and uplift iterated per state"};
}

/// Drains beside an uplift that does not read them change nothing, and stay in the scene for variants whose uplift does.
Decision decide_drains(const Scene& s, Method method)
{
    if (!s.drains) return {false, "no [drains]", ""};
    if (method == Method::finite_elements ? drains_are_read(s) : drains_lower_uplift(s))
        return {true, "[drains] is given", "part of the pressure profile"};
    return {false, s.uplift ? fmt::format("not read with uplift.model = \"{}\"", word(s.uplift->model)) : "no [uplift]", ""};
}

RemovalAnswer without_seepage(Scene s, const SeepagePoints&)
{
    if (s.curtain && s.curtain->intact) {
        s.uplift->model = UpliftModel::curtain;
        return Removal{s,
                       fmt::format("uplift.model = \"curtain\": the printed profile, ratio {:.4g} behind the curtain",
                                   s.uplift->curtain_ratio)};
    }
    if (s.drains) {
        s.uplift->model = UpliftModel::drains;
        return Removal{s, "uplift.model = \"drains\": straight lines through the drains' head"};
    }
    s.uplift->model = UpliftModel::linear;
    return Removal{s, "uplift.model = \"linear\": a straight line from heel to toe"};
}

RemovalAnswer without_drains(Scene s, const SeepagePoints&)
{
    s.drains.reset();
    if (!s.uplift || s.uplift->model != UpliftModel::drains) return Removal{s, "no drains"};
    s.uplift->model = UpliftModel::linear;
    return Removal{s, "no drains: uplift.model = \"linear\""};
}

} // namespace

std::vector<EffectRow> uplift_effects()
{
    return {
        {.name = "uplift",
         .decide = decide_uplift,
         .take_out =
             [](Scene& s) { // said by name, so that the scene that was run can be read again
                 if (s.uplift) s.uplift = Uplift{.model = UpliftModel::none, .points = {}, .water = {}};
             },
         .instead = "uplift.model = \"none\": dry base",
         .taken_out_when_off = true,
         .named = Effect::uplift},
        {.name = "seepage",
         .decide =
             [](const Scene& s, Method) {
                 return decided(s.uplift && s.uplift->model == UpliftModel::seepage, "uplift.model = \"seepage\"",
                                "uplift is not by seepage", "one Darcy solution of the rock box");
             },
         .answer = without_seepage,
         .part_of = {Effect::uplift},
         .named = Effect::seepage},
        {.name = "base crack",
         .decide = decide_base_crack,
         .take_out = [](Scene& s) { s.uplift->crack = CrackRule::none; },
         .instead = "uplift.crack = \"none\"",
         .leave_out =
             [](Scene& s, const EffectPlan& plan) { // finite elements: limit equilibrium beside them needs it
                 if (plan.method == Method::rigid_block && s.uplift) s.uplift->crack = CrackRule::none;
             },
         .part_of = {Effect::uplift},
         .named = Effect::base_crack},
        {.name = "drains",
         .decide = decide_drains,
         .answer = without_drains,
         .part_of = {Effect::uplift},
         .named = Effect::drains},
    };
}

namespace {

Decision decide_opening_water(const Scene& s, Method method)
{
    if (!s.uplift || s.uplift->model == UpliftModel::none) return {false, "no uplift", ""};
    const JointWaterLaw& law = s.uplift->water;
    if (law.opening == OpeningWater::unchanged) return {false, "uplift.opening = \"unchanged\"", ""};
    const std::string reason = fmt::format("uplift.opening = \"{}\"", word(law.opening));
    if (method == Method::finite_elements)
        return {true, reason,
                law.opening == OpeningWater::reynolds
                    ? "flow along the joint in every contact problem: 1.4 times the time of a step, and shorter steps"
                    : "one pressure profile per step"};
    if (law.opening == OpeningWater::reynolds)
        return {false,
                reason +
                    ": a rigid block has no width of the joint, its uplift stays; take \"mouth\", or finite elements",
                ""};
    return {true, reason,
            law.opening == OpeningWater::mouth ? "water brought forward in 4 to 64 parts of each sample"
                                               : "crack and uplift iterated once per direction of sliding"};
}

Decision decide_water_after(const Scene& s, Method method)
{
    const bool full = s.uplift && s.uplift->water.after == WaterAfter::full;
    if (method == Method::rigid_block && (!full || s.motion.sequence.empty()))
        return {false, "rigid block: nothing is looked at after the earthquake but between two of a sequence", ""};
    return {full, full ? "uplift.after = \"full\"" : "uplift.after = \"unchanged\"", "none"};
}

} // namespace

std::vector<EffectRow> opening_water_effects()
{
    return {
        {.name = "water that follows the opening",
         .decide = decide_opening_water,
         .take_out =
             [](Scene& s) {
                 if (s.uplift) s.uplift->water = {.after = s.uplift->water.after, .mouth_speed = {}};
             },
         .instead = "uplift.opening = \"unchanged\": the pressure before the earthquake",
         .taken_out_when_off = true,
         .part_of = {Effect::uplift}},
        {.name = "water in the crack afterwards",
         .decide = decide_water_after,
         .take_out =
             [](Scene& s) {
                 if (s.uplift) s.uplift->water.after = WaterAfter::unchanged;
             },
         .instead = "uplift.after = \"unchanged\"",
         .taken_out_when_off = true,
         .part_of = {Effect::uplift}},
    };
}

std::vector<EffectRow> load_effects()
{
    return {
        {.name = "hydrostatic thrust",
         .decide = [](const Scene& s,
                      Method) { return decide_table(s.reservoir.has_value(), "reservoir", "exact face integrals"); },
         .answer = [](Scene, const SeepagePoints&) -> RemovalAnswer {
             return Stays{"without water it is another load, not another model: give the scene no [reservoir]"};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { s.reservoir.reset(); },
         .named = Effect::hydrostatic_thrust},
        {.name = "tailwater",
         .decide = [](const Scene& s,
                      Method) { return decide_table(s.tailwater.has_value(), "tailwater", "exact face integrals"); },
         .take_out =
             [](Scene& s) {
                 s.tailwater.reset();
                 for (Combination& c : s.combinations) c.tailwater_level.reset();
             },
         .instead = "no [tailwater]",
         .leave_out = [](Scene& s, const EffectPlan&) { s.tailwater.reset(); },
         .named = Effect::tailwater},
        {.name = "silt",
         .decide = [](const Scene& s, Method) { return decide_table(s.silt.has_value(), "silt", "one force"); },
         .take_out = [](Scene& s) { s.silt.reset(); },
         .instead = "no [silt]",
         .taken_out_when_off = true,
         .named = Effect::silt},
        {.name = "ice",
         .decide =
             [](const Scene& s, Method) {
                 return decided(s.ice.has_value(), "[ice] is given; acts in the combinations that name it", "no [ice]",
                                "one force");
             },
         .take_out =
             [](Scene& s) {
                 s.ice.reset();
                 for (Combination& c : s.combinations) c.ice = false;
             },
         .instead = "no [ice]",
         .leave_out = [](Scene& s, const EffectPlan&) { s.ice.reset(); },
         .named = Effect::ice},
        {.name = "user forces",
         .decide =
             [](const Scene& s, Method) {
                 return decided(!s.forces.empty(), fmt::format("{} [[force]]", s.forces.size()), "no [[force]]",
                                "one force each");
             },
         .take_out = [](Scene& s) { s.forces.clear(); },
         .instead = "no [[force]]",
         .taken_out_when_off = true,
         .named = Effect::user_forces},
    };
}

} // namespace damslip
