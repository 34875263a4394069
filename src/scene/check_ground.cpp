#include "core/text.hpp"
#include "core/units.hpp"
#include "scene/check.hpp"
#include "scene/rock_mass.hpp"
#include "scene/rock_wedge.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <tuple>

namespace damslip::checks {

namespace {

const char* written(TimeScheme scheme)
{
    constexpr std::array words{"auto", "hht", "newmark", "central-difference",
                               "modal"}; // in the order of the enumeration
    return words[static_cast<std::size_t>(scheme)];
}

/// Neither takes dashpots nor rock that lets waves out, nor an earthquake that goes on from another.
bool is_modal_or_explicit(TimeScheme scheme)
{
    return scheme == TimeScheme::modal || scheme == TimeScheme::central_difference;
}

void check_radiating_rock(const Scene& s, Findings& f)
{
    if (is_modal_or_explicit(s.time.scheme))
        f.wrong("foundation.boundary",
                fmt::format("foundation.boundary = \"absorbing\" with time.scheme = \"{}\".", written(s.time.scheme)),
                "hht, newmark or auto: rock that lets waves out has no real modes and no stable explicit step",
                "write  scheme = \"hht\"  in [time], or  mass = \"massless\"  in [foundation]");
}

/// A floor that is the rock takes the place of everything else that is said of it.
void check_floor(const Scene& s, Findings& f)
{
    if (!s.reservoir || s.reservoir->floor != ReservoirFloor::rock) return;
    constexpr const char *key = "reservoir.floor", *instead = "floor = \"absorbing\"";
    const auto wrong = [&](const std::string& with, const char* expected, const std::string& fix) {
        f.wrong(key, fmt::format("reservoir.floor = \"rock\" {}.", with), expected,
                fmt::format("{}, or write  {}  in [reservoir]", fix, instead));
    };
    if (s.reservoir->model != ReservoirModel::acoustic)
        wrong("without reservoir.model = \"acoustic\"", "acoustic water: an added mass has no pressure on the floor",
              "write  model = \"acoustic\"");
    if (!rock_radiates(s))
        wrong(!s.foundation       ? "without [foundation]"
              : !rock_has_mass(s) ? "with foundation.mass = \"massless\""
                                  : "with a foundation.boundary that is not \"absorbing\"",
              "radiating rock: a floor that keeps its waves would send them back into the water",
              s.foundation ? "write  mass = \"with-mass\"  and  boundary = \"absorbing\"  in [foundation]"
                           : "add  [foundation]");
    for (const char* given : {"reservoir.bottom_reflection", "reservoir.bottom_density", "reservoir.bottom_modulus"})
        if (f.given(given)) {
            wrong(fmt::format("with {}", given),
                  "one description of the floor: waves would leave twice, into the rock and by the coefficient",
                  fmt::format("delete {}", std::string(given).substr(std::string("reservoir.").size())));
            break;
        }
    if (s.reservoir->bottom_motion == BottomMotion::still)
        wrong("with reservoir.bottom_motion = \"still\"", "a floor that moves with the rock",
              "write  bottom_motion = \"ground\"");
    const double base = std::abs(toe(s.section).x - heel(s.section).x);
    if (constexpr double most = 10.0; s.reservoir->length > most * base)
        wrong(fmt::format("with a reservoir of {:.4g} m", s.reservoir->length),
              "at most ten lengths of the base: the rock below all of it is a box of waves",
              fmt::format("write  length_m = {:.4g}  and  far_end = \"absorbing\"", s.reservoir->level));
    if (s.reservoir->far_end == FarEnd::open)
        wrong("with reservoir.far_end = \"open\"", "far_end = \"absorbing\", \"damper\" or \"closed\"",
              "write  far_end = \"absorbing\"");
    if (s.contact.sliding == JointPath::finite)
        wrong("with contact.sliding = \"finite\"", "contact.sliding = \"small\": the dam stays where the floor ends",
              "write  sliding = \"small\"  in [contact]");
}

} // namespace

void check_rock(const Scene& s, Findings& f)
{
    check_floor(s, f);
    if (!s.foundation) return;
    if (!rock_has_mass(s)) {
        if (s.foundation->boundary ==
            RockBoundary::viscous) // absorbing is the default, which massless rock leaves aside
            f.wrong("foundation.boundary",
                    "foundation.boundary = \"viscous\" with foundation.mass = \"massless\": no waves travel there.",
                    "mass = \"with-mass\" for viscous edges, no boundary for massless rock",
                    "write  mass = \"with-mass\"  in [foundation], or delete boundary");
        return;
    }
    if (rock_radiates(s)) {
        check_radiating_rock(s, f);
        if (f.given("foundation.density") && !(s.foundation->material.density > 0.0))
            f.wrong("foundation.density", "foundation.density_kg_m3 = 0 with foundation.mass = \"with-mass\".",
                    "the density of the rock: 2500 ... 2900 kg/m3 is usual; left out it is 2650 where rock radiates",
                    "delete density_kg_m3, or write  mass = \"massless\"  for rock without inertia");
        return;
    }
    if (!(s.foundation->material.density > 0.0))
        f.wrong("foundation.mass", "foundation.mass = \"with-mass\" with foundation.density_kg_m3 = 0.",
                "the density of the rock: 2500 ... 2900 kg/m3 is usual",
                "write  density_kg_m3 = 2650  in [foundation], or  mass = \"massless\"  for rock without inertia");
    if (s.contact.sliding == JointPath::finite)
        f.wrong("foundation.mass", "foundation.mass = \"with-mass\" with contact.sliding = \"finite\".",
                "contact.sliding = \"small\": the rock's nodes stay opposite the dam's",
                "write  sliding = \"small\"  in [contact], or  mass = \"massless\"  in [foundation]");
    if (s.mesh.rock_contact_size)
        f.wrong("foundation.mass", "foundation.mass = \"with-mass\" with mesh.rock_contact_size_m.",
                "facing nodes on both sides of the base",
                "delete mesh.rock_contact_size_m, or write  mass = \"massless\"  in [foundation]");
    if (s.mesh.file)
        f.wrong("foundation.mass",
                fmt::format("foundation.mass = \"with-mass\" with mesh.file = \"{}\".", s.mesh.file->string()),
                "the program's own mesh of the rock box, whose sides are upright and whose nodes face the dam's",
                "delete mesh.file, or write  mass = \"massless\"  in [foundation]");
    if (rock_edges_are_viscous(s) && is_modal_or_explicit(s.time.scheme))
        f.wrong("foundation.boundary",
                fmt::format("foundation.boundary = \"viscous\" with time.scheme = \"{}\".", written(s.time.scheme)),
                "hht, newmark or auto: dashpots have no real modes and are no Rayleigh damping",
                "write  scheme = \"hht\"  in [time], or  boundary = \"fixed\"  in [foundation]");
    if (rock_edges_are_viscous(s) && base_inclination(s.section) != 0.0)
        f.wrong("foundation.boundary",
                fmt::format("foundation.boundary = \"viscous\" with a toe {:.4g} m {} the heel.",
                            std::abs(toe(s.section).y - heel(s.section).y),
                            base_inclination(s.section) > 0.0 ? "below" : "above"),
                "a level base: the free field is that of a half space with a level surface",
                "write  boundary = \"fixed\"  in [foundation], or level the base");
}

void check_mesh_file(const Scene& s, Findings& f, FileCheck files)
{
    if (!s.mesh.file) {
        if (f.given("mesh.file_unit"))
            f.wrong("mesh.file_unit", "mesh.file_unit_m is given without mesh.file.", "both, or neither",
                    "add  file = \"dam.msh\"  or delete file_unit_m");
        return;
    }
    const std::string file = s.mesh.file->string();
    for (const auto& [key, spelled] : {std::pair{"mesh.size", "mesh.size_m"},
                                       {"mesh.contact_size", "mesh.contact_size_m"},
                                       {"mesh.rock_contact_size", "mesh.rock_contact_size_m"},
                                       {"mesh.rock_size", "mesh.rock_size_m"},
                                       {"mesh.growth", "mesh.growth"}})
        if (f.given(key))
            f.wrong(key, fmt::format("{} is given together with mesh.file = \"{}\".", spelled, file),
                    "sizes of the program's own mesh, or an imported mesh, which has its own",
                    fmt::format("delete {} or mesh.file", spelled));
    std::error_code error;
    if (files == FileCheck::must_exist && !std::filesystem::is_regular_file(*s.mesh.file, error))
        f.wrong("mesh.file", fmt::format("mesh.file: there is no file {}.", file),
                "a Gmsh mesh, named relative to the scene file", "correct the name, or copy the file there");
}

namespace {

/// Keys that belong to another scheme than the chosen one.
void check_scheme(const Scene& s, Findings& f)
{
    const TimeScheme scheme = s.time.scheme;
    const bool hht = scheme == TimeScheme::hht || scheme == TimeScheme::automatic;
    if (!hht && f.given("time.alpha"))
        f.wrong("time.alpha",
                fmt::format("time.alpha belongs to time.scheme = \"hht\", but the scheme is \"{}\".", written(scheme)),
                scheme == TimeScheme::newmark ? "gamma and beta for newmark" : "no alpha, gamma or beta",
                "delete alpha or choose hht");
    if (scheme != TimeScheme::newmark && (f.given("time.gamma") || f.given("time.beta")))
        f.wrong(f.given("time.gamma") ? "time.gamma" : "time.beta",
                hht ? std::string(
                          "time.gamma and time.beta belong to time.scheme = \"newmark\"; hht takes them from alpha.")
                    : fmt::format("time.gamma and time.beta belong to time.scheme = \"newmark\", but the scheme is "
                                  "\"{}\".",
                                  written(scheme)),
                hht ? "alpha for hht" : "no alpha, gamma or beta", "delete them or choose newmark");
    if (s.time.stepping == Stepping::adaptive && !hht && scheme != TimeScheme::newmark)
        f.wrong("time.stepping",
                fmt::format("time.stepping = \"adaptive\" with time.scheme = \"{}\".", written(scheme)),
                "adaptive steps of the implicit schemes hht and newmark", "delete stepping or choose hht");
}

} // namespace

void check_fe(const Scene& s, Findings& f)
{
    const Damping& d = s.damping;
    if (d.first_mode < 1 || d.second_mode <= d.first_mode || d.second_mode > 100)
        f.wrong("damping.second_mode",
                fmt::format("damping.first_mode = {} and damping.second_mode = {} are not allowed.", d.first_mode,
                            d.second_mode),
                "1 <= first_mode < second_mode <= 100", "write  first_mode = 1  and  second_mode = 5");
    if (d.mass_coefficient.has_value() != d.stiffness_coefficient.has_value())
        f.wrong("damping", "damping.mass_coefficient_1_s and damping.stiffness_coefficient_s are not both given.",
                "both or neither", "add the other, 0 if it is meant to be absent");
    const auto at_least = [&](const char* key, const std::optional<double>& size, double length, double most,
                              const char* of) {
        if (!size || *size * most >= length) return;
        f.wrong(key,
                fmt::format("{} makes {:.3g} elements along the {:.4g} m of {}.",
                            value((std::string(key) + "_m").c_str(), *size), length / *size, length, of),
                fmt::format("at most {:.0f} elements there: {} m or more", most, shortest(length / most)),
                "give a larger size, or leave it out");
    };
    at_least("mesh.size", s.mesh.size, crest_level(s.section) - heel(s.section).y, 1000.0, "the dam's height");
    at_least("mesh.contact_size", s.mesh.contact_size, base_length(s.section), 2000.0, "the base");
    at_least("mesh.rock_contact_size", s.mesh.rock_contact_size, base_length(s.section), 2000.0, "the base");
    if (s.foundation) at_least("mesh.rock_size", s.mesh.rock_size, s.foundation->depth, 200.0, "the rock box's depth");
    if (s.mesh.rock_size && !s.foundation)
        f.wrong("mesh.rock_size", "mesh.rock_size_m is given without [foundation]: there is no rock.",
                "both or neither", "add [foundation] or delete rock_size_m");
    if (s.reservoir)
        at_least("reservoir.mesh_size", s.reservoir->mesh_size, s.reservoir->level, 400.0, "the water's depth");
    if (s.mesh.size && s.mesh.contact_size && *s.mesh.contact_size > *s.mesh.size)
        f.wrong("mesh.contact_size",
                fmt::format("{} is above {}.", value("mesh.contact_size_m", *s.mesh.contact_size),
                            value("mesh.size_m", *s.mesh.size)),
                "at most mesh.size_m", "exchange the two values");
    if (s.mesh.rock_contact_size && !s.foundation)
        f.wrong("mesh.rock_contact_size", "mesh.rock_contact_size_m is given without [foundation]: there is no rock.",
                "both or neither", "add [foundation] or delete rock_contact_size_m");
    if (s.mesh.rock_contact_size && *s.mesh.rock_contact_size > 0.5 * base_length(s.section))
        f.wrong("mesh.rock_contact_size",
                fmt::format("{} leaves less than two elements below the base of {} m.",
                            value("mesh.rock_contact_size_m", *s.mesh.rock_contact_size),
                            shortest(base_length(s.section))),
                "at most half the base; near contact_size_m is usual", "lessen it or leave it out");
    if (s.time.substeps && (*s.time.substeps < 0 || *s.time.substeps > 10))
        f.wrong("time.substeps", fmt::format("time.substeps = {} is not allowed.", *s.time.substeps),
                "0 ... 10: k of the steps dt / 2^k", "write  substeps = 2  for steps of dt / 4");
    if (s.time.stepping == Stepping::adaptive && f.given("time.substeps"))
        f.wrong("time.substeps", "time.substeps is given with time.stepping = \"adaptive\".",
                "substeps with stepping = \"uniform\"; the adaptive step is chosen by slip_tolerance",
                "delete substeps, or write  stepping = \"uniform\"");
    if (f.given("time.substeps") && f.given("time.slip_tolerance"))
        f.wrong("time.slip_tolerance", "time.slip_tolerance and time.substeps are both given.",
                "one of them: fixed sub-steps, or sub-steps chosen to a tolerance", "delete one");
    check_scheme(s, f);
}

void check_flexible_block(const Scene& s, Findings& f)
{
    if (!s.flexible_block) return;
    const FlexibleMass& m = *s.flexible_block;
    if (m.height.has_value() != m.shear_velocity.has_value())
        f.wrong(m.height ? "flexible_block.height" : "flexible_block.shear_velocity",
                "flexible_block.height_m and shear_velocity_m_s are not both given.", "both or neither",
                "add the other");
    if (m.height && m.shear_velocity && (m.period || m.of_modes))
        f.wrong("flexible_block.period",
                "flexible_block.period_s is given together with height_m and shear_velocity_m_s.",
                "one of them: T_s = 4 H/V_s of the column", "delete period_s");
    for (const auto& [key, given] : {std::pair{"flexible_block.base_velocity", m.base_velocity},
                                     {"flexible_block.reference_strain", m.reference_strain}})
        if (given && !m.height)
            f.wrong(key, fmt::format("{} is given without a column.", key),
                    "height_m and shear_velocity_m_s of the column", "add them, or delete this key");
    if (!m.period && !m.of_modes && !m.height && !(s.regressions.period > 0.0))
        f.wrong("flexible_block", "flexible_block.period_s is missing.",
                "a period, or regressions.period_s, or \"modes\"", "add  period_s = 0.3  to [flexible_block]");
    if (m.modal_load.has_value() != m.modal_mass.has_value())
        f.wrong(m.modal_load ? "flexible_block.modal_load" : "flexible_block.modal_mass",
                "flexible_block.modal_load_kg_m and modal_mass_kg_m are not both given.", "both or neither",
                "add the other");
    const int ways = m.mass_ratio.has_value() + m.shape_exponent.has_value() + m.modal_mass.has_value();
    const char* first = m.mass_ratio       ? "flexible_block.mass_ratio"
                        : m.shape_exponent ? "flexible_block.shape_exponent"
                                           : "flexible_block.modal_mass";
    if (ways > 1)
        f.wrong(first, "flexible_block gives the mass ratio in more than one way.",
                "one of mass_ratio, shape_exponent, modal_load_kg_m with modal_mass_kg_m", "delete the others");
    if (m.of_modes && ways > 0)
        f.wrong(first, fmt::format("{} is given together with flexible_block.period_s = \"modes\".", first),
                "the modes of the finite-element model give the mass ratio too",
                "delete it, or give the period as a number");
    if (m.of_modes && !s.dam.young_modulus)
        f.wrong("flexible_block.period", "flexible_block.period_s = \"modes\" needs dam.young_modulus_GPa.",
                "Young's modulus of the dam", "add  young_modulus_GPa = 25  to [dam]");
}

void check_motion(const Scene& s, Findings& f, FileCheck files)
{
    if (const int polarity = s.motion.polarity.value_or(1); polarity != 1 && polarity != -1)
        f.wrong("motion.polarity", fmt::format("motion.polarity = {} is not allowed.", polarity), "1 or -1",
                "write  polarity = -1  to flip the horizontal component");
    static const std::set<std::string> known{"", "g", "m/s2", "cm/s2", "gal", "mg"};
    std::set<std::string> names;
    for (std::size_t i = 0; i < s.motion.records.size(); ++i) {
        const RecordFiles& r = s.motion.records[i];
        const std::string label = fmt::format("motion.record[{}]", i + 1);
        if (!known.contains(r.unit))
            f.wrong(label + ".unit", fmt::format("{}.unit = \"{}\" is not allowed.", label, r.unit),
                    "\"g\", \"m/s2\", \"cm/s2\", \"gal\" or \"mg\"", "write  unit = \"g\"");
        if (!names.insert(r.name).second)
            f.wrong(label + ".name", fmt::format("two records are named \"{}\".", r.name), "names that differ",
                    fmt::format("give one a name of its own in [[motion.record]] number {}", i + 1));
        if (!r.vertical_column.empty() && !r.vertical)
            f.wrong(
                label + ".vertical_column",
                fmt::format("{}.vertical_column = \"{}\", but no vertical file is named.", label, r.vertical_column),
                "vertical with vertical_column",
                fmt::format("write  vertical = \"{}\"  if the horizontal file holds it",
                            r.horizontal.filename().string()));
        if (files == FileCheck::skip) continue;
        const auto exists = [&](const std::filesystem::path& p, const char* key) {
            std::error_code error;
            if (!std::filesystem::is_regular_file(p, error))
                f.wrong(label + "." + key, fmt::format("{}.{}: there is no file {}.", label, key, p.string()),
                        "an accelerogram file, named relative to the scene file",
                        "correct the name, or copy the file there");
        };
        exists(r.horizontal, "horizontal");
        if (r.vertical) exists(*r.vertical, "vertical");
    }
}

namespace {

/// A post-seismic state follows an earthquake that the scene has.
void check_follows(const Scene& s, const Combination& c, const std::string& label, Findings& f)
{
    if (c.follows.empty()) return;
    if (c.kind != CombinationKind::post_seismic)
        return f.wrong(label + ".follows",
                       fmt::format("{}.follows = \"{}\", but its kind is not \"post-seismic\".", label, c.follows),
                       "follows in combinations of kind \"post-seismic\" only",
                       "delete follows, or write  kind = \"post-seismic\"");
    std::string extremes;
    for (const Combination& other : s.combinations) {
        if (other.kind != CombinationKind::extreme) continue;
        if (other.name == c.follows) return;
        extremes += fmt::format("{}\"{}\"", extremes.empty() ? "" : ", ", other.name);
    }
    f.wrong(label + ".follows",
            fmt::format("{}.follows = \"{}\" is no combination of kind \"extreme\".", label, c.follows),
            extremes.empty() ? "the name of an extreme combination; the scene has none" : "one of " + extremes,
            "correct the name, or leave follows out: the governing one is then taken");
}

/// A seismic coefficient is a value or a share of the records' peak.
void check_coefficients(const Combination& c, const std::string& label, Findings& f)
{
    for (const auto& [value, fraction, given] : {std::tuple("k_h", "pga_fraction", c.pga_fraction.has_value()),
                                                 std::tuple("k_v", "pga_v_fraction", c.pga_v_fraction.has_value())})
        if (given && f.given(label + "." + value))
            f.wrong(label + "." + fraction,
                    fmt::format("{0}.{1} is given together with {0}.{2}.", label, fraction, value), "one of the two",
                    fmt::format("delete {} or {}", value, fraction));
}

} // namespace

void check_combinations(const Scene& s, Findings& f)
{
    std::set<std::string> names;
    for (std::size_t i = 0; i < s.combinations.size(); ++i) {
        const Combination& c = s.combinations[i];
        const std::string label = fmt::format("combination[{}]", i + 1);
        if (!names.insert(c.name).second)
            f.wrong(label + ".name", fmt::format("two combinations are named \"{}\".", c.name), "names that differ",
                    "rename one");
        if (c.ice && !s.ice)
            f.wrong(label + ".ice", label + ".ice = true, but the scene has no [ice].",
                    "an [ice] table with force_kN_m", "add [ice] or delete the line");
        if ((f.given(label + ".reservoir_level") && !s.reservoir) ||
            (f.given(label + ".tailwater_level") && !s.tailwater))
            f.wrong(label + ".reservoir_level", label + " changes a water level of a table the scene does not have.",
                    "[reservoir] for reservoir_level_m, [tailwater] for tailwater_level_m",
                    "add the table; its level_m may be 0");
        check_follows(s, c, label, f);
        check_coefficients(c, label, f);
        if (c.required_resultant && *c.required_resultant != "kern" && *c.required_resultant != "middle-half" &&
            *c.required_resultant != "base")
            f.wrong(label + ".required_resultant",
                    fmt::format("{}.required_resultant = \"{}\" is not allowed.", label, *c.required_resultant),
                    "\"kern\" (the middle third), \"middle-half\" or \"base\" (anywhere within the base)",
                    c.required_resultant->find("half") != std::string::npos
                        ? "write  required_resultant = \"middle-half\""
                        : "write  required_resultant = \"kern\"  for the middle third");
    }
}

namespace {

std::string in_quotes(const std::vector<RecordFiles>& records)
{
    std::string list;
    for (const RecordFiles& r : records) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", r.name);
    return list;
}

} // namespace

void check_sequence(const Scene& s, Findings& f)
{
    const std::vector<std::string>& names = s.motion.sequence;
    if (names.empty()) {
        if (f.given("motion.sequence_pause"))
            f.wrong("motion.sequence_pause", "motion.sequence_pause_s is given without motion.sequence.",
                    "both or neither", "add  sequence = [\"main shock\", \"aftershock\"]  , or delete the pause");
        return;
    }
    if (names.size() == 1)
        f.wrong("motion.sequence", fmt::format("motion.sequence = [\"{}\"] is one record.", names.front()),
                "two records or more, one after the other", "name the next one, or delete sequence");
    for (const std::string& name : names)
        if (std::none_of(s.motion.records.begin(), s.motion.records.end(),
                         [&](const RecordFiles& r) { return r.name == name; }))
            f.wrong("motion.sequence",
                    fmt::format("motion.sequence names \"{}\", which no [[motion.record]] is.", name),
                    s.motion.records.empty() ? "names of records; the scene has none"
                                             : "names of records: " + in_quotes(s.motion.records),
                    "correct the name, or give a record this  name");
    const auto refuse = [&](const std::string& what, const char* fix) {
        f.wrong("motion.sequence", fmt::format("motion.sequence with {}.", what),
                "a sequence for the rigid block on its base, and for finite elements in time", fix);
    };
    if (s.uplift && s.uplift->water.after == WaterAfter::full && s.contact.sliding == JointPath::finite)
        refuse("uplift.after = \"full\" and contact.sliding = \"finite\": the static state between two records is one "
               "of small "
               "sliding",
               "write  after = \"unchanged\"  in [uplift] or  sliding = \"small\"  in [contact]");
    if (s.wedge) refuse("[wedge]", "delete sequence: each record then shakes the wedge as it is");
    if (s.flexible_block) refuse("[flexible_block]", "delete [flexible_block], or sequence");
    if (is_modal_or_explicit(s.time.scheme))
        refuse(fmt::format("time.scheme = \"{}\"", written(s.time.scheme)), "write  scheme = \"hht\"  in [time]");
    if (s.sliding.scheme == SlidingScheme::slammer)
        refuse("sliding.scheme = \"slammer\"", "write  scheme = \"exact\"  in [sliding]");
}

namespace {

std::string degrees(double angle)
{
    return fmt::format("{:.5g}", angle / units::degree);
}

std::string orientation(double dip, double direction)
{
    return degrees(dip) + "/" + degrees(direction);
}

void check_surfaces(const RockWedge& w, Findings& f)
{
    const bool surfaces = w.face_dip || w.face_dip_direction || w.upper_dip || w.upper_dip_direction;
    const char* both = "height_m with face_dip_deg and face_dip_direction_deg, or volume_m3 with the planes' area_m2";
    if (w.volume && (w.height || surfaces))
        f.wrong("wedge.volume", value("wedge.volume_m3", *w.volume) + " is given together with height or surfaces.",
                both, "delete one of the two descriptions");
    if (!w.volume && !w.height)
        f.wrong("wedge", "wedge.height_m is missing.", both, "add  height_m = 40  or  volume_m3 = 6700  to [wedge]");
    if (w.height && !w.volume && (!w.face_dip || !w.face_dip_direction))
        f.wrong("wedge", fmt::format("wedge.{} is missing.", w.face_dip ? "face_dip_direction_deg" : "face_dip_deg"),
                both, w.face_dip ? "add  face_dip_direction_deg = 185" : "add  face_dip_deg = 65");
    if (w.upper_dip && *w.upper_dip > 0.0 && !w.upper_dip_direction && !w.face_dip_direction)
        f.wrong("wedge.upper_dip", "wedge.upper_dip_deg is given without upper_dip_direction_deg.", "both",
                "add  upper_dip_direction_deg = 195");
    if (w.water == WedgeWater::full && !w.height)
        f.wrong("wedge.water", "wedge.water = \"full\" is given without wedge.height_m.",
                "height_m, which the pressure γ_w H/6 follows from", "give water_pressure_kPa of each [[wedge.plane]]");
}

void check_planes(const RockWedge& w, Findings& f)
{
    if (w.planes.size() != 2)
        return f.wrong("wedge", fmt::format("the wedge has {} [[wedge.plane]].", w.planes.size()), "two",
                       w.planes.size() < 2 ? "add [[wedge.plane]] with dip_deg, dip_direction_deg and friction_deg"
                                           : "delete what is not one of the two planes");
    for (std::size_t i = 0; i < 2; ++i) {
        const RockPlane& p = w.planes[i];
        const std::string label = fmt::format("wedge.plane[{}]", i + 1);
        if (w.height && p.area)
            f.wrong(label + ".area",
                    value((label + ".area_m2").c_str(), *p.area) + " is given together with wedge.height_m.",
                    "areas follow from the shape", "delete area_m2");
        if (w.volume && !p.area)
            f.wrong(label, label + ".area_m2 is missing.", "the area of each plane beside wedge.volume_m3",
                    "add  area_m2 = 885");
        if (w.water == WedgeWater::full && p.water_pressure)
            f.wrong(label + ".water_pressure",
                    value((label + ".water_pressure_kPa").c_str(), *p.water_pressure / units::kPa) +
                        " is given together with wedge.water = \"full\".",
                    "one of the two", "delete wedge.water, or water_pressure_kPa");
    }
    if (w.planes[0].name == w.planes[1].name)
        f.wrong("wedge.plane[2].name", fmt::format("two planes are named \"{}\".", w.planes[0].name),
                "names that differ", "rename one");
    const RockPlane &a = w.planes[0], &b = w.planes[1];
    const Vector3 line = cross(plane_normal(a.dip, a.dip_direction), plane_normal(b.dip, b.dip_direction));
    if (!(norm(line) > 1e-6))
        f.wrong("wedge.plane[2]",
                fmt::format("the planes {} and {} (dip/dip direction) are parallel.",
                            orientation(a.dip, a.dip_direction), orientation(b.dip, b.dip_direction)),
                "two planes that meet in a line", "for one plane alone describe a rock slope in [section]");
}

void check_shape(const RockWedge& w, Findings& f)
{
    if (wedge_shape(w)) return;
    const RockPlane &a = w.planes[0], &b = w.planes[1];
    const Vector3 cut = cross(plane_normal(a.dip, a.dip_direction), plane_normal(b.dip, b.dip_direction));
    const Vector3 line = unit(cut[2] > 0.0 ? Vector3{-cut[0], -cut[1], -cut[2]} : cut);
    f.wrong("wedge.height",
            fmt::format("the planes {} and {}, the face {} and the upper ground {} bound no wedge: the line of "
                        "intersection plunges {} degrees towards {}.",
                        orientation(a.dip, a.dip_direction), orientation(b.dip, b.dip_direction),
                        orientation(*w.face_dip, *w.face_dip_direction),
                        orientation(w.upper_dip.value_or(0.0), w.upper_dip_direction.value_or(*w.face_dip_direction)),
                        degrees(plunge(line)), degrees(trend(line))),
            "a line of intersection that comes out in the face: it plunges less than the face and more than the upper "
            "ground dip in that direction, and the planes rise to both sides of it",
            "check dips and dip directions (azimuths clockwise from north)");
}

} // namespace

void check_wedge(const Scene& s, Findings& f)
{
    check_surfaces(*s.wedge, f);
    check_planes(*s.wedge, f);
    if (!f.any() && s.wedge->height) check_shape(*s.wedge, f);
}

} // namespace damslip::checks
