#include "scene/plausible.hpp"

#include "core/text.hpp"
#include "scene/check.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace damslip {

namespace {

/// A reading of the number that would be usual.
struct Meant {
    double value = 0.0;  ///< in the key's first unit
    std::string if_what; ///< "MPa was meant"
    std::string spelled; ///< the line to write; empty: the value by itself
};

/// "kg_m3" -> "kg/m3".
std::string spoken(std::string suffix)
{
    if (const std::size_t at = suffix.find('_'); at != std::string::npos) suffix[at] = '/';
    return suffix;
}

std::string with_unit(const std::string& number, const UnitSuffix& unit)
{
    return unit.suffix.empty() ? number : number + " " + spoken(unit.suffix);
}

double in_first_unit(double value, const UnitSuffix& unit, const UnitSuffix& first)
{
    if (unit.suffix == first.suffix) return value;
    return to_si(value, unit) / first.factor;
}

std::string name_of(const UnitSuffix& unit)
{
    return unit.suffix.empty() ? "the plain number" : unit.tangent ? "an angle in deg" : spoken(unit.suffix);
}

/// The same figures in another unit of the key.
std::optional<Meant> other_unit(const Key& key, const WrittenNumber& number)
{
    for (const UnitSuffix& unit : key.units) {
        if (unit.suffix == number.unit.suffix || (unit.tangent && !(number.value >= 0 && number.value < 89.9)))
            continue;
        const double value = in_first_unit(number.value, unit, key.units.front());
        if (!key.usual->contains(value) || value == 0.0) continue;
        return Meant{value, name_of(unit) + " was meant", key.spelled(unit) + " = " + shortest(number.value)};
    }
    return std::nullopt;
}

struct Step {
    double factor;
    const char* if_what;
};

std::optional<Meant> stepped(const Key& key, double value, std::initializer_list<Step> steps)
{
    for (const Step& step : steps)
        if (key.usual->contains(value * step.factor) && value != 0.0)
            return Meant{value * step.factor, step.if_what, {}};
    return std::nullopt;
}

/// What the number may have been meant as: one unit step away, for numbers without unit a step of the decimal point or of per
/// cent, for a hydraulic conductivity the sign of its exponent.
std::optional<Meant> meant(const Key& key, const WrittenNumber& number)
{
    const UnitSuffix& first = key.units.front();
    const double value = in_first_unit(number.value, number.unit, first);
    if (number.unit.tangent) return other_unit(key, number); // ten times the angle is not ten times its tangent
    if (first.suffix.empty()) {
        if (auto step = stepped(key, value, {{0.1, "the decimal point is one place off"}})) return step;
        if (auto unit = other_unit(key, number)) return unit;
        return stepped(key, value, {{0.01, "per cent was meant"}, {10.0, "the decimal point is one place off"}});
    }
    if (auto unit = other_unit(key, number)) return unit;
    if (first.suffix == "m_s" && value > 1.0 && key.usual->contains(1.0 / value))
        return Meant{1.0 / value, "the minus of the exponent is missing", {}};
    return stepped(key, value,
                   {{1e-3, "it is a thousandfold too large"},
                    {1e3, "it is a thousandfold too small"},
                    {1e-6, "it is a millionfold too large"},
                    {1e6, "it is a millionfold too small"}});
}

} // namespace

std::string six_digits(double value)
{
    return fmt::format("{:.6g}", value);
}

std::string usual_text(const Usual& usual, const UnitSuffix& unit)
{
    return fmt::format("{} ... {} ({})", shortest(usual.low), with_unit(shortest(usual.high), unit), usual.source);
}

std::optional<Diagnostic> unusual(const Key& key, const WrittenNumber& number)
{
    if (!key.usual) return std::nullopt;
    const UnitSuffix& first = key.units.front();
    const double value = in_first_unit(number.value, number.unit, first);
    if (key.usual->contains(value)) return std::nullopt;
    Diagnostic note;
    const std::string converted =
        number.unit.suffix == first.suffix ? "" : ", " + with_unit(six_digits(value), first) + ",";
    note.problem = number.subject + converted + " is unusual.";
    note.expected = usual_text(*key.usual, first);
    if (const auto guess = meant(key, number)) {
        note.fix = fmt::format("{} if {}", with_unit(six_digits(guess->value), first), guess->if_what);
        if (number.in_file && !guess->spelled.empty()) note.fix += ":  " + guess->spelled;
    } else {
        note.fix = "check value and unit";
    }
    return note;
}

Key key_named(const std::string& name)
{
    static SectionInput section;
    static const std::vector<KeyGroup> groups = key_groups(section);
    for (const KeyGroup& group : groups)
        for (const Key& key : group.keys)
            if (group.name + "." + key.name == name) return key;
    assert(false && "no such key");
    return {};
}

std::string note_text(const Diagnostic& note)
{
    std::string text = note.file;
    if (note.line > 0) text += ":" + std::to_string(note.line);
    text += (text.empty() ? "" : ": ") + note.problem;
    if (!note.expected.empty()) text += " Usual: " + note.expected + ".";
    if (note.fix.empty()) return text;
    std::string fix = note.fix;
    fix[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(fix[0])));
    return text + " " + fix + ".";
}

std::vector<std::string> note_texts(const std::vector<Diagnostic>& notes)
{
    std::vector<std::string> texts;
    for (const Diagnostic& note : notes) texts.push_back(note_text(note));
    return texts;
}

std::optional<Diagnostic> unusual_level(const std::string& subject, double level, double crest)
{
    if (!(level > crest * (1 + 1e-9))) return std::nullopt;
    Diagnostic note;
    note.problem =
        fmt::format("{} is {} m above the crest at {} m.", subject, six_digits(level - crest), six_digits(crest));
    note.expected = fmt::format("up to the crest, {} m; higher only at a spillway, or in a flood that overtops the dam "
                                "(EM 1110-2-2200)",
                                six_digits(crest));
    note.fix = level * 0.3048 <= crest && level * 0.3048 > 0.5 * crest
                   ? fmt::format("{} m if ft was meant", six_digits(level * 0.3048))
                   : "check datum and unit: levels are measured from the heel";
    return note;
}

namespace {

/// A value beside another one it is usually in proportion to.
struct Proportion {
    const char* key;     ///< "curtain.depth", where the note stands
    double value;        ///< [m]
    double length;       ///< [m]
    const char* of;      ///< "the dam's height"
    double low, high;    ///< of value / length
    const char* source;
    std::string written = std::string(key) + "_m";
};

void look_at(const Proportion& p, Findings& f)
{
    const double ratio = p.value / p.length;
    if (ratio >= p.low * (1 - 1e-9) && ratio <= p.high * (1 + 1e-9)) return;
    f.note(p.key,
           fmt::format("{} = {} is unusual: {} times {}, {} m.", p.written, six_digits(p.value), six_digits(ratio),
                       p.of, six_digits(p.length)),
           fmt::format("{} ... {} m, {} ... {} times {} ({})", six_digits(p.low * p.length),
                       six_digits(p.high * p.length), six_digits(p.low), six_digits(p.high), p.of, p.source),
           "check value and unit");
}

double height_of(const Section& section)
{
    return crest_level(section) - std::min(heel(section).y, toe(section).y);
}

/// Height and base of a polygon, which has no keys for them.
void look_at_polygon(const Scene& s, Findings& f)
{
    if (!f.given("section.polygon")) return;
    for (const auto& [name, value] :
         {std::pair("section.height", height_of(s.section)), std::pair("section.base", base_length(s.section))}) {
        const Key key = key_named(name);
        if (auto note = unusual(key, {fmt::format("the {} of section.polygon, {} m,", key.name, six_digits(value)),
                                      value, key.units.front(), false}))
            f.note("section.polygon", *note);
    }
}

void look_at_shape(const Scene& s, Findings& f)
{
    look_at_polygon(s, f);
    if (s.section.rock_slope) return;
    const char* const where = f.given("section.polygon") ? "section.polygon" : "section.base";
    look_at(
        {where, base_length(s.section), height_of(s.section), "its height", 0.3, 4, "judgement", "the section's base"},
        f);
}

/// Below the dam, along the base and into the rock.
void look_at_base(const Scene& s, Findings& f)
{
    const double base = base_length(s.section), height = height_of(s.section);
    if (s.curtain) {
        look_at({"curtain.distance", s.curtain->distance, base, "the base", 0, 1.0 / 3.0, "judgement"}, f);
        look_at({"curtain.depth", s.curtain->depth, height, "the dam's height", 0.1, 2, "USBR 1976"}, f);
    }
    if (s.drains) look_at({"drains.distance", s.drains->distance, base, "the base", 0, 0.5, "judgement"}, f);
    if (!s.foundation) return;
    look_at({"foundation.width", s.foundation->width, base, "the base", 2, 30, "judgement"}, f);
    look_at({"foundation.depth", s.foundation->depth, base, "the base", 0.5, 20, "judgement"}, f);
}

void look_at_level(const std::string& key, double level, double crest, Findings& f)
{
    if (const auto note = unusual_level(fmt::format("{}_m = {}", key, six_digits(level)), level, crest))
        f.note(key, *note);
}

/// A level that is above another one it usually is below.
void look_at_order(const std::string& key, double level, const std::string& other, double above, const char* reason,
                   Findings& f)
{
    if (level <= above * (1 + 1e-9)) return;
    f.note(key, fmt::format("{}_m = {} is above {} = {}.", key, six_digits(level), other, six_digits(above)),
           fmt::format("at most {}: {} (judgement)", six_digits(above), reason),
           "check datum and unit: both are measured from the heel");
}

void look_at_ice(const Scene& s, Findings& f)
{
    if (!s.ice || !s.reservoir || !f.given("ice.level")) return;
    const double below = s.reservoir->level - s.ice->level;
    if (below >= -1e-9 && below <= 2) return;
    f.note("ice.level",
           fmt::format("ice.level_m = {} is {} m {} the water surface, reservoir.level_m = {}.",
                       six_digits(s.ice->level), six_digits(std::abs(below)), below > 0 ? "below" : "above",
                       six_digits(s.reservoir->level)),
           "0 ... 2 m below the surface, on which the ice floats (judgement)",
           "leave level_m out: the ice then acts at the water surface");
}

void look_at_water(const Scene& s, Findings& f)
{
    if (s.section.rock_slope) return; // [reservoir] is the water in its tension crack
    const double crest = crest_level(s.section);
    const double reservoir = s.reservoir ? s.reservoir->level : 0.0;
    if (s.reservoir) {
        look_at_level("reservoir.level", reservoir, crest, f);
        if (reservoir > 0.0 && f.given("reservoir.length"))
            look_at({"reservoir.length", s.reservoir->length, reservoir, "the water's depth", 0.5, 10, "judgement"}, f);
    }
    if (s.tailwater && s.reservoir)
        look_at_order("tailwater.level", s.tailwater->level, "reservoir.level_m", reservoir,
                      "water downstream of the dam stands lower than upstream", f);
    if (s.drains && s.drains->gallery_level && s.reservoir)
        look_at_order("drains.gallery_level", *s.drains->gallery_level, "reservoir.level_m", reservoir,
                      "drains draw the pressure down to the gallery", f);
    if (s.silt && s.reservoir)
        look_at_order("silt.level", s.silt->level, "reservoir.level_m", reservoir, "silt settles under water", f);
    look_at_ice(s, f);
}

/// A flood may stand above the crest, a usual state does not.
void look_at_combinations(const Scene& s, Findings& f)
{
    for (std::size_t i = 0; i < s.combinations.size(); ++i) {
        const Combination& c = s.combinations[i];
        const std::string label = fmt::format("combination[{}]", i + 1);
        const double crest = crest_level(s.section);
        if (c.reservoir_level && (c.kind == CombinationKind::usual || *c.reservoir_level > 1.1 * crest))
            look_at_level(label + ".reservoir_level", *c.reservoir_level, crest, f);
        const double upstream = c.reservoir_level.value_or(s.reservoir ? s.reservoir->level : 0.0);
        if (c.tailwater_level && s.reservoir)
            look_at_order(label + ".tailwater_level", *c.tailwater_level, "the reservoir", upstream,
                          "water downstream of the dam stands lower than upstream", f);
    }
}

} // namespace

void note_unusual(const Scene& scene, Findings& findings)
{
    if (scene.wedge) return;
    look_at_shape(scene, findings);
    look_at_base(scene, findings);
    look_at_water(scene, findings);
    look_at_combinations(scene, findings);
}

namespace {

/// In the unit of the key's first suffix.
struct Row {
    const char* key;
    double low, high;
    const char* source;
    bool or_zero = false;
};

constexpr const char* judgement = "judgement";
constexpr const char* joints =
    "Skempton 1985; Barton & Choubey 1977"; // clay seams to rough clean joints: 6 to 58 degrees
constexpr const char* bond = "EPRI 1992";
constexpr const char* rock_weight = "Hoek & Bray 1981";
constexpr const char* safety = "EM 1110-2-2100";

// clang-format off
constexpr std::array rows{
    Row{"site.gravity", 9.76, 9.84, "WGS 84"},

    // Section: from weirs to Grande Dixence, 285 m.
    Row{"section.height", 2, 300, "ICOLD register"},
    Row{"section.base", 1, 300, "ICOLD register"},
    Row{"section.crest", 0.3, 60, judgement, true},
    Row{"section.neck", 0, 60, judgement},
    Row{"section.upstream_slope", 0, 1, "USBR 1976"},
    Row{"section.upstream_slope_height", 1, 300, "ICOLD register"},
    Row{"section.base_inclination", -20, 20, judgement},
    Row{"section.thickness", 0.1, 1, judgement},
    Row{"section.slope_height", 2, 500, rock_weight},
    Row{"section.face_dip", 20, 90, rock_weight},
    Row{"section.plane_dip", 10, 45, rock_weight},
    Row{"section.crack_distance", -100, 100, judgement},
    Row{"section.upper_dip", -45, 45, judgement},

    Row{"wedge.density", 1900, 3100, rock_weight},
    Row{"wedge.height", 2, 500, rock_weight},
    Row{"wedge.face_dip", 20, 90, rock_weight},
    Row{"wedge.upper_dip", 0, 60, judgement},
    Row{"wedge.volume", 1, 1e7, judgement},
    Row{"wedge.plane.dip", 5, 90, rock_weight},
    Row{"wedge.plane.friction", 0.1, 1.6, joints},
    Row{"wedge.plane.cohesion", 1, 3000, rock_weight, true},
    Row{"wedge.plane.area", 1, 1e6, judgement},
    Row{"wedge.plane.water_pressure", 0, 2000, judgement},
    Row{"wedge.force.force", 1, 1e6, judgement},

    // The dam may be masonry, or a block of soft rock.
    Row{"dam.density", 1900, 2900, "ACI 207.1R"},
    Row{"dam.young_modulus", 10, 50, "ACI 207.1R"},
    Row{"dam.poisson_ratio", 0.1, 0.3, "ACI 207.1R"},
    Row{"dam.tensile_strength", 0.5, 5, "Raphael 1984"},
    Row{"dam.crack_friction", 0.5, 1.6, judgement},
    Row{"dam.fracture_energy_tension", 10, 500, "Bazant & Oh 1983"},
    Row{"dam.fracture_energy_shear", 50, 20000, judgement},

    // Lift joints, lifts and seams have these for what they have no row of their own for.
    Row{"contact.friction", 0.1, 1.6, joints},
    Row{"contact.cohesion", 1, 3000, bond, true},
    Row{"contact.max_slip", 0.1, 20, judgement},
    Row{"contact.residual_friction", 0.1, 1.2, joints},
    Row{"contact.residual_slip", 1e-4, 0.5, judgement, true},
    Row{"contact.friction_table", 0.1, 1.6, joints},
    Row{"contact.tangential_stiffness", 1e8, 1e13, "Bandis et al. 1983"},
    Row{"contact.slip_tolerance", 1e-4, 0.05, "Goldgruber 2015"},
    Row{"contact.pressure_at_zero_clearance", 1, 1e5, judgement},
    Row{"contact.clearance_at_zero_pressure", 1e-5, 0.01, judgement},
    Row{"contact.tensile_strength", 0, 3000, bond, true},
    Row{"contact.fracture_energy_tension", 10, 500, "Bazant & Oh 1983"},
    Row{"contact.fracture_energy_shear", 50, 20000, judgement},
    Row{"contact.dynamic_increase", 1, 1.5, "Raphael 1984"},
    Row{"contact.kinetic_friction_ratio", 0.5, 1.1, judgement},
    Row{"contact.characteristic_rate", 1e-4, 1, judgement},
    Row{"contact.relaxation_time", 1e-3, 1, judgement},
    Row{"contact.relaxation_slip", 1e-5, 0.1, judgement},
    Row{"contact.restitution", 0, 0.8, judgement},
    Row{"lift_joint.elevation", -300, 300, "ICOLD register"},
    Row{"lift_joint.cohesion", 1, 4000, bond, true},
    Row{"lift_joint.tensile_strength", 0, 4000, bond, true},

    Row{"lifts.spacing", 0.3, 30, judgement},
    Row{"lifts.elevations", -300, 300, "ICOLD register"},
    Row{"lifts.from", -300, 300, "ICOLD register"},
    Row{"lifts.to", -300, 300, "ICOLD register"},
    Row{"lifts.cohesion", 1, 4000, bond, true},
    Row{"lifts.tensile_strength", 0, 4000, bond, true},
    Row{"lifts.drains_distance", 0.5, 30, judgement},
    Row{"lifts.drains_efficiency", 0, 0.75, "EM 1110-2-2200"},
    Row{"lifts.gallery_level", -30, 300, judgement},
    Row{"lifts.uplift_share", 0.5, 1, bond},
    Row{"lifts.crest_amplification", 1, 8, "Fenves & Chopra 1984"},
    Row{"lifts.exponent", 0.5, 3, judgement},
    Row{"lifts.amplification_points", 0.5, 8, "Fenves & Chopra 1984"},
    Row{"seam.depth", 0.2, 100, judgement},
    Row{"seam.dip", -30, 30, judgement},
    Row{"seam.cohesion", 1, 3000, rock_weight, true},
    Row{"seam.uplift_points", 0, 1, "EM 1110-2-2200"},
    Row{"seam.dilation", 0, 20, "Barton & Choubey 1977"},
    Row{"seam.dilation_slip", 0.001, 0.5, judgement},
    Row{"seam.wedge.angle", 5, 60, judgement},
    Row{"seam.wedge.angles", 5, 60, judgement},
    Row{"seam.wedge.search", 5, 70, judgement},
    Row{"seam.wedge.distance", 0, 100, judgement},
    Row{"seam.wedge.friction", 0.1, 1.6, joints},
    Row{"seam.wedge.cohesion", 1, 3000, rock_weight, true},
    Row{"seam.wedge.dilation", 0, 20, "Barton & Choubey 1977"},
    Row{"seam.interface.friction", 0, 1.6, joints},
    Row{"seam.interface.cohesion", 0, 3000, rock_weight},

    Row{"anchor.inclination", -60, 60, judgement},
    Row{"anchor.free_length", 0.2, 150, judgement},
    Row{"anchor.area", 1e-5, 0.1, judgement},
    Row{"anchor.young_modulus", 180, 215, judgement},
    Row{"anchor.yield_strength", 200, 2000, judgement},
    Row{"anchor.rupture_strain", 0.01, 0.3, judgement},
    Row{"anchor.prestress", 10, 20000, judgement, true},

    Row{"uplift.curtain_ratio", 0.2, 1, "USBR 1976"},
    Row{"uplift.points", 0, 1, "EM 1110-2-2200"},
    Row{"uplift.mouth_speed", 0.1, 50, judgement},
    Row{"uplift.joint_clearance", 2e-5, 0.01, judgement},
    Row{"uplift.water_viscosity", 8e-4, 2e-3, "CRC Handbook"},
    Row{"uplift.cavitation_pressure", -101, -90, judgement},
    Row{"curtain.distance", 0, 60, judgement},
    Row{"curtain.depth", 2, 200, "USBR 1976"},
    Row{"curtain.thickness", 0.3, 10, judgement},
    Row{"curtain.young_modulus", 0.5, 100, "Hoek & Diederichs 2006"},
    Row{"curtain.poisson_ratio", 0.05, 0.45, "Gercek 2007"},
    Row{"curtain.permeability", 1e-12, 1e-5, "Freeze & Cherry 1979"},
    Row{"drains.distance", 0.5, 60, judgement},
    Row{"drains.efficiency", 0, 0.75, "EM 1110-2-2200"},
    Row{"drains.depth", 2, 100, "USBR 1976"},
    Row{"drains.gallery_level", -30, 100, judgement},
    Row{"drains.lost_at_slip", 0.001, 0.5, judgement},
    Row{"foundation.young_modulus", 0.5, 100, "Hoek & Diederichs 2006"},
    Row{"foundation.poisson_ratio", 0.05, 0.45, "Gercek 2007"},
    Row{"foundation.density", 1900, 3100, rock_weight, true},
    Row{"foundation.width", 5, 5000, judgement},
    Row{"foundation.depth", 2, 2000, judgement},
    Row{"foundation.wave_box", 1, 3, judgement},
    Row{"foundation.wave_frequency", 5, 100, judgement},
    Row{"foundation.k0", 0.2, 3.5, "Brown & Hoek 1978"},
    Row{"foundation.permeability", 1e-12, 1e-2, "Freeze & Cherry 1979"},

    Row{"reservoir.level", 0.5, 300, "ICOLD register", true},
    Row{"reservoir.density", 990, 1100, "CRC Handbook"}, // fresh, salt, laden with silt
    Row{"reservoir.bulk_modulus", 1900, 2500, "CRC Handbook"},
    Row{"reservoir.length", 1, 3000, judgement},
    Row{"reservoir.bottom_reflection", 0, 1, "Fenves & Chopra 1984"},
    Row{"reservoir.bottom_density", 1200, 3100, rock_weight},
    Row{"reservoir.bottom_modulus", 0.01, 100, "Hoek & Diederichs 2006"},
    Row{"reservoir.mesh_size", 0.01, 20, judgement},
    Row{"gate.top", 0.5, 330, "ICOLD register"}, // above the highest crest, as combination.reservoir_level
    Row{"added_mass.period", 0.02, 5, judgement},
    Row{"added_mass.zangar_table", 0, 1, "Zangar 1952"},
    Row{"tailwater.level", 0, 150, judgement},
    Row{"silt.level", 0.1, 150, judgement},
    Row{"silt.submerged_unit_weight", 3, 12, "USBR 1976"},
    Row{"silt.pressure_coefficient", 0.2, 1, judgement},
    Row{"ice.force", 0, 300, "USBR 1976"},
    Row{"ice.level", 0, 300, "ICOLD register"},
    Row{"force.force_x", -1e5, 1e5, judgement},
    Row{"force.force_y", -1e5, 1e5, judgement},

    Row{"motion.scale", 0.01, 20, judgement},
    Row{"motion.scale_to_pga", 0.05, 20, judgement}, // the strongest recorded: some 2 to 3 g
    Row{"motion.record.dt", 0.001, 0.05, judgement},
    Row{"motion.record.magnitude", 4, 9.5, judgement}, // the largest recorded: Chile 1960
    Row{"motion.record.scale", 0.01, 20, judgement},
    Row{"regressions.period", 0, 2, judgement},
    Row{"flexible_block.period", 0.02, 2, judgement},
    Row{"flexible_block.damping", 0.01, 0.2, judgement},
    Row{"flexible_block.height", 3, 300, judgement},
    Row{"flexible_block.shear_velocity", 100, 3000, judgement},
    Row{"flexible_block.base_velocity", 200, 4000, judgement},
    Row{"flexible_block.reference_strain", 0.005, 1, judgement},
    Row{"flexible_block.mass_ratio", 0.2, 0.95, judgement},
    Row{"flexible_block.shape_exponent", 0.5, 4, judgement},
    Row{"flexible_block.modal_load", 1e3, 1e9, judgement},
    Row{"flexible_block.modal_mass", 1e3, 1e9, judgement},
    Row{"criteria.allowable_slip", 0.001, 1, judgement, true},

    Row{"combination.reservoir_level", 0.5, 330, "ICOLD register", true},
    Row{"combination.tailwater_level", 0, 150, judgement},
    Row{"combination.friction", 0.1, 1.6, joints},
    Row{"combination.cohesion", 1, 3000, bond, true},
    Row{"combination.k_h", -1, 1, judgement},
    Row{"combination.k_v", -0.7, 0.7, judgement},
    Row{"combination.pga_fraction", 0.3, 1, judgement},
    Row{"combination.pga_v_fraction", 0, 1, judgement},
    Row{"criteria.pga_fraction", 0.3, 1, judgement},
    Row{"criteria.pga_v_fraction", 0, 1, judgement},
    Row{"combination.weight_factor", 0.5, 2, judgement},
    Row{"combination.k_profile", 0, 5, judgement},
    Row{"combination.friction_divisor", 1, 3, judgement},
    Row{"combination.cohesion_divisor", 1, 6, judgement},
    Row{"combination.water_factor", 0.5, 2, judgement, true},
    Row{"combination.uplift_factor", 0.5, 2, judgement, true},
    Row{"combination.silt_factor", 0.5, 2, judgement, true},
    Row{"combination.ice_factor", 0.5, 2, judgement, true},
    Row{"combination.required_sliding_factor", 1, 4, safety},
    Row{"combination.required_residual_factor", 1, 3, safety},
    Row{"combination.required_flotation_factor", 1, 2, safety},
    Row{"combination.required_overturning_factor", 1, 3, judgement},

    Row{"mesh.size", 0.02, 20, judgement},
    Row{"mesh.contact_size", 0.01, 20, judgement},
    Row{"mesh.rock_contact_size", 0.01, 20, judgement},
    Row{"mesh.rock_size", 0.05, 200, judgement},
    Row{"mesh.growth", 1, 1.6, judgement},
    Row{"mesh.file_unit", 0.001, 1, judgement},
    Row{"damping.ratio", 0.01, 0.15, "EM 1110-2-6051", true},
    Row{"damping.mass_coefficient", 0, 20, judgement},
    Row{"damping.stiffness_coefficient", 0, 0.02, judgement},
    Row{"time.dt", 1e-5, 0.05, judgement},
    Row{"time.slip_tolerance", 1e-4, 0.1, judgement},
    Row{"sliding.steady_rate_change", 0.02, 0.3, judgement},
};

constexpr std::array none{
    NoUsualRange{"section.polygon", "its height and its base are looked at as section.height and section.base"},
    NoUsualRange{"wedge.face_dip_direction", "an azimuth"},
    NoUsualRange{"wedge.upper_dip_direction", "an azimuth"},
    NoUsualRange{"wedge.motion_azimuth", "an azimuth"},
    NoUsualRange{"wedge.plane.dip_direction", "an azimuth"},
    NoUsualRange{"wedge.force.trend", "an azimuth"},
    NoUsualRange{"wedge.force.plunge", "a direction"},
    NoUsualRange{"force.x", "a place"},
    NoUsualRange{"force.y", "a place"},
    NoUsualRange{"anchor.distance", "a place"},
    NoUsualRange{"seam.points", "a place"},
    NoUsualRange{"seam.interface.angle", "a direction"},
    NoUsualRange{"foundation.ground", "a place"},
    NoUsualRange{"motion.sequence_pause", "a limit of the computation"},
    NoUsualRange{"sliding.run_out_max", "a limit of the computation"},
    NoUsualRange{"sliding.restitution", "as good anywhere in its range"},
    NoUsualRange{"regressions.weight.weight", "relative to other weights"},
    NoUsualRange{"time.alpha", "a parameter of the scheme, as good anywhere in its range"},
    NoUsualRange{"time.gamma", "a parameter of the scheme, as good anywhere in its range"},
    NoUsualRange{"time.beta", "a parameter of the scheme, as good anywhere in its range"},
};

constexpr std::array sources{
    UsualSource{"ACI 207.1R", "ACI Committee 207: Guide to mass concrete, ACI 207.1R-05; the values USACE EM 1110-2-2200, 3-1, refers to. Rock and masonry added by judgement"},
    UsualSource{"Bandis et al. 1983", "S.C. Bandis, A.C. Lumsden, N.R. Barton: Fundamentals of rock joint deformation, Int. J. Rock Mech. Min. Sci. 20"},
    UsualSource{"Barton & Choubey 1977", "N. Barton, V. Choubey: The shear strength of rock joints in theory and practice, Rock Mechanics 10"},
    UsualSource{"Bazant & Oh 1983", "Z.P. Bazant, B.H. Oh: Crack band theory for fracture of concrete, Materials and Structures 16; dam concrete added by judgement"},
    UsualSource{"Brown & Hoek 1978", "E.T. Brown, E. Hoek: Trends in relationships between measured in-situ stresses and depth, Int. J. Rock Mech. Min. Sci. 15; young ground below 0.5 added by judgement"},
    UsualSource{"CRC Handbook", "CRC Handbook of Chemistry and Physics: fresh and sea water; water with silt added by judgement"},
    UsualSource{"EM 1110-2-2100", "USACE (2005): Stability analysis of concrete structures"},
    UsualSource{"EM 1110-2-2200", "USACE (1995): Gravity dam design"},
    UsualSource{"EM 1110-2-6051", "USACE (2003): Time-history dynamic analysis of concrete hydraulic structures"},
    UsualSource{"EPRI 1992", "EPRI TR-100345: Uplift pressures, shear strengths, and tensile strengths for stability analysis of concrete gravity dams"},
    UsualSource{"Fenves & Chopra 1984", "G. Fenves, A.K. Chopra: EAGD-84, a computer program for earthquake analysis of concrete gravity dams, UCB/EERC-84/11"},
    UsualSource{"Freeze & Cherry 1979", "R.A. Freeze, J.A. Cherry: Groundwater, table 2.2: fractured rock to karst"},
    UsualSource{"Gercek 2007", "H. Gercek: Poisson's ratio values for rocks, Int. J. Rock Mech. Min. Sci. 44"},
    UsualSource{"Goldgruber 2015", "M. Goldgruber: Nonlinear seismic modelling of concrete dams, Graz University of Technology"},
    UsualSource{"Hoek & Bray 1981", "E. Hoek, J.W. Bray: Rock slope engineering, 3rd edition"},
    UsualSource{"Hoek & Diederichs 2006", "E. Hoek, M.S. Diederichs: Empirical estimation of rock mass modulus, Int. J. Rock Mech. Min. Sci. 43"},
    UsualSource{"ICOLD register", "ICOLD: World register of dams"},
    UsualSource{"Raphael 1984", "J.M. Raphael: Tensile strength of concrete, ACI Journal 81: 0.32 f_c^(2/3) [MPa]; wider by judgement"},
    UsualSource{"Skempton 1985", "A.W. Skempton: Residual strength of clays in landslides, folded strata and the laboratory, Géotechnique 35"},
    UsualSource{"USBR 1976", "USBR: Design of gravity dams"},
    UsualSource{"WGS 84", "normal gravity from the equator to the poles, up to 5 km above the sea"},
    UsualSource{"Zangar 1952", "C.N. Zangar: Hydrodynamic pressures on dams due to horizontal earthquake effects, USBR Engineering Monograph 11"},
    UsualSource{"judgement", "engineering judgement, no source"},
};
// clang-format on

} // namespace

void add_usual_ranges(std::vector<KeyGroup>& groups)
{
    static const std::map<std::string_view, const Row*> by_key = [] {
        std::map<std::string_view, const Row*> found;
        for (const Row& row : rows) found[row.key] = &row;
        return found;
    }();
    for (KeyGroup& group : groups)
        for (Key& key : group.keys) {
            auto row = by_key.find(group.name + "." + key.name);
            const bool joint = group.name == "lift_joint" || group.name == "lifts" || group.name == "seam";
            if (row == by_key.end() && joint) row = by_key.find("contact." + key.name);
            if (row == by_key.end()) continue;
            const Row& r = *row->second;
            key.usual = Usual{r.low, r.high, r.source, r.or_zero};
        }
}

std::span<const NoUsualRange> no_usual_range()
{
    return none;
}

std::span<const UsualSource> usual_sources()
{
    return sources;
}

} // namespace damslip
