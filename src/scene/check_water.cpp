#include "core/text.hpp"
#include "core/units.hpp"
#include "scene/added_mass_formulas.hpp"
#include "scene/check.hpp"
#include "scene/joint_bond.hpp"
#include "scene/plausible.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <vector>

namespace damslip::checks {

namespace {

void check_acoustic_water(const Reservoir& water, Findings& f)
{
    if (water.bottom_density.has_value() != water.bottom_modulus.has_value())
        f.wrong(water.bottom_density ? "reservoir.bottom_density" : "reservoir.bottom_modulus",
                "one of reservoir.bottom_density_kg_m3 and reservoir.bottom_modulus_GPa is missing.",
                "both: together they give the wave reflection coefficient (Goldgruber 2015, 3-55)",
                "add the other one, or give bottom_reflection instead");
    if ((water.bottom_density || water.bottom_modulus) && f.given("reservoir.bottom_reflection"))
        f.wrong("reservoir.bottom_reflection",
                "reservoir.bottom_reflection is given together with the density or modulus of the bottom.",
                "one of the two descriptions", "delete one");
    if (f.given("reservoir.length") && water.length > 100 * water.level)
        f.wrong("reservoir.length",
                fmt::format("{} is more than a hundred times the depth of {} m.",
                            value("reservoir.length_m", water.length), shortest(water.level)),
                fmt::format("at most 100 x level_m, {} m; 1 to 3 x level_m is usual", shortest(100 * water.level)),
                "check the unit, or lessen the length: far_end = \"absorbing\" needs one depth only");
    if (water.mesh_size && *water.mesh_size > water.level / 4)
        f.wrong("reservoir.mesh_size",
                fmt::format("{} leaves fewer than four elements over the depth of {} m.",
                            value("reservoir.mesh_size_m", *water.mesh_size), shortest(water.level)),
                "at most a quarter of the depth; a tenth resolves the waves that matter",
                fmt::format("write  mesh_size_m = {}", shortest(water.level / 20)));
}

/// What the formula of the added mass needs; Goldgruber & Feldbacher's (3-10) is of faces within 30 degrees.
void check_formula_of_added_mass(const Scene& s, Findings& f)
{
    if (!s.reservoir || s.reservoir->model == ReservoirModel::hydrostatic) return;
    if (const AddedMassRow& row = added_mass_row(s.added_mass.formula); !has_what_it_needs(s, row))
        f.wrong("added_mass.formula", fmt::format("added_mass.formula = \"{}\" needs {}.", row.word, row.needs),
                row.needs, fmt::format("add {} or choose another added_mass.formula", row.needs));
    if (s.added_mass.formula != AddedMassFormula::goldgruber) return;
    const Polyline face = upstream_face(s.section);
    for (std::size_t i = 0; i + 1 < face.size(); ++i) {
        const double angle = std::atan2(face[i + 1].x - face[i].x, face[i + 1].y - face[i].y) / units::degree;
        if (face[i].y >= s.reservoir->level || angle <= 30.0 * (1.0 + 1e-12)) continue;
        f.wrong(
            "added_mass.formula",
            fmt::format("added_mass.formula = \"goldgruber\" with a wet face {:.4g} degrees from the vertical.", angle),
            "a wet upstream face within 0 to 30 degrees of the vertical, the range of (3-10)",
            "use added_mass.formula = \"zangar\" or \"westergaard\"");
        return;
    }
}

void check_crack_water(const Scene& s, Findings& f)
{
    const double depth = upstream_face(s.section).back().y;
    if (f.given("section.slope_height") && s.reservoir && s.reservoir->level > depth * (1 + 1e-12))
        f.wrong("reservoir.level",
                fmt::format("{} does not fit into the tension crack, which is {} m deep.",
                            value("reservoir.level_m", s.reservoir->level), shortest(depth)),
                "depth of the water above the foot of the crack, at most the crack's depth", "lower it");
}

/// Is the point within the polygon, or within a millionth of its size of an edge?
bool holds(const Polyline& polygon, Point p)
{
    bool inside = false;
    double size = 0.0, nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Point a = polygon[j], b = polygon[i], along{b.x - a.x, b.y - a.y};
        const double length2 = along.x * along.x + along.y * along.y;
        const double q = std::clamp(((p.x - a.x) * along.x + (p.y - a.y) * along.y) / length2, 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(p.x - a.x - q * along.x, p.y - a.y - q * along.y));
        size = std::max(size, std::sqrt(length2));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * along.x) inside = !inside;
    }
    return inside || nearest <= 1e-6 * size;
}

void check_forces(const Scene& s, Findings& f)
{
    for (std::size_t i = 0; i < s.forces.size(); ++i) {
        const PointForce& force = s.forces[i];
        if (holds(s.section.polygon, force.at)) continue;
        const std::string label = fmt::format("force[{}]", i + 1);
        f.wrong(label + ".x",
                fmt::format("{}, \"{}\", acts at ({}, {}) m, outside the dam.", label, force.name, shortest(force.at.x),
                            shortest(force.at.y)),
                "x_m, y_m of a point of the section", "move it to the face or into the dam");
    }
}

/// Whether gates hold a level above the crest or it flows over the dam is never assumed.
void check_level(const Scene& s, double level, bool gates_open, const std::string& key, Findings& f)
{
    const double top = upstream_face(s.section).back().y;
    const bool between = s.gate && !gates_open && s.gate->top <= top; // piers in the outline
    const double crest = between ? s.gate->top : top;
    if (!(level > crest * (1 + 1e-12)) || s.section.rock_slope || s.reservoir->overtopped || (s.gate && gates_open))
        return;
    if (s.gate && level <= s.gate->top * (1 + 1e-12)) return;
    const std::string problem =
        fmt::format("{}_m = {} is {} m above the {} at {} m", key, shortest(level),
                    six_digits(level - (s.gate ? s.gate->top : crest)), s.gate ? "top of the gates" : "crest",
                    shortest(s.gate ? s.gate->top : crest));
    if (s.gate)
        f.wrong(key, problem + ".", "a level up to gate.top_m, or  gates_open = true  in a [[combination]]",
                fmt::format("write  top_m = {}  in [gate]", shortest(level)));
    else
        f.wrong(
            key, problem + ", and the scene does not say what holds it.",
            "[gate]: gates in the plane of the upstream face and a dry crest; or  overtopped = true  in [reservoir]: "
            "the water flows over and stands on the crest",
            fmt::format("add  [gate]  with  top_m = {} , or write  overtopped = true  in [reservoir]",
                        shortest(level)));
}

void check_gate(const Scene& s, Findings& f)
{
    if (s.gate) {
        const Polyline face = upstream_face(s.section);
        if (!s.reservoir || s.reservoir->overtopped || s.section.rock_slope)
            f.wrong("gate", "[gate] without a [reservoir] whose water it holds.",
                    "[reservoir] without overtopped = true, of a dam", "delete [gate] or overtopped");
        const bool between_piers = mean_share(s.section, s.gate->top * (1.0 - 1e-9), s.gate->top) < 1.0;
        if ((!(s.gate->top > face.back().y) && !between_piers) ||
            !(downstream_face(s.section).back().x > face.back().x))
            f.wrong("gate.top",
                    fmt::format("{} does not stand on the crest, which is at {} m.", value("gate.top_m", s.gate->top),
                                shortest(face.back().y)),
                    "a height above a crest that has a width: it carries the moment of the thrust",
                    "give the top of the gates above the heel");
    }
    if (!s.reservoir) return;
    check_level(s, s.reservoir->level, false, "reservoir.level", f);
    for (std::size_t i = 0; i < s.combinations.size(); ++i) {
        const Combination& c = s.combinations[i];
        const std::string label = fmt::format("combination[{}]", i + 1);
        if (c.gates_open && !s.gate)
            f.wrong(label + ".gates_open", label + ".gates_open = true, but the scene has no [gate].", "a [gate] table",
                    "add [gate], or write  overtopped = true  in [reservoir]");
        else if (c.reservoir_level)
            check_level(s, *c.reservoir_level, c.gates_open, label + ".reservoir_level", f);
    }
}

/// Tailwater stands on the crest only where the reservoir flows over it (a drowned weir); ice pushes against the face or the gates.
void check_other_levels(const Scene& s, Findings& f)
{
    if (s.section.rock_slope) return;
    const bool flows_over = s.reservoir && s.reservoir->overtopped;
    const double upstream = upstream_face(s.section).back().y, downstream = downstream_face(s.section).back().y;
    const auto above = [&](const std::string& key, double level, double crest, const std::string& expected) {
        if (level > crest * (1 + 1e-12))
            f.wrong(key,
                    fmt::format("{}_m = {} is {} m above the crest at {} m.", key, shortest(level), six_digits(level - crest),
                                shortest(crest)),
                    expected, "check datum and unit: levels are measured from the heel");
    };
    const std::string of_tailwater = fmt::format("a tailwater up to the crest, {} m; higher only with  overtopped = true  in [reservoir]", shortest(downstream));
    if (s.tailwater && !flows_over) above("tailwater.level", s.tailwater->level, downstream, of_tailwater);
    for (std::size_t i = 0; i < s.combinations.size(); ++i)
        if (s.combinations[i].tailwater_level && !flows_over)
            above(fmt::format("combination[{}].tailwater_level", i + 1), *s.combinations[i].tailwater_level, downstream,
                  of_tailwater);
    if (s.ice && f.given("ice.level"))
        above("ice.level", s.ice->level, s.gate       ? std::max(upstream, s.gate->top)
              : flows_over ? std::max(upstream, s.reservoir->level)
                           : upstream,
              "ice at the water surface, on the face of the dam");
}

/// What presses up under the base is never assumed away: a dry base is written down.
void check_uplift_is_said(const Scene& s, Findings& f)
{
    if (s.uplift || !water_on_dam(s)) return;
    f.wrong(
        s.reservoir ? "reservoir" : "tailwater",
        fmt::format("there is water on the dam, [{}], but nothing says how it presses up under the base.",
                    s.reservoir ? "reservoir" : "tailwater"),
        "[uplift], or a [curtain] (uplift by seepage) or [drains] (uplift with drains)",
        "add  [uplift]  with  model = \"linear\"  (heel to toe, the safe side), or  model = \"none\"  for a dry base");
}

} // namespace

void check_water(const Scene& s, Findings& f)
{
    if (s.stages.pore_pressure != PorePressure::none && s.reservoir && s.reservoir->floor_pressure)
        f.wrong("stages.pore_pressure",
                "stages.pore_pressure is given together with reservoir.floor_pressure = true: the floor would be "
                "loaded twice.",
                "one of the two: the water in the rock brings the pressure on its surface with it",
                "delete floor_pressure");
    check_other_levels(s, f);
    if (s.silt && s.silt->level > crest_level(s.section))
        f.wrong("silt.level",
                fmt::format("{} is above the crest at {} m.", value("silt.level_m", s.silt->level),
                            shortest(crest_level(s.section))),
                "at most the crest", "lower it");
    if (s.reservoir && s.reservoir->level > 3 * crest_level(s.section))
        f.wrong("reservoir.level",
                fmt::format("{} is more than three times the height of the crest, {} m.",
                            value("reservoir.level_m", s.reservoir->level), shortest(crest_level(s.section))),
                "metres above the heel", "check datum and unit");
    check_crack_water(s, f);
    check_gate(s, f);
    check_forces(s, f);
    check_uplift_is_said(s, f);
    if (s.reservoir) check_acoustic_water(*s.reservoir, f);
    check_formula_of_added_mass(s, f);
    if (s.added_mass.period && s.reservoir) {
        double h = s.reservoir->level; // the highest of all states
        for (const Combination& state : s.combinations) h = std::max(h, state.reservoir_level.value_or(h));
        const double c = std::sqrt(s.reservoir->bulk_modulus / s.reservoir->density);
        if (s.added_mass.formula == AddedMassFormula::westergaard && *s.added_mass.period <= 4 * h / c)
            f.wrong("added_mass.period",
                    fmt::format("{} is not above the reservoir's own first period 4 h/c = {:.4g} s.",
                                value("added_mass.period_s", *s.added_mass.period), 4 * h / c),
                    "the period of the excitation or of the dam, longer than 4 h/c; Westergaard's series (3-1) has a "
                    "pole there",
                    "leave period_s out for incompressible water, or model the reservoir as acoustic");
    }
    for (std::size_t i = 1; i < s.added_mass.zangar_table.size(); ++i)
        if (s.added_mass.zangar_table[i].x <= s.added_mass.zangar_table[i - 1].x) {
            f.wrong("added_mass.zangar_table", "added_mass.zangar_table_deg has angles that do not increase.",
                    "angles from the vertical, increasing", "put the pairs in order");
            break;
        }
}

namespace {

/// Keys that only one rule reads.
void check_keys_of_rule(const JointWaterLaw& law, Findings& f)
{
    if (law.opening == OpeningWater::mouth && !law.mouth_speed)
        f.wrong("uplift.opening", "uplift.opening = \"mouth\" without uplift.mouth_speed_m_s.",
                "the speed at which water enters the crack, above 0 [m_s]: no value of it is agreed on",
                "add  mouth_speed_m_s = 5  (and try others), or write  opening = \"full\"");
    std::vector<std::pair<std::string, const char*>> idle; // keys, and the rule that reads them
    if (law.opening == OpeningWater::unchanged && law.mouth_speed) idle.emplace_back("mouth_speed", "mouth");
    if (law.opening != OpeningWater::reynolds)
        for (const char* key : {"joint_clearance", "water_viscosity", "cavitation_pressure", "wet_end"})
            if (f.given(std::string("uplift.") + key)) idle.emplace_back(key, "reynolds");
    for (const auto& [key, rule] : idle) {
        f.note("uplift." + key,
               fmt::format("uplift.{} is not read with uplift.opening = \"{}\".", key, word(law.opening)),
               fmt::format("opening = \"{}\", the only rule that reads it", rule),
               fmt::format("keep it for  sweep --opening-water {} , or delete it", rule));
    }
}

} // namespace

void check_opening_water(const Scene& s, Findings& f)
{
    if (!s.uplift) return;
    const JointWaterLaw& law = s.uplift->water;
    check_keys_of_rule(law, f);
    if (!law.follows()) return;
    if (law.opening == OpeningWater::reynolds && drains_shear_off(s))
        f.wrong("drains.lost_at_slip", "drains.lost_at_slip_m with uplift.opening = \"reynolds\".",
                "drains that hold, whose pressure the flow along the joint knows; or another rule of the water",
                "delete lost_at_slip_m in [drains], or write  opening = \"full\"  in [uplift]");
    const bool opens = law.opening != OpeningWater::unchanged;
    const std::string key = opens ? "uplift.opening" : "uplift.after";
    const std::string said =
        opens ? fmt::format("uplift.opening = \"{}\"", word(law.opening)) : "uplift.after = \"full\"";
    if (s.uplift->model == UpliftModel::none)
        f.wrong(key, fmt::format("{} with uplift.model = \"none\".", said),
                "an uplift model: a dry base has no water to follow its opening",
                fmt::format("write  model = \"linear\" , or delete {}", opens ? "opening" : "after"));
    if (!s.reservoir && !s.tailwater)
        f.wrong(key, fmt::format("{} with neither [reservoir] nor [tailwater].", said),
                "water before one end of the base at least", "add [reservoir] with its level_m, or delete the key");
    if (opens && s.sliding.scheme == SlidingScheme::slammer)
        f.wrong("sliding.scheme", fmt::format("sliding.scheme = \"slammer\" with {}.", said),
                "scheme = \"exact\": that of SLAMMER has one yield acceleration",
                "delete scheme in [sliding], or opening in [uplift]");
    if (law.wet_end == WetEndPressure::with_waves && !s.reservoir)
        f.wrong("uplift.wet_end", "uplift.wet_end = \"with-waves\" without [reservoir].",
                "a reservoir whose waves reach the heel", "add [reservoir], or write  wet_end = \"still\"");
}

} // namespace damslip::checks
