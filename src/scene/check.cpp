#include "scene/check.hpp"

#include "core/number.hpp"
#include "core/units.hpp"
#include "scene/rock_slope.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace damslip {

namespace {

double cross(Point o, Point a, Point b)
{
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

bool between(Point a, Point b, Point p)
{
    return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
           p.y <= std::max(a.y, b.y);
}

/// Closed segments ab and cd have a point in common.
bool touch(Point a, Point b, Point c, Point d)
{
    const double d1 = cross(a, b, c), d2 = cross(a, b, d), d3 = cross(c, d, a), d4 = cross(c, d, b);
    if (((d1 > 0) != (d2 > 0)) && ((d3 > 0) != (d4 > 0)) && d1 != 0 && d2 != 0 && d3 != 0 && d4 != 0) return true;
    return (d1 == 0 && between(a, b, c)) || (d2 == 0 && between(a, b, d)) || (d3 == 0 && between(c, d, a)) ||
           (d4 == 0 && between(c, d, b));
}

std::string point_text(Point p)
{
    return fmt::format("({}, {})", shortest(p.x), shortest(p.y));
}

void check_polygon(const Polyline& p, Findings& findings)
{
    const auto wrong = [&](std::string problem, std::string fix) {
        findings.wrong("section.polygon", "section.polygon_m " + std::move(problem),
                       "a simple polygon, counter-clockwise, from the heel at (0, 0) along the base to the toe",
                       std::move(fix));
    };
    const std::size_t n = p.size();
    if (n < 3) return wrong(fmt::format("has {} vertices.", n), "give at least three");
    if (n > 400) return wrong(fmt::format("has {} vertices.", n), "a section needs far fewer; at most 400");
    if (p[0] != Point{0, 0})
        return wrong("starts at " + point_text(p[0]) + ".", "shift it so that the heel, given first, is (0, 0)");
    for (const Point& q : p)
        if (std::abs(q.x) > 1e5 || std::abs(q.y) > 1e5)
            return wrong("has the vertex " + point_text(q) + ".", "coordinates are metres; at most 100 km");
    for (std::size_t i = 0; i < n; ++i)
        if (p[i] == p[(i + 1) % n])
            return wrong("repeats the vertex " + point_text(p[i]) + ".", "delete one; the polygon closes by itself");
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j == n - 1) continue;
            if (touch(p[i], p[i + 1], p[j], p[(j + 1) % n]))
                return wrong(fmt::format("crosses itself: edge {}-{} meets edge {}-{}.", point_text(p[i]),
                                         point_text(p[i + 1]), point_text(p[j]), point_text(p[(j + 1) % n])),
                             "put the vertices in order along the outline");
        }
    const double signed_area = area({p});
    if (!(signed_area != 0)) return wrong("has no area.", "give the outline of the section");
    if (signed_area < 0)
        return wrong("runs clockwise.", "reverse the order after the heel: (0, 0), toe, ..., crest, back to the heel");
    if (!(p[1].x > 0) || std::abs(p[1].y) > p[1].x)
        return wrong("has the toe " + point_text(p[1]) + ".",
                     "the second vertex is the toe, downstream (x > 0); the base dips less than 45 degrees");
    if (crest_level({p}) <= 0) return wrong("has no vertex above the heel.", "y is up; the base is the first edge");
    for (std::size_t i = 2; i < n; ++i)
        if (cross(p[0], p[1], p[i]) <= 0)
            return wrong("has the vertex " + point_text(p[i]) + " on or below the base.",
                         "the base is the edge from heel to toe; all other vertices lie above its line");
}

Polyline polygon_by_dimensions(const SectionInput& in, Findings& findings)
{
    const auto need = [&](const std::optional<double>& value, const char* key, const char* example) {
        if (!value)
            findings.wrong("section", fmt::format("section.{} is missing.", key),
                           "polygon_m, or height_m, base_m and crest_m",
                           fmt::format("add  {} = {}  or a polygon_m to [section]", key, example));
        return value.has_value();
    };
    const bool has_height = need(in.height, "height_m", "62.5"), has_base = need(in.base, "base_m", "45");
    if (!has_height || !has_base) return {};
    const double h = *in.height, b = *in.base, crest = in.crest.value_or(0), neck = in.neck.value_or(0);
    const double batter_height = std::min(in.upstream_slope_height.value_or(h), h);
    const double crest_from = in.upstream_slope.value_or(0) * batter_height; // x of the crest's upstream end
    const double crest_to = crest_from + crest;
    const auto wrong = [&](const char* key, std::string problem, std::string fix) {
        findings.wrong(std::string("section.") + key, std::move(problem), "dimensions that make a section",
                       std::move(fix));
    };
    if (neck >= h)
        wrong("neck",
              fmt::format("section.neck_m = {} is not below section.height_m = {}.", shortest(neck), shortest(h)),
              "neck_m is the height of the vertical downstream face below the crest");
    else if (crest_to > b)
        wrong("crest",
              fmt::format("the crest ends at x = {} m, downstream of the toe at section.base_m = {}.",
                          shortest(crest_to), shortest(b)),
              "widen the base, or lessen crest_m or upstream_slope");
    const double toe_y = -b * std::tan(in.base_inclination.value_or(0));
    if (toe_y >= h - neck)
        wrong("base_inclination",
              fmt::format("section.base_inclination_deg puts the toe at y = {} m.", shortest(toe_y)),
              "the toe must lie below the downstream face");
    Polyline p{{0, 0}, {b, toe_y}};
    const auto add = [&p](Point q) {
        if (q != p.back() && q != p.front()) p.push_back(q);
    };
    add({crest_to, h - neck});
    add({crest_to, h});
    add({crest_from, h});
    if (batter_height < h) add({crest_from, batter_height});
    return p;
}

std::string value(const char* key, double x)
{
    return fmt::format("{} = {}", key, shortest(x));
}

bool any_of_rock_slope(const SectionInput& in)
{
    return in.slope_height || in.face_dip || in.plane_dip || in.crack_distance || in.upper_dip;
}

/// Empty where the slope cannot be: said in `findings`.
Polyline polygon_of_rock_slope(const SectionInput& in, Findings& findings)
{
    const auto need = [&](const std::optional<double>& value, const char* key, const char* example) {
        if (!value)
            findings.wrong("section", fmt::format("section.{} is missing.", key),
                           "slope_height_m, face_dip_deg, plane_dip_deg and crack_distance_m of a rock slope",
                           fmt::format("add  {} = {}  to [section]", key, example));
        return value.has_value();
    };
    const bool complete[] = {need(in.slope_height, "slope_height_m", "12"), need(in.face_dip, "face_dip_deg", "60"),
                             need(in.plane_dip, "plane_dip_deg", "35"),
                             need(in.crack_distance, "crack_distance_m", "4")};
    if (!(complete[0] && complete[1] && complete[2] && complete[3])) return {};
    const RockSlope slope{*in.slope_height, *in.face_dip, *in.plane_dip, *in.crack_distance, in.upper_dip.value_or(0)};
    const auto degrees = [](const char* key, double angle) { return fmt::format("{} = {:.10g}", key, angle / units::degree); };
    const auto wrong = [&](const char* key, std::string problem, const char* allowed, const char* fix) {
        findings.wrong(std::string("section.") + key, std::move(problem), allowed, fix);
        return Polyline{};
    };
    if (slope.plane_dip >= slope.face_dip)
        return wrong("plane_dip",
                     fmt::format("{} is not flatter than {}.", degrees("section.plane_dip_deg", slope.plane_dip),
                                 degrees("section.face_dip_deg", slope.face_dip)),
                     "a plane that comes out in the face: plane_dip_deg < face_dip_deg", "exchange them, if mixed up");
    if (slope.upper_dip >= slope.face_dip)
        return wrong("upper_dip",
                     fmt::format("{} is not flatter than {}.", degrees("section.upper_dip_deg", slope.upper_dip),
                                 degrees("section.face_dip_deg", slope.face_dip)),
                     "upper_dip_deg < face_dip_deg", "there is no crest otherwise");
    const double crest = slope.height / std::tan(slope.face_dip);
    if (slope.crack_distance <= -crest)
        return wrong("crack_distance",
                     fmt::format("{} puts the crack before the slope: its toe is {} m before the crest.",
                                 value("section.crack_distance_m", slope.crack_distance), shortest(crest)),
                     "a crack between the toe of the slope and the place where the plane comes up", "move the crack");
    if (crack_depth(slope) <= 1e-9 * slope.height)
        return wrong("crack_distance",
                     fmt::format("{}: the plane has come up to the surface before the crack.",
                                 value("section.crack_distance_m", slope.crack_distance)),
                     "a crack between the toe of the slope and the place where the plane comes up",
                     "move the crack towards the crest; a block without crack is a polygon_m");
    return sliding_block(slope);
}

void check_base(const Scene& s, Findings& f)
{
    const double base = base_length(s.section);
    if (s.curtain && s.curtain->distance + s.curtain->thickness > base)
        f.wrong("curtain.distance",
                fmt::format("the curtain ends outside the base: {} + {}, base length = {} m.",
                            value("curtain.distance_m", s.curtain->distance),
                            value("curtain.thickness_m", s.curtain->thickness), shortest(base)),
                "distance_m + thickness_m at most the base length", "lessen curtain.distance_m");
    if (s.curtain && s.foundation && s.curtain->depth >= s.foundation->depth)
        f.wrong("curtain.depth",
                fmt::format("{} reaches through the rock box, {}.", value("curtain.depth_m", s.curtain->depth),
                            value("foundation.depth_m", s.foundation->depth)),
                "curtain.depth_m below foundation.depth_m", "deepen the box or shorten the curtain");
    if (s.foundation && s.foundation->width < 1.2 * base)
        f.wrong("foundation.width",
                fmt::format("{} is too narrow for a base of {} m.", value("foundation.width_m", s.foundation->width),
                            shortest(base)),
                "at least 1.2 x base; 5 to 7 x base is usual", "widen the box");
    if (s.drains && s.drains->distance >= base)
        f.wrong("drains.distance",
                fmt::format("{} is not within the base of {} m.", value("drains.distance_m", s.drains->distance),
                            shortest(base)),
                "0 ... below the base length", "measure along the base from the heel");
    if (s.drains && s.drains->depth && s.foundation && *s.drains->depth >= s.foundation->depth)
        f.wrong("drains.depth",
                fmt::format("{} reaches through the rock box, {}.", value("drains.depth_m", *s.drains->depth),
                            value("foundation.depth_m", s.foundation->depth)),
                "drains.depth_m below foundation.depth_m", "deepen the box or shorten the drains");
    if (!s.uplift) return;
    const auto needs = [&](UpliftModel model, bool there, const char* word, const char* table) {
        if (s.uplift->model == model && !there)
            f.wrong("uplift.model", fmt::format("uplift.model = \"{}\" needs {}.", word, table), table,
                    fmt::format("add {} or choose another uplift.model", table));
    };
    needs(UpliftModel::curtain, s.curtain.has_value(), "curtain", "a [curtain] with its distance_m");
    needs(UpliftModel::drains, s.drains.has_value(), "drains", "a [drains] with its distance_m");
    needs(UpliftModel::points, !s.uplift->points.empty(), "points", "uplift.points_m");
    if (s.uplift->model != UpliftModel::points && !s.uplift->points.empty())
        f.wrong("uplift.points", "uplift.points_m is given, but uplift.model is not \"points\".",
                "model = \"points\" with points_m", "write  model = \"points\"  or delete points_m");
    const auto& p = s.uplift->points;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p[i].x < 0 || p[i].x > base * (1 + 1e-12) || (i && p[i].x < p[i - 1].x)) {
            f.wrong("uplift.points",
                    fmt::format("uplift.points_m has the distance {} at place {}.", shortest(p[i].x), i + 1),
                    fmt::format("distances along the base from 0 to {} m, not decreasing", shortest(base)),
                    "put the points in order from heel to toe");
            break;
        }
    if (!p.empty() && (p.front().x != 0 || std::abs(p.back().x - base) > 1e-9 * base))
        f.wrong("uplift.points",
                fmt::format("uplift.points_m covers {} to {} m.", shortest(p.front().x), shortest(p.back().x)),
                fmt::format("from 0 (heel) to {} (toe)", shortest(base)), "add the missing end");
}

/// @param table  "contact" or "lift_joint[1]"
void check_strength(const Contact& c, const std::string& table, Findings& f)
{
    const auto key = [&table](const char* name) { return table + "." + name; };
    if (c.residual_friction && *c.residual_friction > c.friction)
        f.wrong(key("residual_friction"),
                fmt::format("{} = {} is above the peak value, {} = {}.", key("residual_friction"),
                            shortest(*c.residual_friction), key("friction"), shortest(c.friction)),
                "at most " + key("friction"), "exchange the two values");
    if (!c.residual_friction && f.given(key("residual_slip")))
        f.wrong(key("residual_slip"),
                fmt::format("{} is given without {}.", key("residual_slip_m"), key("residual_friction")),
                "both or neither",
                table == "contact" ? "add  residual_friction = 0.65  to [contact]" : "add  residual_friction = 0.65");
    if (!c.friction_table.empty() && c.residual_friction)
        f.wrong(key("friction_table"),
                fmt::format("{} and {} are both given.", key("friction_table_m"), key("residual_friction")),
                "one of them", "delete one");
    for (std::size_t i = 0; i < c.friction_table.size(); ++i)
        if (c.friction_table[i].x < 0 || (i == 0 && c.friction_table[i].x != 0) ||
            (i && c.friction_table[i].x <= c.friction_table[i - 1].x)) {
            f.wrong(key("friction_table"),
                    fmt::format("{} has the slip {} at place {}.", key("friction_table_m"),
                                shortest(c.friction_table[i].x), i + 1),
                    "slips from 0, increasing", "put the pairs in order, the first at slip 0");
            break;
        }
}

/// The other end of the way a joint must keep, and what is there.
struct Neighbour {
    double level;
    std::string name;
};

void check_lift_joints(const Scene& s, Findings& f)
{
    const double low = std::max(heel(s.section).y, toe(s.section).y), high = crest_level(s.section);
    const double size = s.mesh.size.value_or((high - std::min(heel(s.section).y, toe(s.section).y)) / 40.0);
    std::vector<Neighbour> below{{low, "the base"}, {high, "the crest"}};
    std::set<std::string> names;
    for (std::size_t i = 0; i < s.lift_joints.size(); ++i) {
        const LiftJoint& joint = s.lift_joints[i];
        const std::string label = fmt::format("lift_joint[{}]", i + 1);
        check_strength(joint.strength, label, f);
        if (!names.insert(joint.name).second)
            f.wrong(label + ".name", fmt::format("two lift joints are named \"{}\".", joint.name), "names that differ",
                    "rename one");
        const std::string given = label + "." + value("elevation_m", joint.elevation);
        const std::string inside =
            fmt::format("above the base at {} m and below the crest at {} m", shortest(low), shortest(high));
        if (!(joint.elevation > low && joint.elevation < high)) {
            f.wrong(label + ".elevation", given + " is not inside the dam.", inside, "move the joint, or delete it");
            continue;
        }
        const double width = width_at_level(s.section, joint.elevation);
        if (width < size)
            f.wrong(label + ".elevation",
                    fmt::format("{}: the section is {:.4g} m wide there, less than one element of {:.4g} m.", given,
                                width, size),
                    "a joint at least one element wide", "lower the joint, or give a smaller mesh.size_m");
        for (const Neighbour& other : below)
            if (std::abs(other.level - joint.elevation) < 0.5 * size)
                f.wrong(label + ".elevation",
                        fmt::format("{} is {:.4g} m from {}: no room for an element of {:.4g} m.", given,
                                    std::abs(other.level - joint.elevation), other.name, size),
                        fmt::format("at least half an element, {:.4g} m, between base, joints and crest", 0.5 * size),
                        "move the joint, or give a smaller mesh.size_m");
        below.push_back({joint.elevation, label});
    }
    if (s.lift_joints.empty()) return;
    if (s.contact.sliding == JointPath::finite)
        f.wrong("contact.sliding", "contact.sliding = \"finite\" with a [[lift_joint]].",
                "sliding = \"small\" where the dam has lift joints",
                "write  sliding = \"small\"  or delete the [[lift_joint]]");
}

void check_normal_contact(const Contact& c, Findings& f)
{
    if (c.normal != NormalContact::exponential) {
        for (const auto& [key, unit] :
             {std::pair("pressure_at_zero_clearance", "kPa"), std::pair("clearance_at_zero_pressure", "m")})
            if (f.given(fmt::format("contact.{}", key)))
                f.wrong(fmt::format("contact.{}", key),
                        fmt::format("contact.{}_{} is given, but contact.normal is not \"exponential\".", key, unit),
                        fmt::format("normal = \"exponential\" with {}_{}", key, unit),
                        fmt::format("write  normal = \"exponential\"  or delete {}_{}", key, unit));
        return;
    }
    if (c.separation == JointOpening::none)
        f.wrong("contact.normal", "contact.normal = \"exponential\" with contact.separation = \"none\".",
                "separation = \"allowed\": the exponential pressure ends at its clearance, it cannot pull",
                "write  separation = \"allowed\"  or  normal = \"hard\"");
    if (c.enforcement == ContactEnforcement::slip_tolerance)
        f.wrong("contact.normal", "contact.normal = \"exponential\" with contact.enforcement = \"slip-tolerance\".",
                "enforcement = \"exact\" or \"penalty\" with the exponential pressure",
                "write  enforcement = \"penalty\"  with tangential_stiffness_N_m3, or  enforcement = \"exact\"");
}

void check_joint(const Scene& s, Findings& f)
{
    const Contact& c = s.contact;
    const bool penalty = c.enforcement == ContactEnforcement::penalty;
    if (penalty && !c.tangential_stiffness)
        f.wrong("contact.enforcement", "contact.enforcement = \"penalty\" without contact.tangential_stiffness_N_m3.",
                "both", "add  tangential_stiffness_N_m3 = 1e11  to [contact]");
    if (!penalty && c.tangential_stiffness)
        f.wrong("contact.tangential_stiffness",
                "contact.tangential_stiffness_N_m3 is given, but contact.enforcement is not \"penalty\".",
                "enforcement = \"penalty\" with tangential_stiffness_N_m3",
                "write  enforcement = \"penalty\"  or delete tangential_stiffness_N_m3");
    if (c.enforcement != ContactEnforcement::slip_tolerance && f.given("contact.slip_tolerance"))
        f.wrong("contact.slip_tolerance",
                "contact.slip_tolerance is given, but contact.enforcement is not \"slip-tolerance\".",
                "enforcement = \"slip-tolerance\" with slip_tolerance",
                "write  enforcement = \"slip-tolerance\"  or delete slip_tolerance");
    if (c.sliding != JointPath::finite && f.given("contact.max_slip"))
        f.wrong("contact.max_slip", "contact.max_slip_m is given, but contact.sliding is not \"finite\".",
                "sliding = \"finite\" with max_slip_m", "write  sliding = \"finite\"  or delete max_slip_m");
    check_normal_contact(c, f);
}

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
    if (water.mesh_size && *water.mesh_size > water.level / 4)
        f.wrong("reservoir.mesh_size",
                fmt::format("{} leaves fewer than four elements over the depth of {} m.",
                            value("reservoir.mesh_size_m", *water.mesh_size), shortest(water.level)),
                "at most a quarter of the depth; a tenth resolves the waves that matter",
                fmt::format("write  mesh_size_m = {}", shortest(water.level / 20)));
}

/// Goldgruber & Feldbacher's mass (3-10) is of faces within 30 degrees.
void check_face_of_added_mass(const Scene& s, Findings& f)
{
    if (s.added_mass.formula != AddedMassFormula::goldgruber || !s.reservoir ||
        s.reservoir->model == ReservoirModel::hydrostatic)
        return;
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

void check_water(const Scene& s, Findings& f)
{
    if (s.stages.pore_pressure != PorePressure::none && s.reservoir && s.reservoir->floor_pressure)
        f.wrong("stages.pore_pressure",
                "stages.pore_pressure is given together with reservoir.floor_pressure = true: the floor would be "
                "loaded twice.",
                "one of the two: the water in the rock brings the pressure on its surface with it",
                "delete floor_pressure");
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
    if (s.reservoir) check_acoustic_water(*s.reservoir, f);
    check_face_of_added_mass(s, f);
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

void check_motion(const Scene& s, Findings& f, FileCheck files)
{
    if (s.motion.polarity != 1 && s.motion.polarity != -1)
        f.wrong("motion.polarity", fmt::format("motion.polarity = {} is not allowed.", s.motion.polarity), "1 or -1",
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
        if (c.required_resultant && *c.required_resultant != "kern" && *c.required_resultant != "middle-half" &&
            *c.required_resultant != "base")
            f.wrong(label + ".required_resultant",
                    fmt::format("{}.required_resultant = \"{}\" is not allowed.", label, *c.required_resultant),
                    "\"kern\", \"middle-half\" or \"base\"", "write  required_resultant = \"base\"");
    }
}

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
    if (f.given("time.substeps") && f.given("time.slip_tolerance"))
        f.wrong("time.slip_tolerance", "time.slip_tolerance and time.substeps are both given.",
                "one of them: fixed sub-steps, or sub-steps chosen to a tolerance", "delete one");
    if (s.time.scheme == TimeScheme::newmark && f.given("time.alpha"))
        f.wrong("time.alpha", "time.alpha belongs to time.scheme = \"hht\", but the scheme is \"newmark\".",
                "gamma and beta for newmark", "delete alpha or choose hht");
    if (s.time.scheme == TimeScheme::hht && (f.given("time.gamma") || f.given("time.beta")))
        f.wrong(f.given("time.gamma") ? "time.gamma" : "time.beta",
                "time.gamma and time.beta belong to time.scheme = \"newmark\"; hht takes them from alpha.",
                "alpha for hht", "delete them or choose newmark");
}

/// Water in a tension crack presses but hardly moves; it seeps out along the plane, whose pressure falls to zero at the
/// toe (Hoek & Bray 1981).
void fill_crack_water(Scene& scene, const Findings& findings)
{
    if (!findings.given("reservoir.model")) scene.reservoir->model = ReservoirModel::hydrostatic;
    if (!scene.uplift) scene.uplift.emplace().model = UpliftModel::linear;
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

} // namespace

Section make_section(const SectionInput& in, Findings& findings)
{
    const bool dimensions = in.height || in.base || in.crest || in.neck || in.upstream_slope ||
                            in.upstream_slope_height || in.base_inclination;
    const bool slope = any_of_rock_slope(in);
    Section section{in.polygon};
    if (!in.polygon.empty() && dimensions) {
        findings.wrong("section", "section.polygon_m is given together with dimensions.",
                       "polygon_m alone, or height_m, base_m, crest_m ... alone", "delete one of the two descriptions");
        return section;
    }
    if (slope && (!in.polygon.empty() || dimensions)) {
        findings.wrong("section", "section describes a rock slope together with a polygon or dimensions.",
                       "slope_height_m, face_dip_deg, plane_dip_deg, crack_distance_m, upper_dip_deg alone",
                       "delete one of the two descriptions");
        return section;
    }
    if (in.polygon.empty()) {
        if (findings.given("section.polygon")) return section; // already reported
        section.polygon = slope ? polygon_of_rock_slope(in, findings) : polygon_by_dimensions(in, findings);
        if (section.polygon.empty()) return section;
    }
    if (!findings.any()) check_polygon(section.polygon, findings);
    return section;
}

void fill_defaults(Scene& scene, const Findings& findings)
{
    const double base = base_length(scene.section);
    if (scene.reservoir && findings.given("section.slope_height")) fill_crack_water(scene, findings);
    if (scene.reservoir) {
        if (!findings.given("reservoir.level")) scene.reservoir->level = crest_level(scene.section);
        if (!findings.given("reservoir.length")) {
            const double depths = scene.reservoir->far_end == FarEnd::absorbing ? 1.0 : 2.4;
            scene.reservoir->length = std::max(depths * scene.reservoir->level, 1e-3);
        }
    }
    if (scene.ice && !findings.given("ice.level"))
        scene.ice->level = scene.reservoir ? scene.reservoir->level : crest_level(scene.section);
    if (scene.foundation) {
        if (!findings.given("foundation.width")) scene.foundation->width = base * 20.0 / 3.0;
        if (!findings.given("foundation.depth"))
            scene.foundation->depth = std::max(base * 20.0 / 9.0, scene.curtain ? 2 * scene.curtain->depth : 0.0);
    }
    const bool water = scene.reservoir || scene.tailwater;
    if (!scene.uplift && scene.curtain && water)
        scene.uplift.emplace().model = UpliftModel::seepage;
    else if (scene.uplift && !findings.given("uplift.model"))
        scene.uplift->model = !scene.uplift->points.empty() ? UpliftModel::points
                              : scene.curtain               ? UpliftModel::seepage
                              : scene.drains                ? UpliftModel::drains
                                                            : UpliftModel::linear;
    for (PointForce& force : scene.forces)
        if (force.name.empty()) force.name = "force";
    for (std::size_t i = 0; i < scene.lift_joints.size(); ++i)
        if (scene.lift_joints[i].name.empty()) scene.lift_joints[i].name = fmt::format("lift joint {}", i + 1);
}

void check_consistency(const Scene& scene, Findings& findings, FileCheck files)
{
    check_base(scene, findings);
    check_strength(scene.contact, "contact", findings);
    check_lift_joints(scene, findings);
    check_joint(scene, findings);
    check_water(scene, findings);
    check_crack_water(scene, findings);
    check_motion(scene, findings, files);
    check_combinations(scene, findings);
    check_fe(scene, findings);
}

} // namespace damslip
