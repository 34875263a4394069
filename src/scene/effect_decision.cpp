#include "scene/effect_decision.hpp"

#include "scene/curtain.hpp"
#include "scene/section.hpp"
#include "scene/words.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

std::string table_there(bool there, const std::string& table)
{
    return there ? "[" + table + "] is given" : "no [" + table + "]";
}

bool uplift_on(const Scene& s)
{
    return s.uplift && s.uplift->model != UpliftModel::none;
}
bool any_vertical(const Scene& s)
{
    return std::any_of(s.motion.records.begin(), s.motion.records.end(),
                       [](const RecordFiles& r) { return r.vertical.has_value(); });
}

Decision hydrodynamic_mass(const Scene& s, Method method)
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

bool acoustic(const Scene& s, Method method)
{
    return method == Method::finite_elements && s.reservoir && s.reservoir->model == ReservoirModel::acoustic;
}

/// Effects of acoustic water alone.
Decision of_acoustic_water(const Scene& s, Method method, bool on, std::string yes, std::string no, std::string cost)
{
    if (method == Method::rigid_block) return {false, "rigid block", ""};
    if (!acoustic(s, method)) return {false, "reservoir is not acoustic", ""};
    return on ? Decision{true, std::move(yes), std::move(cost)} : Decision{false, std::move(no), ""};
}

Decision water_compressibility(const Scene& s, Method method)
{
    if (!s.reservoir) return {false, "no [reservoir]", ""};
    if (s.reservoir->model == ReservoirModel::hydrostatic) return {false, "reservoir.model = \"hydrostatic\"", ""};
    if (acoustic(s, method))
        return {true, "reservoir.bulk_modulus_MPa of acoustic water", "part of the water's matrix"};
    if (s.added_mass.formula == AddedMassFormula::westergaard && (s.added_mass.period || s.added_mass.period_of_dam))
        return {true, "added_mass.period_s",
                s.added_mass.period_of_dam ? "modes of the dam until the period agrees" : "none"};
    return {false, "added mass of incompressible water", ""};
}

Decision bottom_absorption(const Scene& s, Method method)
{
    const bool by_material = s.reservoir && s.reservoir->bottom_density && s.reservoir->bottom_modulus;
    return of_acoustic_water(s, method, by_material || (s.reservoir && s.reservoir->bottom_reflection < 1.0),
                             by_material ? "reservoir.bottom_density_kg_m3 and bottom_modulus_GPa"
                                         : "reservoir.bottom_reflection < 1",
                             "reservoir.bottom_reflection = 1", "a damper on each node of the bottom");
}

Decision moving_bottom(const Scene& s, Method method)
{
    const bool moves = s.reservoir && s.reservoir->bottom_motion == BottomMotion::ground;
    const bool vertical = any_vertical(s) && s.motion.vertical;
    return of_acoustic_water(s, method, moves && vertical, "reservoir.bottom_motion = \"ground\", vertical motion",
                             moves ? "no vertical motion" : "reservoir.bottom_motion = \"still\"",
                             "one more load on the water");
}

Decision wave_radiation(const Scene& s, Method method)
{
    const FarEnd end = s.reservoir ? s.reservoir->far_end : FarEnd::closed;
    const bool leaves = end == FarEnd::absorbing || end == FarEnd::damper;
    return of_acoustic_water(
        s, method, leaves,
        end == FarEnd::absorbing ? "reservoir.far_end = \"absorbing\"" : "reservoir.far_end = \"damper\"",
        end == FarEnd::closed ? "reservoir.far_end = \"closed\"" : "reservoir.far_end = \"open\"",
        end == FarEnd::absorbing ? "layers at the far end" : "a damper on each node of the far end");
}

Decision surface_waves(const Scene& s, Method method)
{
    return of_acoustic_water(s, method, s.reservoir && s.reservoir->surface == WaterSurface::sloshing,
                             "reservoir.surface = \"sloshing\"", "reservoir.surface = \"free\": p = 0",
                             "pressures of the surface");
}

Decision floor_pressure(const Scene& s)
{
    const bool wanted = s.reservoir && s.reservoir->floor_pressure;
    if (!wanted) return {false, s.reservoir ? "reservoir.floor_pressure = false" : "no [reservoir]", ""};
    if (!s.foundation) return {false, "no [foundation]: rigid base", ""};
    return {true, "reservoir.floor_pressure = true", "static nodal forces on the rock"};
}

Decision yielding_contact(const Contact& c)
{
    if (c.normal == NormalContact::exponential)
        return {true, "contact.normal = \"exponential\"", "springs across and along the pairs"};
    if (c.enforcement == ContactEnforcement::penalty)
        return {true, "contact.enforcement = \"penalty\"", "springs along the pairs"};
    if (c.enforcement == ContactEnforcement::slip_tolerance)
        return {true, "contact.enforcement = \"slip-tolerance\"", "springs along the pairs that follow the pressure"};
    return {false, "contact.enforcement = \"exact\", contact.normal = \"hard\"", ""};
}

Decision lift_off(const Scene& s, Method method)
{
    if (method == Method::finite_elements) return {false, "finite elements: see separation", ""};
    if (!any_vertical(s) || !s.motion.vertical) return {false, "no vertical motion", ""};
    return {true,
            s.sliding.lift_off == LiftOff::ballistic ? "sliding.lift_off = \"ballistic\""
                                                     : "sliding.lift_off = \"no-friction\"",
            "an event where the normal force vanishes"};
}

Decision base_crack(const Scene& s, Method method)
{
    if (method == Method::finite_elements)
        return {false, "finite elements: the joint opens by itself, the uplift stays", ""};
    const bool on = uplift_on(s) && s.uplift->crack != CrackRule::none;
    return {on, on ? "uplift.crack" : "uplift.crack = \"none\" (limit equilibrium shows both)",
            "crack and uplift iterated per state"};
}

Decision uplift(const Scene& s)
{
    if (!s.uplift)
        return {false,
                s.reservoir || s.tailwater ? "no [uplift] and no [curtain]: the base is taken as dry" : "no [uplift]",
                ""};
    if (!uplift_on(s)) return {false, "uplift.model = \"none\"", ""};
    return {true, std::string("uplift.model = \"") + word(s.uplift->model) + "\"", "one pressure profile"};
}

Decision curtain_stiffness(const Scene& s)
{
    if (curtain_changes_stiffness(s)) return {true, "curtain.young_modulus_GPa", "mesh lines around the curtain"};
    if (!s.curtain) return {false, "no [curtain]", ""};
    if (!s.foundation) return {false, "no [foundation]: rigid base", ""};
    return {false,
            s.curtain->young_modulus ? "the curtain's E and nu are the rock's: no mesh lines"
                                     : "no curtain.young_modulus_GPa: the rock's",
            ""};
}

Decision curtain_sealing(const Scene& s)
{
    if (!s.curtain) return {false, "no [curtain]", ""};
    if (s.uplift && s.uplift->model == UpliftModel::curtain)
        return s.curtain->intact ? Decision{true, "uplift.model = \"curtain\"", "one more corner of the profile"}
                                 : Decision{false, "curtain.intact = false", ""};
    if (!s.uplift || s.uplift->model != UpliftModel::seepage) return {false, "the uplift does not ask for it", ""};
    if (curtain_changes_flow(s)) return {true, "curtain.permeability_m_s", "flow mesh refined around the curtain"};
    return {false,
            s.curtain->intact ? "the curtain's permeability is the rock's: no mesh lines" : "curtain.intact = false",
            ""};
}

Decision strength_loss(const Contact& c)
{
    if (!c.friction_table.empty())
        return {true, "contact.friction_table_m", "strength stages are events of the integration"};
    if (c.residual_friction)
        return {true, "contact.residual_friction", "strength stages are events of the integration"};
    return {false, "no residual_friction, no friction_table_m", ""};
}

} // namespace

Decision decide(Effect effect, const Scene& s, Method method)
{
    const bool rigid = method == Method::rigid_block;
    const bool fe = !rigid;
    const auto fe_only = [&](bool there, std::string yes, std::string no, std::string cost) -> Decision {
        if (rigid) return {false, "rigid block", ""};
        return there ? Decision{true, std::move(yes), std::move(cost)} : Decision{false, std::move(no), ""};
    };
    switch (effect) {
    case Effect::hydrostatic_thrust:
        return {s.reservoir.has_value(), table_there(s.reservoir.has_value(), "reservoir"), "exact face integrals"};
    case Effect::tailwater:
        return {s.tailwater.has_value(), table_there(s.tailwater.has_value(), "tailwater"), "exact face integrals"};
    case Effect::silt:
        return {s.silt.has_value(), table_there(s.silt.has_value(), "silt"), "one force"};
    case Effect::ice:
        return {s.ice.has_value(), s.ice ? "[ice] is given; acts in the combinations that name it" : "no [ice]",
                "one force"};
    case Effect::user_forces:
        return {!s.forces.empty(), s.forces.empty() ? "no [[force]]" : fmt::format("{} [[force]]", s.forces.size()),
                "one force each"};
    case Effect::uplift:
        return uplift(s);
    case Effect::seepage: {
        const bool on = s.uplift && s.uplift->model == UpliftModel::seepage;
        return {on, on ? "uplift.model = \"seepage\"" : "uplift is not by seepage",
                "one Darcy solution of the rock box"};
    }
    case Effect::base_crack:
        return base_crack(s, method);
    case Effect::drains:
        return {s.drains.has_value(), table_there(s.drains.has_value(), "drains"), "part of the pressure profile"};
    case Effect::hydrodynamic_mass:
        return hydrodynamic_mass(s, method);
    case Effect::acoustic_water:
        return fe_only(s.reservoir && s.reservoir->model == ReservoirModel::acoustic, "reservoir.model = \"acoustic\"",
                       "reservoir is not acoustic", "one unknown per water node");
    case Effect::water_compressibility:
        return water_compressibility(s, method);
    case Effect::bottom_absorption:
        return bottom_absorption(s, method);
    case Effect::moving_bottom:
        return moving_bottom(s, method);
    case Effect::wave_radiation:
        return wave_radiation(s, method);
    case Effect::surface_waves:
        return surface_waves(s, method);
    case Effect::floor_pressure:
        return rigid ? Decision{false, "rigid block", ""} : floor_pressure(s);
    case Effect::cohesion:
        return {s.contact.cohesion > 0,
                s.contact.cohesion > 0 ? "contact.cohesion_kPa > 0" : "contact.cohesion_kPa = 0",
                "lost at first slip: one event"};
    case Effect::strength_loss:
        return strength_loss(s.contact);
    case Effect::inclined_base:
        return {base_inclination(s.section) != 0,
                base_inclination(s.section) != 0 ? "the toe is not level with the heel" : "level base", "none"};
    case Effect::vertical_motion: {
        if (!any_vertical(s)) return {false, "no record has a vertical component", ""};
        return {s.motion.vertical, s.motion.vertical ? "records have vertical components" : "motion.vertical = false",
                "one more sample per step; the yield acceleration varies in time"};
    }
    case Effect::lift_off:
        return lift_off(s, method);
    case Effect::upstream_sliding:
        if (fe) return {false, "finite elements: the joint slides either way", ""};
        return {s.sliding.two_way, s.sliding.two_way ? "sliding.two_way = true" : "sliding.two_way = false",
                "a second yield acceleration"};
    case Effect::run_out:
        return {s.sliding.run_out_max > 0,
                s.sliding.run_out_max > 0 ? "sliding.run_out_max_s > 0" : "sliding.run_out_max_s = 0",
                "until stuck for 0.5 s, only if still sliding at the record's end"};
    case Effect::rock_flexibility:
        return fe_only(s.foundation.has_value(), "[foundation] is given", "no [foundation]: rigid base",
                       "two unknowns per rock node");
    case Effect::curtain_stiffness:
        return rigid ? Decision{false, "rigid block", ""} : curtain_stiffness(s);
    case Effect::curtain_sealing:
        return curtain_sealing(s);
    case Effect::structural_damping:
        return {fe && s.damping.method != DampingMethod::none,
                rigid                                     ? "rigid block"
                : s.damping.method != DampingMethod::none ? "damping.method"
                                                          : "damping.method = \"none\"",
                "a matrix with the pattern of the stiffness"};
    case Effect::separation:
        return fe_only(s.contact.separation == JointOpening::allowed, "contact.separation = \"allowed\"",
                       "contact.separation = \"none\"", "a second condition of each pair");
    case Effect::finite_sliding:
        return fe_only(s.contact.sliding == JointPath::finite, "contact.sliding = \"finite\"",
                       "contact.sliding = \"small\"", "the pairs of each place the dam slides to");
    case Effect::yielding_contact:
        return rigid ? Decision{false, "rigid block", ""} : yielding_contact(s.contact);
    case Effect::lift_joints:
        return fe_only(!s.lift_joints.empty(), fmt::format("{} [[lift_joint]]", s.lift_joints.size()),
                       "no [[lift_joint]]", "each node of a joint twice, one contact pair each");
    case Effect::lift_joint_water:
        return fe_only(std::any_of(s.lift_joints.begin(), s.lift_joints.end(),
                                   [](const LiftJoint& j) { return j.water != JointWater::none; }),
                       "lift_joint.water", "no lift_joint.water", "nodal forces on both sides of the joint");
    }
    return {false, "", ""};
}

} // namespace damslip
