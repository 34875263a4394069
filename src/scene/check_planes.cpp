#include "core/text.hpp"
#include "core/units.hpp"
#include "scene/check.hpp"
#include "scene/joint_bond.hpp"
#include "scene/planes.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <set>

/// Lifts through the dam and seams below it: where they lie, and what they lack.
namespace damslip::checks {

namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;

std::string in_degrees(double angle)
{
    return fmt::format("{:.6g}", angle / units::degree);
}

std::string point_text(Point p)
{
    return fmt::format("({:.6g}, {:.6g})", p.x, p.y);
}

void check_lift_choices(const Scene& s, Findings& f)
{
    const Lifts& l = *s.lifts;
    const auto needs = [&f](bool wrong, const char* key, const char* problem, const char* fix) {
        if (wrong) f.wrong(std::string("lifts.") + key, problem, "the keys of [lifts] together", fix);
    };
    if (l.bonded) {
        const bool c = l.strength.cohesion > 0.0, f_t = l.strength.bond.tensile_strength > 0.0;
        if (!c || !f_t)
            f.wrong("lifts.bond",
                    fmt::format("lifts.bond = \"bonded\" with lifts.cohesion_kPa = {} and lifts.tensile_strength_kPa = {}.",
                                shortest(1e-3 * l.strength.cohesion), shortest(1e-3 * l.strength.bond.tensile_strength)),
                    "both above 0 for bonded lifts",
                    !c ? "add  cohesion_kPa = 500  to [lifts], or write  bond = \"jointed\""
                       : "add  tensile_strength_kPa = 500  to [lifts], or write  bond = \"jointed\"");
    } else {
        for (const auto& [key, x] : {std::pair("cohesion", l.strength.cohesion),
                                     std::pair("tensile_strength", l.strength.bond.tensile_strength)})
            if (x > 0.0)
                f.wrong(fmt::format("lifts.{}", key),
                        fmt::format("lifts.{}_kPa = {} with lifts.bond = \"jointed\", which has neither cohesion nor "
                                    "tensile strength.",
                                    key, shortest(1e-3 * x)),
                        "bond = \"bonded\" with cohesion_kPa and tensile_strength_kPa",
                        fmt::format("write  bond = \"bonded\"  or delete {}_kPa", key));
    }
    for (const char* key : {"softening", "dynamic_increase"})
        if (f.given(fmt::format("lifts.{}", key)) && !breaks_by_energy(l.strength))
            f.wrong(fmt::format("lifts.{}", key),
                    fmt::format("lifts.{} is given, but the lifts have no bond that breaks by energy.", key),
                    "bond = \"bonded\" with fracture_energy_tension_N_m and fracture_energy_shear_N_m",
                    fmt::format("add the fracture energies, or delete {}", key));
    const bool drained = l.uplift == LiftUplift::drains;
    needs(drained && !l.drains_distance, "uplift", "lifts.uplift = \"drains\" without lifts.drains_distance_m.",
          "add  drains_distance_m = 3  to [lifts]");
    for (const char* key : {"drains_distance", "drains_efficiency"})
        if (!drained && f.given(fmt::format("lifts.{}", key)))
            f.wrong(fmt::format("lifts.{}", key),
                    fmt::format("lifts.{} is given, but lifts.uplift is not \"drains\".", key),
                    "uplift = \"drains\" with its keys", "write  uplift = \"drains\"  in [lifts], or delete the line");
    const bool power = l.amplification == Amplification::power, points = l.amplification == Amplification::points;
    needs(power && !f.given("lifts.crest_amplification"), "amplification",
          "lifts.amplification = \"power\" without lifts.crest_amplification.",
          "add  crest_amplification = 2  to [lifts]");
    needs(points && l.points.empty(), "amplification",
          "lifts.amplification = \"points\" without lifts.amplification_points_m.",
          "add  amplification_points_m = [[0, 1], [60, 3]]  to [lifts]");
    needs(!points && !l.points.empty(), "amplification_points",
          "lifts.amplification_points_m is given, but lifts.amplification is not \"points\".",
          "write  amplification = \"points\"  or delete amplification_points_m");
    for (const char* key : {"crest_amplification", "exponent"})
        needs(!power && f.given(fmt::format("lifts.{}", key)), key,
              "a key of lifts.amplification = \"power\" is given, but the amplification is another.",
              "write  amplification = \"power\"  or delete the line");
    if (l.amplification == Amplification::modes) {
        needs(!s.dam.young_modulus, "amplification", "lifts.amplification = \"modes\" without dam.young_modulus_GPa.",
              "add  young_modulus_GPa = 25  to [dam]");
        needs(s.motion.records.empty(), "amplification", "lifts.amplification = \"modes\" without a record.",
              "add a [[motion.record]], or write  amplification = \"power\"");
        needs(!s.motion.sequence.empty(), "amplification", "lifts.amplification = \"modes\" with motion.sequence.",
              "delete motion.sequence, or write  amplification = \"power\"");
    }
    for (std::size_t i = 1; i < l.points.size(); ++i)
        if (l.points[i].x <= l.points[i - 1].x)
            return f.wrong("lifts.amplification_points",
                           fmt::format("lifts.amplification_points_m has the height {} at place {}.",
                                       shortest(l.points[i].x), i + 1),
                           "heights that increase", "put the points in order from the heel up");
}

void check_lift_places(const Scene& s, Findings& f)
{
    const Lifts& l = *s.lifts;
    if (l.spacing.has_value() == !l.elevations.empty())
        return f.wrong("lifts",
                       l.spacing ? "lifts.spacing_m and lifts.elevations_m are both given."
                                 : "[lifts] has neither spacing_m nor elevations_m.",
                       "one of the two", l.spacing ? "delete one" : "add  spacing_m = 3  to [lifts]");
    for (const auto& [key, there] : {std::pair("from", l.from.has_value()), std::pair("to", l.to.has_value())})
        if (!l.spacing && there)
            f.wrong(fmt::format("lifts.{}", key), fmt::format("lifts.{}_m is given with lifts.elevations_m.", key),
                    "from_m and to_m with spacing_m", fmt::format("delete {}_m", key));
    const double low = lowest_lift(s.section), high = crest_level(s.section);
    const std::string inside =
        fmt::format("above the base at {} m and below the crest at {} m", shortest(low), shortest(high));
    const auto outside = [&](const char* key, const std::string& given) {
        f.wrong(fmt::format("lifts.{}", key), given + " is outside the section.", inside, "move the lift, or delete it");
    };
    for (std::size_t i = 0; i < l.elevations.size(); ++i) {
        const double y = l.elevations[i];
        if (!(y > low && y < high)) outside("elevations", fmt::format("lifts.elevations_m: {} m at place {}", shortest(y), i + 1));
        if (i > 0 && y <= l.elevations[i - 1])
            f.wrong("lifts.elevations",
                    fmt::format("lifts.elevations_m has {} at place {}, not above {}.", shortest(y), i + 1,
                                shortest(l.elevations[i - 1])),
                    "elevations that increase", "put them in order from the heel up, each once");
    }
    if (!l.spacing) return;
    for (const auto& [key, end] : {std::pair("from", l.from), std::pair("to", l.to)})
        if (end && !(*end > low && *end < high)) outside(key, fmt::format("lifts.{}_m = {}", key, shortest(*end)));
    if (f.any()) return;
    const double count = (high - low) / *l.spacing;
    if (count > 1000.0)
        f.wrong("lifts.spacing", fmt::format("lifts.spacing_m = {} makes {:.0f} lifts.", shortest(*l.spacing), count),
                "at most 1000", "check the unit, or give a larger spacing");
    else if (made_lifts(l, s.section).empty())
        f.wrong("lifts.spacing",
                fmt::format("lifts.spacing_m = {} leaves no lift inside the section.", shortest(*l.spacing)), inside,
                "give a smaller spacing, or elevations_m");
}

void check_dilation(const std::string& key, double dilation, double friction, Findings& f)
{
    if (std::tan(dilation) <= friction) return;
    f.wrong(key + ".dilation",
            fmt::format("{}.dilation_deg = {} is above the friction angle, {} degrees of {}.friction = {}.", key,
                        in_degrees(dilation), in_degrees(std::atan(friction)), key, shortest(friction)),
            fmt::format("at most {} deg: a joint that rises more than it rubs would give work back",
                        in_degrees(std::atan(friction))),
            "lessen dilation_deg, or check the friction");
}

/// Path, ground and dam as checks need them.
struct SeamPlace {
    const Scene& scene;
    const Seam& seam;
    std::string label;
    Polyline path, ground;
    Findings& f;

    double toe_x() const { return toe(scene.section).x; }

    void wrong(const char* key, std::string problem, std::string expected, std::string fix) const
    {
        f.wrong(label + "." + key, std::move(problem), std::move(expected), std::move(fix));
    }
    const char* where() const { return seam.depth ? "depth" : "points"; }
};

/// No kink under the dam may cut it in two.
void check_kinks(const SeamPlace& p)
{
    const double angle = p.seam.interface.angle.value_or(right_angle);
    const auto straight = [&](std::size_t i) {
        const Point a = p.path[i - 1], k = p.path[i], b = p.path[i + 1];
        const double turn = (k.x - a.x) * (b.y - k.y) - (k.y - a.y) * (b.x - k.x);
        return std::abs(turn) <= 1e-9 * std::hypot(k.x - a.x, k.y - a.y) * std::hypot(b.x - k.x, b.y - k.y);
    };
    const std::size_t end = p.seam.exit == SeamExit::wedge ? p.path.size() : p.path.size() - 1;
    for (std::size_t i = 1; i < end; ++i) {
        const Point k = p.path[i];
        if (i + 1 < p.path.size() && straight(i)) continue;
        const double up = base_level(p.scene.section, k.x) - k.y;
        const double top = angle == right_angle ? k.x : k.x + up / std::tan(angle);
        if (top <= 1e-9 || top >= p.toe_x() * (1.0 - 1e-12)) continue;
        const double leaning = std::atan2(up, p.toe_x() - k.x);
        return p.wrong(
            p.f.given(p.label + ".interface.angle") ? "interface.angle" : p.where(),
            fmt::format("{} bends under the dam, at {}: with interface.angle_deg = {} the face up from there meets the "
                        "base {:.4g} m from the heel and cuts the dam in two.",
                        p.label, point_text(k), in_degrees(angle), top),
            fmt::format("a bend beyond the toe at {:.6g} m, or a face that leaves the dam whole: interface.angle_deg of at "
                        "most {}",
                        p.toe_x(), in_degrees(leaning)),
            fmt::format("write  angle_deg = {:.4g}  in [seam.interface], or straighten the seam under the dam",
                        std::floor(10.0 * leaning / units::degree) / 10.0));
    }
}

void check_path(const SeamPlace& p)
{
    const Seam& seam = p.seam;
    if (seam.points.empty() == !seam.depth)
        return p.f.wrong(p.label,
                         seam.depth ? fmt::format("{}.points_m and {}.depth_m are both given.", p.label, p.label)
                                    : fmt::format("{} has neither points_m nor depth_m.", p.label),
                         "one of the two", seam.depth ? "delete one" : "add  depth_m = 8");
    if (!seam.depth && seam.points.size() < 2)
        return p.wrong("points", p.label + ".points_m has one point.", "a path of two points or more", "add its end");
    for (std::size_t i = 1; i < seam.points.size(); ++i)
        if (!(seam.points[i].x > seam.points[i - 1].x))
            return p.wrong("points",
                           fmt::format("{}.points_m has x = {} at place {}, not downstream of {}.", p.label,
                                       shortest(seam.points[i].x), i + 1, shortest(seam.points[i - 1].x)),
                           "points from upstream to downstream, x increasing", "put the points in order");
    if (p.path.back().x < p.toe_x() * (1.0 - 1e-12))
        return p.wrong(p.where(),
                       fmt::format("{}.points_m ends at x = {}, under the dam.", p.label, shortest(p.path.back().x)),
                       fmt::format("a path that goes at least as far as the toe, x = {} m", shortest(p.toe_x())),
                       "extend the path downstream");
    if (seam.heel == SeamHeel::crack) {
        if (p.path.front().x != 0.0)
            return p.wrong("points",
                           fmt::format("{}.points_m starts at {}; the crack of heel = \"crack\" comes down at x = 0.",
                                       p.label, point_text(p.path.front())),
                           "a first point below the heel, x = 0, or heel = \"floor\" with one on the reservoir floor",
                           "write  heel = \"floor\"  or start the path at x = 0");
    } else if (const double floor = ground_level(p.ground, p.path.front().x);
               p.path.front().x > 0.0 || std::abs(p.path.front().y - floor) > 1e-6) {
        return p.wrong("heel",
                       fmt::format("{}.heel = \"floor\", but the seam starts at {}; the reservoir floor is at {:.6g} m there.",
                                   p.label, point_text(p.path.front()), floor),
                       "a first point on the reservoir floor, at x <= 0",
                       fmt::format("write  heel = \"crack\"  or start the path at y = {:.6g}", floor));
    }
    for (const Point& q : p.path)
        if (const double level = q.x >= 0.0 && q.x <= p.toe_x() ? base_level(p.scene.section, q.x)
                                                                : ground_level(p.ground, q.x);
            q.y > level + 1e-9) {
            const bool under = q.x >= 0.0 && q.x <= p.toe_x();
            return p.wrong(p.where(),
                           fmt::format("{} lies above the {} at {}: that is at {:.6g} m there.", p.label,
                                       under ? "base" : "ground", point_text(q), level + 0.0), // never -0
                           fmt::format("a path below the {}", under ? "base" : "ground"),
                           seam.depth ? "give a larger depth_m, or another dip_deg" : "lower the point");
        }
    check_kinks(p);
}

void check_exit(const SeamPlace& p)
{
    const Seam& seam = p.seam;
    if (seam.exit == SeamExit::wedge && !seam.wedge)
        return p.wrong("exit", p.label + ".exit = \"wedge\" without [seam.wedge].", "both",
                       "add  [seam.wedge]  with its friction, or write  exit = \"free-face\"");
    if (seam.exit != SeamExit::wedge && seam.wedge)
        return p.wrong("exit",
                       fmt::format("{}.exit = \"{}\" with [seam.wedge].", p.label,
                                   seam.exit == SeamExit::daylight ? "daylight" : "free-face"),
                       "exit = \"wedge\" with [seam.wedge]", "write  exit = \"wedge\"  or delete [seam.wedge]");
    if (seam.exit != SeamExit::daylight) return;
    const Point end = p.path.back();
    const double ground = ground_level(p.ground, end.x);
    if (end.y >= ground - 1e-6) return;
    p.wrong("exit",
            fmt::format("{} ends in the rock without exit, at {}: the ground is {:.6g} m above it.", p.label,
                        point_text(end), ground - end.y),
            "a path that comes to the ground, a wedge that it pushes up, or a face that holds nothing",
            "add  [seam.wedge]  with its friction, write  exit = \"free-face\" , or extend points_m to the ground");
}

void check_wedge_angle(const SeamPlace& p)
{
    const SeamWedge& w = *p.seam.wedge;
    check_dilation(p.label + ".wedge", w.dilation, w.friction, p.f);
    const SeamInterface& face = p.seam.interface;
    const double delta = face.model == InterfaceModel::friction ? std::atan(face.friction) : 0.0;
    const double lean = right_angle - face.angle.value_or(right_angle); // of the face, downstream
    const double lock = right_angle - std::atan(w.friction) - delta + lean;
    const auto beyond = [&](const char* key, const std::string& given, double angle) {
        if (angle < lock) return false;
        p.wrong(key,
                fmt::format("{}.{} = {} is beyond the lock: with friction angles of {} (wedge) and {} (interface) degrees "
                            "a wedge of {} degrees or more cannot be pushed up.",
                            p.label, given, in_degrees(angle), in_degrees(std::atan(w.friction)), in_degrees(delta), in_degrees(lock)),
                fmt::format("an angle below {} deg", in_degrees(lock)),
                lock > units::degree ? fmt::format("write an angle below {} deg, or less friction", in_degrees(lock))
                                     : "give the wedge or its interface less friction");
        return true;
    };
    if (w.angles.empty()) {
        if (!(w.search_from > 0.0 && w.search_to < right_angle && w.search_from < w.search_to))
            p.wrong("wedge.search",
                    fmt::format("{}.wedge.search_deg = [{}, {}].", p.label, in_degrees(w.search_from), in_degrees(w.search_to)),
                    "two angles between 0 and 90, the smaller first", "write  search_deg = [10, 60]");
        else
            beyond("wedge.search", "wedge.search_deg from", w.search_from);
    }
    for (const double angle : w.angles)
        if (beyond(w.angles.size() > 1 ? "wedge.angles" : "wedge.angle",
                   w.angles.size() > 1 ? "wedge.angles_deg" : "wedge.angle_deg", angle))
            break;
    for (const char* other : {"angles", "search"})
        for (const char* key : {"angle", "angles"})
            if (std::string(other) != key && p.f.given(p.label + ".wedge." + key) &&
                p.f.given(p.label + ".wedge." + other)) {
                p.wrong((std::string("wedge.") + other).c_str(),
                        fmt::format("{}.wedge.{}_deg and {}_deg are both given.", p.label, key, other),
                        "one of angle_deg, angles_deg and search_deg", "delete one");
                return;
            }
}

void check_interface(const SeamPlace& p)
{
    const SeamInterface& face = p.seam.interface;
    const bool rubs = face.model == InterfaceModel::friction;
    for (const auto& [key, written] : {std::pair("friction", "friction"), std::pair("cohesion", "cohesion_kPa")})
        if (!rubs && p.f.given(p.label + ".interface." + key))
            p.wrong((std::string("interface.") + key).c_str(),
                    fmt::format("{}.interface.{} is given, but its model is \"smooth\".", p.label, written),
                    "model = \"friction\" with friction and cohesion_kPa",
                    fmt::format("write  model = \"friction\"  in [seam.interface], or delete {}", written));
    if (rubs && !p.f.given(p.label + ".interface.friction"))
        p.wrong("interface.model", p.label + ".interface.model = \"friction\" without interface.friction.", "both",
                "add  friction_deg = 20  to [seam.interface]");
}

void check_seam_uplift(const SeamPlace& p)
{
    const Seam& seam = p.seam;
    const bool points = seam.uplift == UpliftModel::points;
    if (points != !seam.uplift_points.empty())
        p.wrong(points ? "uplift" : "uplift_points",
                points ? p.label + ".uplift = \"points\" without uplift_points_m."
                       : fmt::format("{}.uplift_points_m is given, but {}.uplift is not \"points\".", p.label, p.label),
                "uplift = \"points\" with uplift_points_m",
                points ? "add  uplift_points_m = [[0, 1], [45, 0]]" : "write  uplift = \"points\"  or delete the points");
    if (seam.uplift == UpliftModel::drains && !p.scene.drains)
        p.wrong("uplift", p.label + ".uplift = \"drains\" without [drains].", "both",
                "add  [drains]  with its distance_m, or write  uplift = \"linear\"");
    if (seam.dilation_slip && seam.dilation == 0.0 && !(seam.wedge && seam.wedge->dilation > 0.0))
        p.wrong("dilation_slip", p.label + ".dilation_slip_m is given without dilation_deg.", "both or neither",
                "add  dilation_deg = 5 , or delete dilation_slip_m");
}

void check_ground_line(const Scene& s, Findings& f)
{
    const Polyline& g = s.foundation->ground;
    for (std::size_t i = 1; i < g.size(); ++i)
        if (!(g[i].x > g[i - 1].x))
            return f.wrong("foundation.ground",
                           fmt::format("foundation.ground_m has x = {} at place {}, not downstream of {}.",
                                       shortest(g[i].x), i + 1, shortest(g[i - 1].x)),
                           "points from upstream to downstream, x increasing", "put the points in order");
    if (!g.empty() && s.seams.empty())
        f.wrong("foundation.ground", "foundation.ground_m is given, but the scene has no [[seam]].",
                "the ground is asked for by the planes of [[seam]] only", "add a [[seam]], or delete ground_m");
    if (s.foundation->k0 && s.seams.empty())
        f.wrong("foundation.k0", fmt::format("foundation.k0 = {} is given, but the scene has no [[seam]].", shortest(*s.foundation->k0)),
                "the stress of the rock before the dam decides on a [[seam]] by  fe --plane  only", "add a [[seam]], or delete k0");
}

} // namespace

void check_planes(const Scene& s, Findings& f)
{
    if (s.lifts) {
        check_strength(s.lifts->strength, "lifts", f);
        check_lift_choices(s, f);
        check_lift_places(s, f);
    }
    if (s.foundation) check_ground_line(s, f);
    std::set<std::string> names{"base"};
    for (std::size_t i = 0; i < s.seams.size(); ++i) {
        const Seam& seam = s.seams[i];
        const SeamPlace place{s, seam, fmt::format("seam[{}]", i + 1), seam_path(s, seam), ground_line(s), f};
        if (!names.insert(seam.name).second)
            place.wrong("name", fmt::format("two planes are named \"{}\".", seam.name),
                        "names that differ; \"base\" is the base of the dam", "rename one");
        if (seam.name.find_first_of(",[]") != std::string::npos)
            place.wrong("name", fmt::format("{}.name = \"{}\".", place.label, seam.name),
                        "a name without comma and brackets: commands take a list of names", "rename it");
        if (!s.foundation || !(s.foundation->material.density > 0.0))
            f.wrong(place.label,
                    fmt::format("{} needs the weight of the rock above it, but foundation.density_kg_m3 is {}.",
                                place.label, s.foundation ? "0" : "not there"),
                    "the density of saturated rock: 1900 ... 3100 kg/m3 is usual",
                    s.foundation ? "add  density_kg_m3 = 2650  to [foundation]"
                                 : "add  [foundation]  with young_modulus_GPa = 20  and  density_kg_m3 = 2650");
        check_strength(seam.strength, place.label, f);
        check_dilation(place.label, seam.dilation, seam.strength.friction, f);
        check_interface(place);
        check_seam_uplift(place);
        if (seam.wedge) check_wedge_angle(place);
        const bool bad_path = f.any();
        check_path(place);
        if (!bad_path && !f.any()) check_exit(place);
    }
}

} // namespace damslip::checks
