#include "scene/keys.hpp"

#include "core/text.hpp"
#include "scene/joint_bond.hpp"
#include "scene/plausible.hpp"
#include "scene/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>

namespace damslip {

namespace {

/// A number as digits times a power of ten.
struct Decimal {
    std::uint64_t digits = 0;
    int exponent = 0;
};

/// Of the shortest text that reads back as the number. @pre value >= 0, finite
Decimal decimal_of(double value)
{
    Decimal d;
    const std::string text = shortest(value);
    const std::size_t e = std::min(text.find('e'), text.size());
    bool after_point = false;
    for (std::size_t i = 0; i < e; ++i) {
        if (text[i] == '.') {
            after_point = true;
            continue;
        }
        d.digits = 10 * d.digits + std::uint64_t(text[i] - '0');
        d.exponent -= after_point;
    }
    if (e < text.size()) d.exponent += std::stoi(text.substr(e + 1));
    for (; d.digits > 0 && d.digits % 10 == 0; d.digits /= 10) ++d.exponent;
    return d;
}

} // namespace

double to_si(double written, const UnitSuffix& unit)
{
    if (unit.tangent)
        return static_cast<double>(std::tan(static_cast<long double>(written) * std::numbers::pi_v<long double> / 180));
    if (unit.factor == 1.0 || !std::isfinite(written)) return written * unit.factor;
    const Decimal a = decimal_of(std::abs(written)), b = decimal_of(unit.factor);
    constexpr std::uint64_t few = 1'000'000; // digits of a unit that is defined by a decimal: 980665, 3048
    if (b.digits >= few) return written * unit.factor;
    // The product's digits, in two parts that a 64-bit number holds each.
    const std::uint64_t low = a.digits % few * b.digits, high = a.digits / few * b.digits + low / few;
    const auto product = parse_number(fmt::format("{}{:06}e{}", high, low % few, a.exponent + b.exponent));
    return std::copysign(product.value_or(HUGE_VAL), written);
}

bool Range::contains(double x) const
{
    if (!std::isfinite(x)) return false;
    return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
}

std::string Range::text() const
{
    const bool bounded_low = std::isfinite(low), bounded_high = std::isfinite(high);
    if (!bounded_low && !bounded_high) return "any number";
    if (!bounded_high) return (low_open ? "> " : ">= ") + shortest(low);
    if (!bounded_low) return (high_open ? "< " : "<= ") + shortest(high);
    return (low_open ? "above " : "") + shortest(low) + " ... " + (high_open ? "below " : "") + shortest(high);
}

bool Usual::contains(double x) const
{
    if (or_zero && x == 0.0) return true;
    return x >= low - 1e-9 * std::abs(low) && x <= high + 1e-9 * std::abs(high);
}

std::string Key::canonical() const
{
    return units.empty() ? name : spelled(units.front());
}

std::vector<std::string> Key::spellings() const
{
    if (units.empty()) return {name};
    std::vector<std::string> names;
    for (const UnitSuffix& unit : units) names.push_back(spelled(unit));
    return names;
}

std::string list_of(const KeyGroup& group)
{
    return group.inside ? group.name.substr(0, group.name.find('.')) : group.name;
}

bool belongs_to_wedge(const std::string& group)
{
    static const std::set<std::string> tables{
        "",       "project",       "site",    "wedge",       "wedge.plane",        "wedge.force",
        "motion", "motion.record", "sliding", "regressions", "regressions.weight", "criteria"};
    return tables.contains(group);
}

} // namespace damslip

namespace damslip::keys {

Key number(std::string name, Units units, Range range, std::string default_text, std::string meaning,
           std::string example, Value value)
{
    Key key = word(std::move(name), std::move(default_text), std::move(meaning), std::move(example), std::move(value));
    key.units = std::move(units);
    key.range = range;
    return key;
}

Key word(std::string name, std::string default_text, std::string meaning, std::string example, Value value)
{
    const bool required = default_text == "required";
    return {std::move(name), {}, {}, {}, required, std::move(default_text), std::move(meaning), std::move(example),
            std::move(value)};
}

Key pairs(std::string name, Units first, Units second, Range range, std::string default_text, std::string meaning,
          std::string example, Value value)
{
    Key key = number(std::move(name), std::move(first), range, std::move(default_text), std::move(meaning),
                     std::move(example), std::move(value));
    key.second_units = std::move(second);
    return key;
}

} // namespace damslip::keys

namespace damslip {

std::vector<KeyGroup> key_groups(SectionInput& section)
{
    using namespace keys;
    const auto traced = [](const Material& dam) { return dam.crack == BodyCrack::traced; };
    std::vector<KeyGroup> groups{
        group("", "Top level.", std::identity(),
              {word("title", "file name", "what the scene is", "\"Reference dam\"", at(&Scene::title))}),
        project_group(),
        group("site", "Where the dam stands.", std::identity(),
              {number("gravity", {{"m_s2", 1.0}}, Range::inside(9, 10.5), "9.81",
                      "gravity in loads; the unit g of records is always 9.80665", "9.81", at(&Scene::gravity))}),
        section_group(section)};
    const auto append = [&groups](std::vector<KeyGroup> more) {
        for (KeyGroup& g : more) groups.push_back(std::move(g));
    };
    append(wedge_groups());
    groups.push_back(group(
        "dam", "Concrete of the dam, or rock of the block.", &Scene::dam,
        {number("density", density, Range::half_open(0, 1e5), "required", "density", "2500", at(&Material::density)),
         number("young_modulus", modulus, Range::above(0), "none; FE commands ask for it", "Young's modulus", "25",
                at(&Material::young_modulus)),
         number("poisson_ratio", none, Range{0, 0.5, false, true}, "0.2", "Poisson's ratio", "0.17",
                at(&Material::poisson_ratio)),
         number("tensile_strength", {{"MPa", 1e6}, {"kPa", 1e3}, {"Pa", 1.0}}, Range::above(0),
                "none: `fe` gives the largest stress itself",
                "of the concrete, against which `fe` holds the largest tension away from all joints; mass concrete has "
                "1.5 to "
                "3 MPa (Raphael 1984)",
                "2.5", at(&Material::tensile_strength)),
         word("crack", "none",
              "none: the concrete stays whole, and `fe` says where it would crack; traced: `fe` follows cracks from "
              "the faces on paths "
              "of their own (tensile_strength is required)",
              "\"traced\"", choice(&Material::crack, {{"none", BodyCrack::none}, {"traced", BodyCrack::traced}})),
         only_where<Material>(traced, number("crack_friction", none, Range::half_open(0, 10), "1",
                                             "friction of a crack", "1.0", at(&Material::crack_friction))),
         only_where<Material>(traced, number("fracture_energy_tension", surface_energy, Range::above(0), "200",
                                             "G_I of the concrete", "200", at(&Material::tension_energy))),
         only_where<Material>(traced, number("fracture_energy_shear", surface_energy, Range::above(0), "2000",
                                             "G_II of the concrete", "2000", at(&Material::shear_energy)))}));
    append(base_groups());
    append(water_groups());
    using F = PointForce;
    groups.push_back(list_group(
        "force", "A force on the dam given by the user.", &Scene::forces,
        {word("name", "force", "name in the tables", "\"gate\"", at(&F::name)),
         number("x", length, Range::any(), "0", "where it acts, downstream of the heel", "6",
                in(&F::at, at(&Point::x))),
         number("y", length, Range::any(), "0", "where it acts, above the heel", "60", in(&F::at, at(&Point::y))),
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
    groups.push_back(list_group(
        "regressions.weight",
        "Weight of one regression in the weighted median and band; without any, all that are valid count equally.",
        [](Scene & s) -> auto& { return s.regressions.weights; },
        {word("model", "required", "id of a regression, as listed in docs/regressions.md", "\"jibson-2007-ratio\"",
              at(&W::model)),
         number("weight", none, Range::at_least(0), "1", "relative to the other weights", "2", at(&W::weight))}));
    groups.push_back(flexible_block_group());
    groups.push_back(group(
        "criteria", "What is allowed.", &Scene::criteria,
        {number("allowable_slip", {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}}, Range::at_least(0), "none",
                "slip verdicts compare with this", "0.1", at(&Criteria::allowable_slip)),
         word("document", "none",
              "shipped set of required safety factors, or a file of yours (.toml) with title, source, [[combination]] and [criteria]: "
              "load combinations where the scene has none, and what they require",
              "\"criteria/canada_1999.toml\"", at(&Criteria::document)),
         word("report_order", "empty", "titles of the report's sections that come first", "\"Planes, Slip\"",
              at(&Criteria::report_order)),
         number("pga_fraction", none, Range::half_open(0, 2), "1",
                "of the seismic combination that the program makes: k_h as share of the largest PGA of the records",
                "0.67", at(&Criteria::pga_fraction)),
         number("pga_v_fraction", none, Range::between(0, 2), "0",
                "and k_v as share of their largest vertical acceleration; it lightens the dam", "0.3",
                at(&Criteria::pga_v_fraction))}));
    groups.push_back(combination_group());
    append(fe_groups());
    add_usual_ranges(groups);
    return groups;
}

void apply_preset(Scene& scene, const std::function<bool(const char* key)>& open)
{
    if (scene.analysis.preset != AnalysisPreset::goldgruber_2015) return;
    if (open("contact.enforcement")) scene.contact.enforcement = ContactEnforcement::slip_tolerance;
    if (open("contact.slip_tolerance")) scene.contact.slip_tolerance = 0.005;
    if (open("contact.separation")) scene.contact.separation = JointOpening::none;
    if (scene.foundation && open("foundation.mass")) scene.foundation->mass = RockMass::massless;
    if (scene.foundation && open("foundation.boundary")) scene.foundation->boundary = RockBoundary::fixed;
    if (scene.reservoir && open("reservoir.far_end")) scene.reservoir->far_end = FarEnd::damper;
    if (scene.reservoir && open("reservoir.bottom_motion")) scene.reservoir->bottom_motion = BottomMotion::still;
    if (scene.reservoir && open("reservoir.bottom_reflection") && !scene.reservoir->bottom_density)
        scene.reservoir->bottom_reflection = 1.0;
    if (open("damping.mass")) scene.damping.mass = MassDamping::relative;
    if (open("time.scheme")) scene.time.scheme = TimeScheme::hht;
    if (open("time.alpha")) scene.time.alpha = -1.0 / 3.0;
    if (open("time.dt")) scene.time.dt = 0.01;
    if (open("time.substeps") && open("time.slip_tolerance")) scene.time.substeps = 0;
}

namespace {

using namespace methods;

constexpr Methods blocks = rigid | flexible, finite_elements = fe | reduced, slips = blocks | finite_elements,
                  tied = spectrum | modes, model = tied | finite_elements,
                  statics = slips | equilibrium | regressions | spectrum, all = statics | modes,
                  moments = rigid | equilibrium | spectrum | finite_elements;

constexpr std::array<const char*, 8> names{"rigid",    "flexible", "equilibrium", "regressions",
                                           "spectrum", "fe",       "reduced",     "modes"};

struct Row {
    const char* key; ///< "drains.lost_at_slip", or a table: all its keys that have no row of their own
    Methods honoured;
};

// clang-format off
constexpr std::array rows{
    Row{"site", statics},
    Row{"section", all},
    Row{"wedge", rigid | equilibrium | regressions}, Row{"wedge.plane", rigid | equilibrium | regressions},
    Row{"wedge.force", rigid | equilibrium | regressions},
    Row{"dam", model}, Row{"dam.density", all}, Row{"dam.tensile_strength", fe},
    Row{"dam.crack", fe}, Row{"dam.crack_friction", fe}, Row{"dam.fracture_energy_tension", fe}, Row{"dam.fracture_energy_shear", fe},

    Row{"contact", slips}, Row{"contact.friction", statics}, Row{"contact.cohesion", statics},
    Row{"contact.cohesion_lost_at_slip", slips | equilibrium}, Row{"contact.residual_friction", slips | equilibrium},
    Row{"contact.friction_table", slips | equilibrium},
    Row{"contact.sliding", fe}, Row{"contact.max_slip", fe},
    Row{"contact.separation", finite_elements}, Row{"contact.enforcement", finite_elements},
    Row{"contact.tangential_stiffness", finite_elements}, Row{"contact.slip_tolerance", finite_elements},
    Row{"contact.normal", fe}, Row{"contact.pressure_at_zero_clearance", fe}, Row{"contact.clearance_at_zero_pressure", fe},
    Row{"contact.bond", finite_elements}, Row{"contact.tensile_strength", finite_elements}, Row{"contact.fracture_energy_tension", finite_elements},
    Row{"contact.fracture_energy_shear", finite_elements}, Row{"contact.unloading", finite_elements}, Row{"contact.softening", finite_elements},
    Row{"contact.dynamic_increase", finite_elements},
    Row{"contact.kinetic_friction_ratio", rigid | finite_elements}, Row{"contact.characteristic_rate", rigid | finite_elements},
    Row{"contact.relaxation_time", rigid | finite_elements}, Row{"contact.relaxation_slip", rigid | finite_elements},
    Row{"contact.restitution", rigid | fe},
    Row{"lift_joint", fe}, Row{"lift_joint.elevation", fe | tied},
    Row{"lifts", rigid | fe}, Row{"lifts.active", fe}, Row{"lifts.fracture_energy_tension", fe},
    Row{"lifts.fracture_energy_shear", fe}, Row{"lifts.softening", fe}, Row{"lifts.dynamic_increase", fe},
    Row{"lifts.amplification", rigid}, Row{"lifts.crest_amplification", rigid},
    Row{"lifts.exponent", rigid}, Row{"lifts.amplification_points", rigid}, Row{"seam", rigid | fe}, Row{"seam.dilation", rigid}, Row{"seam.dilation_slip", rigid},
    Row{"seam.wedge", rigid | fe}, Row{"seam.wedge.dilation", rigid}, Row{"seam.interface", rigid | fe}, Row{"seam.interface.angle", rigid},
    Row{"planes", rigid},
    Row{"anchor", rigid | finite_elements}, Row{"anchor.distance", equilibrium | spectrum | finite_elements},
    Row{"anchor.prestress", rigid | equilibrium | regressions | spectrum | finite_elements},
    Row{"anchor.inclination", rigid | equilibrium | regressions | spectrum | finite_elements},
    Row{"anchor.dowel", rigid | equilibrium | regressions | spectrum | finite_elements},
    Row{"anchor.limit_force", equilibrium | spectrum},

    Row{"uplift", statics}, Row{"uplift.crack", blocks | equilibrium | regressions | finite_elements}, Row{"uplift.opening", slips},
    Row{"uplift.mouth_speed", slips}, Row{"uplift.after", rigid | finite_elements}, Row{"uplift.joint_clearance", finite_elements},
    Row{"uplift.water_viscosity", finite_elements}, Row{"uplift.cavitation_pressure", finite_elements}, Row{"uplift.wet_end", fe},
    Row{"curtain", statics}, Row{"curtain.young_modulus", model}, Row{"curtain.poisson_ratio", model},
    Row{"drains", statics}, Row{"drains.lost_at_slip", slips},
    Row{"foundation", model}, Row{"foundation.density", rigid | finite_elements}, Row{"foundation.ground", rigid | fe}, Row{"foundation.k0", fe}, Row{"foundation.mass", finite_elements},
    Row{"foundation.boundary", fe}, Row{"foundation.wave_box", finite_elements},
    Row{"foundation.wave_frequency", finite_elements}, Row{"foundation.permeability", statics},
    Row{"reservoir", finite_elements | modes}, Row{"reservoir.level", all}, Row{"reservoir.density", all}, Row{"reservoir.model", all},
    Row{"reservoir.bulk_modulus", finite_elements | tied}, Row{"reservoir.length", finite_elements | tied}, Row{"reservoir.far_end", finite_elements | tied},
    Row{"reservoir.mesh_size", finite_elements | tied}, Row{"reservoir.floor_pressure", finite_elements},
    Row{"reservoir.surface", finite_elements}, Row{"reservoir.floor", finite_elements}, Row{"reservoir.bottom_motion", finite_elements}, Row{"reservoir.bottom_reflection", finite_elements}, Row{"reservoir.bottom_density", finite_elements},
    Row{"reservoir.bottom_modulus", finite_elements},
    Row{"added_mass", all},
    Row{"gate", statics}, Row{"tailwater", statics}, Row{"silt", statics}, Row{"ice", statics}, Row{"force", statics},
    Row{"ice.level", moments}, Row{"force.x", moments}, Row{"force.y", moments},

    Row{"motion", statics}, Row{"motion.polarity", slips}, Row{"motion.vertical", slips | spectrum},
    // Modified Rayleigh damping is fitted to the record.
    Row{"motion.scale", statics | modes}, Row{"motion.record.scale", statics | modes},
    Row{"motion.sequence", rigid | regressions | spectrum | finite_elements | modes}, Row{"motion.sequence_pause", finite_elements},
    Row{"motion.record", statics}, Row{"motion.record.magnitude", regressions},
    Row{"sliding", blocks}, Row{"sliding.scheme", rigid}, Row{"sliding.restitution", rigid},
    Row{"sliding.run_out_max", slips}, Row{"sliding.steady_rate_change", finite_elements},
    Row{"regressions", flexible | regressions}, Row{"regressions.weight", regressions},
    Row{"flexible_block", flexible},
    Row{"criteria", equilibrium}, Row{"criteria.allowable_slip", slips},
    Row{"combination", equilibrium},

    Row{"mesh", model}, Row{"mesh.rock_contact_size", fe},
    Row{"stages", finite_elements},
    Row{"damping", finite_elements}, Row{"damping.ratio", model},
    Row{"damping.first_mode", finite_elements | modes}, Row{"damping.second_mode", finite_elements | modes},
    Row{"time", finite_elements},
    Row{"analysis", finite_elements},
};
// clang-format on

/// What a method leaves out though the scene asks for it.
struct LeftOut {
    Methods set;
    const char* key; ///< as in the sentence
    bool (*asked)(const Scene&);
    const char* instead;
};

bool follows_opening(const Scene& s, OpeningWater rule)
{
    return s.uplift && s.uplift->model != UpliftModel::none && s.uplift->water.opening == rule;
}

const std::array left_out{
    LeftOut{blocks, "[[lift_joint]]", [](const Scene& s) { return !s.lift_joints.empty(); },
            "it is the dam in one piece on its base; slip and opening of lift joints are left to finite elements"},
    LeftOut{blocks, "contact.bond",
            [](const Scene& s) {
                return breaks_by_energy(s.contact) ||
                       (s.contact.cohesion > 0.0 && bond_loss(s.contact) == BondLoss::pairs);
            },
            "it loses its cohesion all at once, at mu N' + c A"},
    LeftOut{blocks, "uplift.opening = \"reynolds\"",
            [](const Scene& s) { return follows_opening(s, OpeningWater::reynolds); },
            "its joint has no width, the uplift stays as it was"},
    LeftOut{blocks, "contact.restitution",
            [](const Scene& s) { return s.contact.restitution > 0.0 && s.sliding.lift_off != LiftOff::ballistic; },
            "with sliding.lift_off = \"no-friction\" it does not fly, and has nothing to rebound from"},
    LeftOut{blocks, "added_mass.period_s = \"dam\"",
            [](const Scene& s) {
                return s.added_mass.period_of_dam && s.reservoir && s.reservoir->model != ReservoirModel::hydrostatic &&
                       s.added_mass.formula == AddedMassFormula::westergaard;
            },
            "it has no period; its water is incompressible"},
    LeftOut{finite_elements, "added_mass.inclined_face = \"horizontal\"",
            [](const Scene& s) {
                const Polyline face = upstream_face(s.section);
                return s.reservoir && s.added_mass.inclined_face == InclinedFaceRule::horizontal &&
                       face.front().x != face.back().x;
            },
            "their water pushes along the normal of the face"},
    LeftOut{finite_elements, "[lifts]", [](const Scene& s) { return s.lifts.has_value(); },
            "their dam is tied there; `fe` and `assess` let them slide"},
    LeftOut{finite_elements, "[[seam]]", [](const Scene& s) { return !s.seams.empty() && s.planes.slides_on.empty(); },
            "they slide on the base; `fe --plane NAME`, `sweep --plane NAME` and `screen` follow the seam"},
    LeftOut{regressions, "[[seam]]", [](const Scene& s) { return !s.seams.empty(); }, nullptr},
    LeftOut{finite_elements, "uplift.crack",
            [](const Scene& s) {
                return s.uplift && s.uplift->crack != CrackRule::none &&
                       (follows_opening(s, OpeningWater::unchanged) || follows_opening(s, OpeningWater::zero));
            },
            "their base opens by itself, and the uplift of the whole base stays in the crack; write uplift.opening"},
    LeftOut{finite_elements, "sliding.two_way = false", [](const Scene& s) { return !s.sliding.two_way; },
            "their joint slides either way"},
    LeftOut{
        regressions, "contact.residual_friction",
        [](const Scene& s) { return s.contact.residual_friction.value_or(s.contact.friction) != s.contact.friction; },
        nullptr},
    LeftOut{regressions, "contact.friction_table_m", [](const Scene& s) { return !s.contact.friction_table.empty(); },
            nullptr},
    LeftOut{regressions, "the loss of contact.cohesion_kPa at the first slip",
            [](const Scene& s) { return s.contact.cohesion > 0.0 && s.contact.cohesion_lost_at_slip; }, nullptr},
    LeftOut{regressions, "contact.kinetic_friction_ratio", [](const Scene& s) { return s.contact.rate.active(); },
            nullptr},
    LeftOut{regressions, "uplift.opening",
            [](const Scene& s) {
                return s.uplift && s.uplift->model != UpliftModel::none && !follows_opening(s, OpeningWater::unchanged);
            },
            nullptr},
    LeftOut{regressions, "drains.lost_at_slip_m",
            [](const Scene& s) { return s.drains && s.drains->lost_at_slip.has_value(); }, nullptr},
};

} // namespace

Methods honoured_by(const std::string& table, const std::string& key)
{
    for (const std::string& name : {table + "." + key, table})
        for (const Row& row : rows)
            if (name == row.key) return key == "name" ? 0 : row.honoured;
    return 0;
}

std::string method_words(Methods set)
{
    if (set == all) return "all";
    std::string words;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (set & (1u << i)) words += std::string(words.empty() ? "" : ", ") + names[i];
    return words.empty() ? "none" : words;
}

std::vector<Diagnostic> not_honoured(const Scene& scene, Methods set)
{
    std::vector<Diagnostic> notes;
    if (scene.wedge) return notes;
    for (const LeftOut& row : left_out) {
        if (!(row.set & set) || !row.asked(scene)) continue;
        Diagnostic& note = notes.emplace_back();
        const bool of_regressions = row.set == regressions;
        const char* who = of_regressions ? "regressions" : row.set == blocks ? "sliding block" : "finite elements";
        note.problem = fmt::format("{} is not in the slip of the {}: {}.", row.key, who,
                                   row.instead ? row.instead : "they know the yield of the block at rest alone");
        if (!of_regressions) note.fix = "no PASS rests on that slip";
    }
    return notes;
}

} // namespace damslip
