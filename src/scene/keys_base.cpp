#include "scene/joint_bond.hpp"
#include "scene/keys.hpp"
#include "scene/uplift_models.hpp"

#include <set>

namespace damslip::keys {

const std::vector<std::pair<std::string, CrackRule>>& crack_rules()
{
    static const std::vector<std::pair<std::string, CrackRule>> words{
        {"none", CrackRule::none},
        {"static", CrackRule::fixed_static},
        {"seismic-zero", CrackRule::seismic_zero},
        {"seismic-unchanged", CrackRule::seismic_unchanged},
        {"seismic-full", CrackRule::seismic_full}};
    return words;
}

namespace {

const Units area_per_metre{{"m2_m", 1.0}, {"mm2_m", 1e-6}};
const Units velocity{{"m_s", 1.0}, {"mm_s", 1e-3}};
const Units viscosity{{"Pa_s", 1.0}, {"mPa_s", 1e-3}};
const Units pressure{{"kPa", 1e3}, {"MPa", 1e6}, {"Pa", 1.0}};

bool bonded(const Contact& c)
{
    return c.bond.tensile_strength > 0.0 || c.bond.shear_energy || c.bond.tension_energy;
}

bool flows(const Uplift& u)
{
    return u.water.opening == OpeningWater::reynolds;
}

/// Of the contact's strength.
std::vector<Key> bond_keys()
{
    const Value loss =
        in(&Contact::bond,
           choice(&Bond::loss,
                  {{"together", BondLoss::together}, {"fracture", BondLoss::fracture}, {"pairs", BondLoss::pairs}}));
    return {
        word("bond", "fracture with fracture_energy_shear, else together",
             "how cohesion is lost: all together when mu N' + c A is reached (together, the rigid block's rule), by "
             "fracture energies (fracture, FE), or pair by pair without any (pairs, FE: depends on the mesh)",
             "\"together\"", loss),
        only_where<Contact>(bonded, number("tensile_strength", stress, Range::between(0, 1e4), "0",
                                           "FE, bond fracture: f_t across the joint", "500",
                                           in(&Contact::bond, at(&Bond::tensile_strength)))),
        number("fracture_energy_tension", surface_energy, Range::above(0), "none; needed with tensile_strength",
               "FE, bond fracture: G_I, work to open 1 m2", "150", in(&Contact::bond, at(&Bond::tension_energy))),
        number("fracture_energy_shear", surface_energy, Range::above(0), "none; needed with bond fracture and cohesion",
               "FE, bond fracture: G_II, work to shear 1 m2 beyond friction", "1500",
               in(&Contact::bond, at(&Bond::shear_energy))),
        only_where<Contact>(
            bonded,
            word("unloading", "origin",
                 "FE, a damaged bond unloads to the origin, or with its first stiffness (plastic)", "\"plastic\"",
                 in(&Contact::bond, choice(&Bond::unloading,
                                           {{"origin", BondUnloading::origin}, {"plastic", BondUnloading::plastic}})))),
        only_where<Contact>(
            [](const Contact& c) { return c.bond.softening != BondSoftening::linear; },
            word("softening", "linear",
                 "FE, bond fracture: beyond its strength f the bond falls on a line (linear) or as f exp(-w f/G), w "
                 "its opening or slip (exponential)",
                 "\"exponential\"",
                 in(&Contact::bond, choice(&Bond::softening, {{"linear", BondSoftening::linear},
                                                              {"exponential", BondSoftening::exponential}})))),
        only_where<Contact>(
            [](const Contact& c) { return c.bond.dynamic_increase != 1.0; },
            number("dynamic_increase", none, Range::between(1, 3), "1",
                   "FE, bond fracture: strengths and fracture energies of the bond in an earthquake over those at rest",
                   "1.2", in(&Contact::bond, at(&Bond::dynamic_increase))))};
}

/// Friction over the rate, and landings.
std::vector<Key> rate_keys()
{
    const std::function<bool(const Contact&)> active = [](const Contact& c) { return c.rate.active(); };
    return {
        only_where<Contact>(active,
                            number("kinetic_friction_ratio", none, Range::between(0, 5), "1 (no rate dependence)",
                                   "friction in fast sliding over friction at rest: mu_k/mu", "0.8",
                                   in(&Contact::rate, at(&RateFriction::kinetic_ratio)))),
        number("characteristic_rate", velocity, Range::above(0), "required with kinetic_friction_ratio",
               "v_c of mu = mu_k + (mu - mu_k) exp(-|v|/v_c)", "0.01",
               in(&Contact::rate, at(&RateFriction::characteristic_rate))),
        number("relaxation_time", seconds, Range::above(0), "none; FE asks for it or relaxation_slip where mu falls",
               "time by which friction lags behind the rate", "0.05",
               in(&Contact::rate, at(&RateFriction::relaxation_time))),
        number("relaxation_slip", small_length, Range::above(0), "none", "slip by which friction lags behind the rate",
               "0.001", in(&Contact::rate, at(&RateFriction::relaxation_slip))),
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
                                     "\"full\"", in(&Uplift::water, choice(&W::opening, opening_waters())))),
        only_where<Uplift>([](const Uplift& u) { return u.water.after != WaterAfter::unchanged; },
                           word("after", "unchanged",
                                "after the earthquake, and between the records of a sequence: unchanged, or full head "
                                "on all that has cracked",
                                "\"full\"",
                                in(&Uplift::water, choice(&W::after, {{"unchanged", WaterAfter::unchanged},
                                                                      {"full", WaterAfter::full}})))),
        number("mouth_speed", velocity, Range::above(0), "required with opening mouth",
               "opening mouth: speed at which water enters the crack", "5", in(&Uplift::water, at(&W::mouth_speed))),
        only_where<Uplift>(flows, number("joint_clearance", small_length, Range::between(1e-6, 0.1), "0.0002",
                                         "opening reynolds: clearance of the shut joint", "0.0002",
                                         in(&Uplift::water, at(&W::clearance)))),
        only_where<Uplift>(flows, number("water_viscosity", viscosity, Range::between(1e-4, 1), "0.0013",
                                         "opening reynolds: viscosity of the water", "0.0013",
                                         in(&Uplift::water, at(&W::viscosity)))),
        only_where<Uplift>(flows, number("cavitation_pressure", pressure, Range::between(-101, 0), "-99",
                                         "opening reynolds: least pressure, against the atmosphere", "-99",
                                         in(&Uplift::water, at(&W::cavitation)))),
        only_where<Uplift>(
            flows, word("wet_end", "still",
                        "opening reynolds: pressure at the heel, of still water or with that of the reservoir's waves",
                        "\"with-waves\"",
                        in(&Uplift::water, choice(&W::wet_end, {{"still", WetEndPressure::still},
                                                                {"with-waves", WetEndPressure::with_waves}}))))};
}

KeyGroup anchor_group()
{
    using A = Anchor;
    return list_group(
        "anchor", "A row of anchors through the base or a lift joint, per metre of dam length.", &Scene::anchors,
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
         word(
             "limit_force", "prestress; yield where passive",
             "force in limit equilibrium: the prestress, or the yield force (an upper bound)", "\"yield\"",
             choice(&A::limit_force, {{"prestress", AnchorForceRule::prestress}, {"yield", AnchorForceRule::yield}}))});
}

std::vector<Key> lift_joint_keys(const std::vector<Key>& contact)
{
    using J = LiftJoint;
    static const std::set<std::string> of_strength{"friction",
                                                   "cohesion",
                                                   "cohesion_lost_at_slip",
                                                   "residual_slip",
                                                   "residual_path",
                                                   "residual_friction",
                                                   "friction_table",
                                                   "bond",
                                                   "tensile_strength",
                                                   "fracture_energy_tension",
                                                   "fracture_energy_shear",
                                                   "unloading",
                                                   "softening",
                                                   "dynamic_increase",
                                                   "kinetic_friction_ratio",
                                                   "characteristic_rate",
                                                   "relaxation_time",
                                                   "relaxation_slip"};
    const std::vector<Key> keys{
        word("name", "lift joint and its number", "name in the tables", "\"neck\"", at(&J::name)),
        number("elevation", length, Range::any(), "required", "of the joint above the heel", "51.5",
               at(&J::elevation))};
    const Key water =
        word("water", "none",
             "water in the joint, open or not: none, or linear from the head of the reservoir at the upstream face to "
             "that of the tailwater at the downstream face, 0 at a dry face",
             "\"linear\"", choice(&J::water, {{"none", JointWater::none}, {"linear", JointWater::linear}}));
    return joined({keys, strength_keys(contact, &J::strength, of_strength), {water}});
}

} // namespace

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
              "\"finite\"", choice(&Contact::sliding, {{"small", JointPath::small}, {"finite", JointPath::finite}})),
         only_with(
             &Contact::sliding, JointPath::finite,
             number("max_slip", length, Range::between(0.01, 100), "1",
                    "FE, sliding finite: largest slip downstream, 1 m upstream; a run that goes further stops and "
                    "says so",
                    "5", at(&Contact::max_slip))),
         number("residual_friction", friction, Range::between(0, 10), "the peak value",
                "Coulomb mu after residual_slip", "0.65", at(&Contact::residual_friction)),
         only_where<Contact>([](const Contact& c) { return c.residual_friction.has_value(); },
                             number("residual_slip", small_length, Range::at_least(0), "0 (at first slip)",
                                    "accumulated slip at which the residual value is reached", "0.01",
                                    at(&Contact::residual_slip))),
         word("residual_path", "steps", "between peak and residual: a step at residual_slip, or linear in slip",
              "\"linear\"",
              choice(&Contact::residual_path, {{"steps", Interpolation::steps}, {"linear", Interpolation::linear}})),
         pairs("friction_table", small_length, none, Range::between(0, 10), "none",
               "mu over accumulated slip, instead of peak and residual; steps or linear as residual_path says",
               "[[0, 0.84], [0.01, 0.7]]", at(&Contact::friction_table)),
         word("separation", "allowed",
              "FE: the joint opens (allowed), or carries tension without shear (none), which lowers the slip and "
              "breaks the rigid limit",
              "\"none\"",
              choice(&Contact::separation, {{"allowed", JointOpening::allowed}, {"none", JointOpening::none}})),
         word("enforcement", "exact",
              "FE, before slip: rigid (exact), elastic with tangential_stiffness (penalty), or with elastic slip "
              "up to slip_tolerance x contact element length (slip-tolerance); the last two also run exact and "
              "state the error of the slip",
              "\"penalty\"",
              choice(&Contact::enforcement, {{"exact", ContactEnforcement::exact},
                                             {"penalty", ContactEnforcement::penalty},
                                             {"slip-tolerance", ContactEnforcement::slip_tolerance}})),
         only_with(&Contact::enforcement, ContactEnforcement::penalty,
                   number("tangential_stiffness", subgrade, Range::at_least(1), "required with penalty",
                          "enforcement penalty: shear stress per elastic slip", "1e11",
                          at(&Contact::tangential_stiffness))),
         only_with(&Contact::enforcement, ContactEnforcement::slip_tolerance,
                   number("slip_tolerance", none, Range::half_open(0, 1), "0.005",
                          "enforcement slip-tolerance: F_f, elastic slip at the strength over the mean length of "
                          "the contact elements (4-10)",
                          "0.005", at(&Contact::slip_tolerance))),
         word("normal", "hard",
              "FE, across the joint: no penetration (hard), or a pressure that falls with the clearance g "
              "(exponential): p = p0/(e - 1) z (exp z - 1), z = 1 - g/c0; it also runs hard contact and states the "
              "error of the slip",
              "\"exponential\"",
              choice(&Contact::normal, {{"hard", NormalContact::hard}, {"exponential", NormalContact::exponential}})),
         only_with(&Contact::normal, NormalContact::exponential,
                   number("pressure_at_zero_clearance", stress, Range::above(0), "1000", "normal exponential: p0",
                          "1000", at(&Contact::pressure_at_zero_clearance))),
         only_with(&Contact::normal, NormalContact::exponential,
                   number("clearance_at_zero_pressure", small_length, Range::between(1e-6, 1), "0.001",
                          "normal exponential: c0, the pressure acts from this clearance on", "0.001",
                          at(&Contact::clearance_at_zero_pressure)))}));
    groups.back().keys = joined({groups.back().keys, bond_keys(), rate_keys()});
    groups.push_back(list_group(
        "lift_joint",
        "A horizontal joint through the dam that may slide and open, for `fe`: the block above a lift or a crack. Its "
        "separation, enforcement and slip tolerance are those of [contact].",
        &Scene::lift_joints, lift_joint_keys(groups.back().keys)));
    groups.push_back(anchor_group());
    groups.push_back(optional_group(
        "uplift",
        "Water pressure in the base. Without this table: seepage where a [curtain] is given, drains where [drains] "
        "are; "
        "water with none of the three is refused, a dry base is stated by name: model = \"none\".",
        &Scene::uplift,
        {word("model", "seepage with [curtain], drains with [drains], else linear", meanings_of(uplift_rows(), "; "),
              "\"points\"", choice(&Uplift::model, choices_of<UpliftModel>(uplift_rows()))),
         number("curtain_ratio", none, Range::between(0, 1), "0.6666666666666666",
                "model curtain: pressure behind the curtain over that at the heel, above the toe's", "0.6667",
                at(&Uplift::curtain_ratio)),
         pairs("points", length, none, Range::between(0, 2), "none",
               "model points: distance along the base from the heel, pressure over the pressure at the heel; a "
               "repeated distance is a jump",
               "[[0, 1], [7, 0.938], [7, 0.315], [45, 0]]", at(&Uplift::points)),
         word("crack", "none", "uplift in a base crack: none, static, seismic-zero, seismic-unchanged, seismic-full",
              "\"static\"", choice(&Uplift::crack, crack_rules()))}));
    groups.back().keys = joined({groups.back().keys, opening_water_keys()});
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
    Key rock_density = number("density", density, Range::between(0, 1e5), "0; 2650 where rock radiates",
                              "rock density: weight where stages.gravity asks for it, inertia where mass does", "2650",
                              in(&Foundation::material, at(&Material::density)));
    groups.push_back(optional_group(
        "foundation", "Flexible rock. Without this table the FE base is rigid.", &Scene::foundation,
        {number("young_modulus", modulus, Range::above(0), "required", "Young's modulus of the rock", "30",
                in(&Foundation::material, at(&Material::young_modulus))),
         number("poisson_ratio", none, Range{0, 0.5, false, true}, "0.2", "Poisson's ratio", "0.2",
                in(&Foundation::material, at(&Material::poisson_ratio))),
         rock_density,
         word("mass", "with-mass",
              "`with-mass`: the rock has inertia in FE runs and waves travel through it; `massless`: it only gives way "
              "and "
              "keeps all waves",
              "massless",
              choice(&Foundation::mass, {{"massless", RockMass::massless}, {"with-mass", RockMass::with_mass}})),
         word(
             "boundary", "absorbing",
             "edges of rock with mass: `fixed` normal to themselves, the record moves the box, waves come back; "
             "`viscous` dashpots, the record is the free surface's motion without the dam; `absorbing` the same, waves "
             "leave a box of its own that is reduced to the base",
             "viscous",
             choice(&Foundation::boundary, {{"fixed", RockBoundary::fixed},
                                            {"viscous", RockBoundary::viscous},
                                            {"absorbing", RockBoundary::absorbing}})),
         number("wave_box", none, Range::between(0.2, 5), "1",
                "size of the box in which waves travel, over the automatic one (absorbing)", "1.4",
                at(&Foundation::wave_box)),
         number("wave_frequency", hertz, Range::between(1, 200), "by the records, 25 ... 50",
                "up to which waves in the rock are right (absorbing)", "35", at(&Foundation::wave_frequency)),
         number("width", length, Range::above(0), "6.6667 x base", "of the rock box, centred on the base", "300",
                at(&Foundation::width)),
         number("depth", length, Range::above(0), "2.2222 x base", "of the rock box below the heel", "100",
                at(&Foundation::depth)),
         number("permeability", conductivity, Range::above(0), "1e-4", "hydraulic conductivity", "1e-4",
                at(&Foundation::permeability)),
         number("k0", none, Range::between(0, 10), "poisson_ratio/(1 - poisson_ratio)",
                "fe --plane: horizontal over vertical stress of the rock under its weight, before dam and water", "1.5",
                at(&Foundation::k0)),
         pairs("ground", length, length, Range::any(), "level at heel and toe",
               "surface of the rock up- and downstream of the dam, for the planes of [[seam]]: x downstream of the "
               "heel, y "
               "above it, from upstream to downstream; between heel and toe the base takes its place",
               "[[-100, 0], [0, 0], [45, 0], [80, 4]]", at(&Foundation::ground))}));
    return joined({groups, plane_groups(groups.front().keys)});
}

} // namespace damslip::keys
