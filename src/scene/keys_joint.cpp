#include "scene/key_parts.hpp"
#include "scene/keys.hpp"
#include "scene/opening_water.hpp"

namespace damslip::keys {

namespace {

const Units area_per_metre{{"m2_m", 1.0}, {"mm2_m", 1e-6}};
const Units surface_energy{{"N_m", 1.0}, {"J_m2", 1.0}, {"kN_m", 1e3}};
const Units velocity{{"m_s", 1.0}, {"mm_s", 1e-3}};
const Units viscosity{{"Pa_s", 1.0}, {"mPa_s", 1e-3}};
const Units pressure{{"kPa", 1e3}, {"MPa", 1e6}, {"Pa", 1.0}};

/// A member of a member of the object a table fills.
template <class T, class Part, class Member>
std::function<Slot(void*)> in(Part T::*part, Member Part::*member)
{
    return [part, member](void* object) -> Slot { return &(static_cast<T*>(object)->*part.*member); };
}

/// The same for an enumeration.
template <class T, class Part, class Enum>
std::function<Slot(void*)> choice_in(Part T::*part, Enum Part::*member, std::vector<std::pair<std::string, Enum>> words)
{
    return [part, slot = choice(member, std::move(words))](void* object) {
        return slot(&(static_cast<T*>(object)->*part));
    };
}

/// A key that resolved scenes hold only where its law is there.
template <class T>
Key only_where(std::function<bool(const T&)> applies, Key key)
{
    key.applies = [applies = std::move(applies)](const void* object) {
        return applies(*static_cast<const T*>(object));
    };
    return key;
}

bool bonded(const Contact& c)
{
    return c.bond.tensile_strength > 0.0 || c.bond.shear_energy || c.bond.tension_energy;
}

bool flows(const Uplift& u)
{
    return u.water.opening == OpeningWater::reynolds;
}

} // namespace

std::vector<Key> bond_keys()
{
    const auto loss = [](void* contact) {
        return optional_choice(&Bond::loss, {{"together", BondLoss::together},
                                             {"fracture", BondLoss::fracture},
                                             {"pairs", BondLoss::pairs}})(&static_cast<Contact*>(contact)->bond);
    };
    return {
        word("bond", "fracture with fracture_energy_shear, else together",
             "how cohesion is lost: all together when mu N' + c A is reached (together, the rigid block's rule), by "
             "fracture energies (fracture, FE), or pair by pair without any (pairs, FE: depends on the mesh)",
             "\"together\"", loss),
        only_where<Contact>(bonded, number("tensile_strength", stress, Range::between(0, 1e4), "0",
                                           "FE, bond fracture: f_t across the joint", "500",
                                           in(&Contact::bond, &Bond::tensile_strength))),
        number("fracture_energy_tension", surface_energy, Range::above(0), "none; needed with tensile_strength",
               "FE, bond fracture: G_I, work to open 1 m2", "150", in(&Contact::bond, &Bond::tension_energy)),
        number("fracture_energy_shear", surface_energy, Range::above(0), "none; needed with bond fracture and cohesion",
               "FE, bond fracture: G_II, work to shear 1 m2 beyond friction", "1500",
               in(&Contact::bond, &Bond::shear_energy)),
        only_where<Contact>(bonded,
                            word("unloading", "origin",
                                 "FE, a damaged bond unloads to the origin, or with its first stiffness (plastic)",
                                 "\"plastic\"",
                                 choice_in(&Contact::bond, &Bond::unloading,
                                           {{"origin", BondUnloading::origin}, {"plastic", BondUnloading::plastic}})))};
}

std::vector<Key> rate_keys()
{
    const std::function<bool(const Contact&)> active = [](const Contact& c) { return c.rate.active(); };
    return {
        only_where<Contact>(active,
                            number("kinetic_friction_ratio", none, Range::between(0, 5), "1 (no rate dependence)",
                                   "friction in fast sliding over friction at rest: mu_k/mu", "0.8",
                                   in(&Contact::rate, &RateFriction::kinetic_ratio))),
        number("characteristic_rate", velocity, Range::above(0), "required with kinetic_friction_ratio",
               "v_c of mu = mu_k + (mu - mu_k) exp(-|v|/v_c)", "0.01",
               in(&Contact::rate, &RateFriction::characteristic_rate)),
        number("relaxation_time", seconds, Range::above(0), "none; FE asks for it or relaxation_slip where mu falls",
               "time by which friction lags behind the rate", "0.05",
               in(&Contact::rate, &RateFriction::relaxation_time)),
        number("relaxation_slip", small_length, Range::above(0), "none", "slip by which friction lags behind the rate",
               "0.001", in(&Contact::rate, &RateFriction::relaxation_slip)),
        only_where<Contact>([](const Contact& c) { return c.restitution != 0.0; },
                            number("restitution", none, Range::between(0, 1), "0",
                                   "of impacts of the whole base: rate after over rate before", "0.3",
                                   at(&Contact::restitution)))};
}

std::vector<Key> opening_water_keys()
{
    using W = JointWaterLaw;
    const std::function<bool(const Uplift&)> any = [](const Uplift& u) {
        return u.water.opening != OpeningWater::unchanged;
    };
    return {
        only_where<Uplift>(any, word("opening", "unchanged",
                                     "water in the part of the joint that opens in the earthquake: unchanged (USACE, "
                                     "FERC), zero (USBR), full head to the crack's tip (ICOLD), mouth (full as far as "
                                     "it has come at mouth_speed), reynolds (thin flow)",
                                     "\"full\"", choice_in(&Uplift::water, &W::opening, opening_waters()))),
        only_where<Uplift>(
            [](const Uplift& u) { return u.water.after != WaterAfter::unchanged; },
            word("after", "unchanged",
                 "after the earthquake, and between the records of a sequence: unchanged, or full head on "
                 "all that has cracked",
                 "\"full\"",
                 choice_in(&Uplift::water, &W::after,
                           {{"unchanged", WaterAfter::unchanged}, {"full", WaterAfter::full}}))),
        number("mouth_speed", velocity, Range::above(0), "required with opening mouth",
               "opening mouth: speed at which water enters the crack", "5", in(&Uplift::water, &W::mouth_speed)),
        only_where<Uplift>(flows, number("joint_clearance", small_length, Range::between(1e-6, 0.1), "0.0002",
                                         "opening reynolds: clearance of the shut joint", "0.0002",
                                         in(&Uplift::water, &W::clearance))),
        only_where<Uplift>(flows, number("water_viscosity", viscosity, Range::between(1e-4, 1), "0.0013",
                                         "opening reynolds: viscosity of the water", "0.0013",
                                         in(&Uplift::water, &W::viscosity))),
        only_where<Uplift>(flows, number("cavitation_pressure", pressure, Range::between(-101, 0), "-99",
                                         "opening reynolds: least pressure, against the atmosphere", "-99",
                                         in(&Uplift::water, &W::cavitation))),
        only_where<Uplift>(
            flows, word("wet_end", "still",
                        "opening reynolds: pressure at the heel, of still water or with that of the "
                        "reservoir's waves",
                        "\"with-waves\"",
                        choice_in(&Uplift::water, &W::wet_end,
                                  {{"still", WetEndPressure::still}, {"with-waves", WetEndPressure::with_waves}})))};
}

KeyGroup anchor_group()
{
    using A = Anchor;
    return list_group<A>(
        "anchor", "A row of anchors through the base or a lift joint, per metre of dam length.",
        [](Scene& s) -> std::vector<A>& { return s.anchors; },
        {word("name", "anchor and its number", "name in the tables", "\"crest anchors\"", at(&A::name)),
         word("joint", "the base", "name of the lift joint it crosses", "\"neck\"", at(&A::joint)),
         number("distance", length, Range::at_least(0), "required", "where it crosses the joint, from its upstream end",
                "4", at(&A::distance)),
         number("inclination", angle, Range::inside(-90, 90), "0",
                "from the joint's normal; positive: slip downstream stretches it", "15", at(&A::inclination)),
         number("free_length", length, Range::above(0), "required",
                "over which it stretches; of a grouted bar the debonded length", "30", at(&A::free_length)),
         number("area", area_per_metre, Range::above(0), "required", "steel per metre of dam length", "0.002",
                at(&A::area)),
         number("young_modulus", modulus, Range::above(0), "200", "Young's modulus of the steel", "195",
                at(&A::young_modulus)),
         number("yield_strength", {{"MPa", 1e6}, {"GPa", 1e9}, {"Pa", 1.0}}, Range::above(0), "required",
                "f_y of the steel", "1600", at(&A::yield_strength)),
         number("rupture_strain", none, Range::between(1e-4, 1), "it does not snap",
                "strain at which it snaps, prestress included", "0.035", at(&A::rupture_strain)),
         number("prestress", line_force, Range::at_least(0), "0 (passive)",
                "lock-off force, applied before the reservoir is filled", "1500", at(&A::prestress)),
         word("dowel", "false", "grouted: it also resists across its axis, up to A f_y/sqrt(3)", "true", at(&A::dowel)),
         word("limit_force", "prestress; yield where passive",
              "force in limit equilibrium: the prestress, or the yield force (an upper bound)", "\"yield\"",
              choice(&A::limit_force,
                     std::vector<std::pair<std::string, AnchorForceRule>>{{"prestress", AnchorForceRule::prestress},
                                                                          {"yield", AnchorForceRule::yield}}))});
}

} // namespace damslip::keys
