#include "cli/ablation/removal.hpp"

#include "cli/run/contact_law.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip::cli {

namespace {

using Answer = std::variant<Removal, Stays>;

void without_tailwater(Scene& s)
{
    s.tailwater.reset();
    for (Combination& c : s.combinations) c.tailwater_level.reset();
}

void without_ice(Scene& s)
{
    s.ice.reset();
    for (Combination& c : s.combinations) c.ice = false;
}

Answer seepage(Scene s)
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

Answer drains(Scene s)
{
    s.drains.reset();
    if (!s.uplift || s.uplift->model != UpliftModel::drains) return Removal{s, "no drains"};
    s.uplift->model = UpliftModel::linear;
    return Removal{s, "no drains: uplift.model = \"linear\""};
}

const char* formula_name(const AddedMass& mass)
{
    switch (mass.formula) {
    case AddedMassFormula::westergaard:
        return mass.period || mass.period_of_dam ? "Westergaard's series with its period"
                                                 : "Westergaard's series, incompressible";
    case AddedMassFormula::westergaard_simplified:
        return "Westergaard's parabola";
    case AddedMassFormula::zangar:
        return "Zangar's";
    case AddedMassFormula::goldgruber:
        return "Goldgruber's";
    }
    return "";
}

Answer compressibility(Scene s)
{
    if (s.reservoir->model == ReservoirModel::acoustic) {
        s.reservoir->bulk_modulus *= stiff_water_factor;
        return Removal{s, fmt::format("reservoir.bulk_modulus times {:.0e}, acoustic water still", stiff_water_factor)};
    }
    s.added_mass.period.reset();
    s.added_mass.period_of_dam = false;
    return Removal{s, "added mass without its period: incompressible water"};
}

Answer bottom_absorption(Scene s)
{
    s.reservoir->bottom_reflection = 1.0;
    s.reservoir->bottom_density.reset();
    s.reservoir->bottom_modulus.reset();
    return Removal{s, "reservoir.bottom_reflection = 1: every wave comes back from the bottom"};
}

Answer wave_radiation(Scene s)
{
    s.reservoir->far_end = FarEnd::closed;
    s.reservoir->length = std::max(s.reservoir->length, 2.4 * s.reservoir->level);
    return Removal{s, fmt::format("reservoir.far_end = \"closed\", a wall {:.4g} m upstream", s.reservoir->length)};
}

Answer strength_loss(Scene s)
{
    Contact& c = s.contact;
    if (!c.friction_table.empty()) c.friction = c.friction_table.front().y;
    c.friction_table.clear();
    c.residual_friction.reset();
    c.residual_slip = 0.0;
    return Removal{s, fmt::format("friction {:.4g} whatever the slip", c.friction)};
}

Answer lift_off(Scene s)
{
    if (s.sliding.lift_off == LiftOff::no_friction)
        return Stays{"no-friction is the simplest answer to a base without normal force; see vertical motion"};
    s.sliding.lift_off = LiftOff::no_friction;
    return Removal{s, "sliding.lift_off = \"no-friction\": no flight"};
}

Answer rock_flexibility(Scene s, const std::vector<Point>& seepage_points)
{
    std::string instead = "no [foundation]: rigid base";
    if (s.uplift && s.uplift->model == UpliftModel::seepage) {
        if (seepage_points.empty()) return Stays{"the seepage needs the rock, and its profile has no head to refer to"};
        s.uplift->model = UpliftModel::points;
        s.uplift->points = seepage_points;
        instead += ", the same uplift as points";
    }
    s.foundation.reset();
    s.mesh.rock_contact_size.reset();
    s.stages.pore_pressure = PorePressure::none;
    return Removal{s, instead};
}

Answer curtain_sealing(Scene s)
{
    s.curtain->intact = false;
    return Removal{s, s.uplift->model == UpliftModel::seepage ? "curtain.intact = false: as permeable as the rock"
                                                              : "curtain.intact = false: linear uplift"};
}

Answer damping(Scene s)
{
    s.damping.method = DampingMethod::none;
    s.damping.mass_coefficient.reset();
    s.damping.stiffness_coefficient.reset();
    return Removal{s, "damping.method = \"none\""};
}

Answer separation(Scene s)
{
    if (s.contact.normal == NormalContact::exponential)
        return Stays{"exponential contact cannot pull; see contact that gives way"};
    s.contact.separation = JointOpening::none;
    return Removal{s, "contact.separation = \"none\": the joint pulls without shear"};
}

Answer finite_sliding(Scene s)
{
    s.contact.sliding = JointPath::small;
    s.contact.max_slip = Contact{}.max_slip;
    return Removal{s, "contact.sliding = \"small\": nodes stay opposite each other"};
}

Answer without_lift_joint_water(Scene s)
{
    for (LiftJoint& joint : s.lift_joints) joint.water = JointWater::none;
    return Removal{s, "lift_joint.water = \"none\""};
}

} // namespace

std::variant<Removal, Stays> remove_effect(const Scene& scene, Effect effect, const std::vector<Point>& seepage_points)
{
    Scene s = scene;
    switch (effect) {
    case Effect::hydrostatic_thrust:
        return Stays{"without water it is another load, not another model: give the scene no [reservoir]"};
    case Effect::inclined_base:
        return Stays{"geometry: a level base is another dam"};
    case Effect::tailwater:
        without_tailwater(s);
        return Removal{s, "no [tailwater]"};
    case Effect::silt:
        s.silt.reset();
        return Removal{s, "no [silt]"};
    case Effect::ice:
        without_ice(s);
        return Removal{s, "no [ice]"};
    case Effect::user_forces:
        s.forces.clear();
        return Removal{s, "no [[force]]"};
    case Effect::uplift:
        s.uplift = Uplift{.model = UpliftModel::none, .points = {}};
        return Removal{s, "uplift.model = \"none\": dry base"};
    case Effect::seepage:
        return seepage(s);
    case Effect::base_crack:
        s.uplift->crack = CrackRule::none;
        return Removal{s, "uplift.crack = \"none\""};
    case Effect::drains:
        return drains(s);
    case Effect::hydrodynamic_mass:
        s.reservoir->model = ReservoirModel::hydrostatic;
        return Removal{s, "reservoir.model = \"hydrostatic\": water that does not move"};
    case Effect::acoustic_water:
        s.reservoir->model = ReservoirModel::added_mass;
        return Removal{s, fmt::format("reservoir.model = \"added-mass\": {}", formula_name(s.added_mass))};
    case Effect::water_compressibility:
        return compressibility(s);
    case Effect::bottom_absorption:
        return bottom_absorption(s);
    case Effect::moving_bottom:
        s.reservoir->bottom_motion = BottomMotion::still;
        return Removal{s, "reservoir.bottom_motion = \"still\": no pressure by the floor's vertical motion"};
    case Effect::wave_radiation:
        return wave_radiation(s);
    case Effect::surface_waves:
        s.reservoir->surface = WaterSurface::free;
        return Removal{s, "reservoir.surface = \"free\": p = 0"};
    case Effect::floor_pressure:
        s.reservoir->floor_pressure = false;
        return Removal{s, "reservoir.floor_pressure = false"};
    case Effect::cohesion:
        s.contact.cohesion = 0.0;
        return Removal{s, "contact.cohesion_kPa = 0"};
    case Effect::strength_loss:
        return strength_loss(s);
    case Effect::vertical_motion:
        s.motion.vertical = false;
        return Removal{s, "motion.vertical = false"};
    case Effect::lift_off:
        return lift_off(s);
    case Effect::upstream_sliding:
        s.sliding.two_way = false;
        return Removal{s, "sliding.two_way = false"};
    case Effect::run_out:
        s.sliding.run_out_max = 0.0;
        return Removal{s, "sliding.run_out_max_s = 0: the record's end is the end"};
    case Effect::rock_flexibility:
        return rock_flexibility(s, seepage_points);
    case Effect::curtain_stiffness:
        s.curtain->young_modulus.reset();
        return Removal{s, "the curtain's E and nu are the rock's"};
    case Effect::curtain_sealing:
        return curtain_sealing(s);
    case Effect::structural_damping:
        return damping(s);
    case Effect::separation:
        return separation(s);
    case Effect::finite_sliding:
        return finite_sliding(s);
    case Effect::yielding_contact:
        return Removal{with_exact_contact(s).value_or(s), "rigid sticking, hard contact"};
    case Effect::lift_joints:
        s.lift_joints.clear();
        return Removal{s, "no [[lift_joint]]: a dam of one piece"};
    case Effect::lift_joint_water:
        return without_lift_joint_water(s);
    }
    return Stays{""};
}

} // namespace damslip::cli
