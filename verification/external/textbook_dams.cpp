#include "verification/external/textbook_dams.hpp"
#include "core/units.hpp"
#include "scene/read.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "sliding/loads/added_mass.hpp"
#include "sliding/planes/lifts.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::external {

namespace {

using sliding::Equilibrium;

constexpr double kilo = 1e3;

/// A number that the book prints, and where the equilibrium of a combination has it.
struct Printed {
    const char *combination, *what, *unit;
    double value;
    double accuracy; ///< half a unit of the last digit, with what the source's rounded coefficients leave
    double (*ours)(const Equilibrium&);
};

struct TextbookDam {
    const char* example;
    double concrete, water; ///< unit weights [kN/m^3]
    const char* scene;      ///< without densities
    std::vector<Printed> numbers;
};

/// The scene of a dam. With g = 9.80665 a seismic coefficient times the weight is the force that the book takes.
Scene scene_of(const TextbookDam& dam, const std::string& more = "")
{
    const double g = units::standard_gravity;
    const bool wet = std::string_view(dam.scene).find("[reservoir]") != std::string_view::npos;
    const std::string text =
        fmt::format("title = \"{0}\"\n[site]\ngravity_m_s2 = {1}\n[dam]\ndensity_kg_m3 = {2:.17g}\n{3}{4}\n{5}",
                    dam.example, g, dam.concrete * kilo / g,
                    wet ? "[reservoir]\ndensity_kg_m3 = " + fmt::format("{:.17g}\n", dam.water * kilo / g) : "",
                    wet ? std::string(dam.scene).substr(std::string_view("[reservoir]\n").size()) : dam.scene, more);
    return parse_scene(text, dam.example);
}

double force_x(const Equilibrium& e, sliding::LoadKind kind)
{
    double sum = 0.0;
    for (const sliding::Load& load : e.loads) sum += load.kind == kind ? load.force.total().x : 0.0;
    return sum / kilo;
}

double moment(const Equilibrium& e, sliding::LoadKind kind)
{
    double sum = 0.0;
    for (const sliding::Load& load : e.loads) sum += load.kind == kind ? load.force.horizontal.moment : 0.0;
    return -sum / kilo;
}

double normal(const Equilibrium& e)
{
    return e.base.effective_normal / kilo;
}
double uplift(const Equilibrium& e)
{
    return e.base.uplift.force / kilo;
}
double without_uplift(const Equilibrium& e)
{
    return -e.load.y / kilo;
}
double shear(const Equilibrium& e)
{
    return e.shear / kilo;
}
double sliding_factor(const Equilibrium& e)
{
    return e.sliding_factor;
}
double friction_factor(const Equilibrium& e)
{
    return e.friction_factor;
}
double overturning(const Equilibrium& e)
{
    return e.overturning_factor;
}
double toe_stress(const Equilibrium& e)
{
    return e.toe_stress / kilo;
}
double heel_stress(const Equilibrium& e)
{
    return e.heel_stress / kilo;
}
double twice_mean(const Equilibrium& e)
{
    return (e.heel_stress + e.toe_stress) / kilo;
}
double eccentricity(const Equilibrium& e)
{
    return e.eccentricity;
}
double hydrodynamic(const Equilibrium& e)
{
    return force_x(e, sliding::LoadKind::hydrodynamic);
}
double hydrodynamic_moment(const Equilibrium& e)
{
    return moment(e, sliding::LoadKind::hydrodynamic);
}
double inertia(const Equilibrium& e)
{
    return force_x(e, sliding::LoadKind::inertia);
}
double inertia_moment(const Equilibrium& e)
{
    return moment(e, sliding::LoadKind::inertia);
}
double lift(const Equilibrium& e)
{
    for (const sliding::Load& load : e.loads)
        if (load.kind == sliding::LoadKind::inertia) return load.force.vertical.y / kilo;
    return std::nan("");
}

/// The dams that are one equilibrium each.
std::vector<TextbookDam> dams()
{
    return {
        {"example 8.8, wall with uplift",
         23.544,
         9.81,
         R"([reservoir]
[section]
height_m = 3.55
base_m = 3
crest_m = 3
[contact]
friction = 0.5
[uplift]
model = "linear"
[[combination]]
name = "full"
crack = "none")",
         {{"full", "eccentricity at the height of no tension, 3.55 m", "m", 0.5, 0.00104, eccentricity}}},
        {"example 8.8, higher wall with uplift",
         23.544,
         9.81,
         R"([reservoir]
[section]
height_m = 3.8
base_m = 3
crest_m = 3
[contact]
friction = 0.5
[uplift]
model = "linear"
[[combination]]
name = "full"
crack = "none")",
         {{"full", "sliding at the height of 1.5, 3.80 m", "–", 1.5, 0.002, sliding_factor}}},
        {"example 8.8, wall without uplift",
         23.544,
         9.81,
         R"([reservoir]
[section]
height_m = 4.65
base_m = 3
crest_m = 3
[contact]
friction = 0.5
[uplift]
model = "none"
[[combination]]
name = "full"
crack = "none")",
         {{"full", "eccentricity at the height of no tension, 4.65 m", "m", 0.5, 0.0011, eccentricity}}},
        {"example 8.8, higher wall without uplift",
         23.544,
         9.81,
         R"([reservoir]
[section]
height_m = 4.8
base_m = 3
crest_m = 3
[contact]
friction = 0.5
[uplift]
model = "none"
[[combination]]
name = "full"
crack = "none")",
         {{"full", "sliding at the height of 1.5, 4.80 m", "–", 1.5, 0.0016, sliding_factor}}},
        {"example 8.9",
         23.544,
         9.81,
         R"([reservoir]
[section]
height_m = 6
base_m = 4.5
crest_m = 1.5
[contact]
friction = 0.6
[uplift]
model = "linear"
[[combination]]
name = "empty"
reservoir_level_m = 0
crack = "none"
[[combination]]
name = "full"
crack = "none")",
         {{"empty", "stress at the toe", "kPa", 15.7, 0.05, toe_stress},
          {"empty", "stress at the heel", "kPa", 172.7, 0.05, heel_stress},
          {"full", "stress at the toe", "kPa", 120.3, 0.05, toe_stress},
          {"full", "stress at the heel", "kPa", 9.2, 0.05, heel_stress}}},
        {"example 8.10",
         20.0,
         9.81,
         R"([reservoir]
[section]
height_m = 6
base_m = 4.94
crest_m = 1.5
[contact]
friction = 0.6
[uplift]
model = "linear"
[[combination]]
name = "full"
crack = "none")",
         {{"full", "sliding", "–", 0.82, 0.005, sliding_factor},
          {"full", "largest stress, twice the mean", "kPa", 97.6, 0.05, twice_mean}}},
        {"example 8.11",
         20.0,
         9.81,
         R"([reservoir]
[section]
height_m = 6
base_m = 3.77
crest_m = 1.5
[contact]
friction = 0.6
[uplift]
model = "none"
[[combination]]
name = "full"
crack = "none")",
         {{"full", "sliding", "–", 1.074, 0.0005, sliding_factor},
          {"full", "largest stress, twice the mean", "kPa", 167.7, 0.05, twice_mean},
          {"full", "eccentricity, a sixth of the base", "m", 0.6283, 0.0029, eccentricity}}},
        {"example 8.12",
         21.0,
         9.81,
         R"([reservoir]
level_m = 13.65
[gate]
top_m = 13.65
[section]
height_m = 12
base_m = 9
crest_m = 3
[contact]
friction = 0.6
[uplift]
model = "none"
[[combination]]
name = "full"
crack = "none")",
         {{"full", "eccentricity with the shutter of no tension, 1.65 m", "m", 1.5, 0.0031, eccentricity}}},
        {"example 8.14",
         22.4,
         9.81,
         R"([reservoir]
[section]
height_m = 10
base_m = 8.25
crest_m = 1
upstream_slope = 0.1
[contact]
friction = 0.75
cohesion_kPa = 1400
[uplift]
model = "linear"
[[combination]]
name = "full"
crack = "none")",
         {{"full", "weight with the water on the face", "kN/m", 1085.05, 0.005, without_uplift},
          {"full", "uplift", "kN/m", 404.66, 0.005, uplift},
          {"full", "thrust", "kN/m", 490.5, 0.05, shear},
          {"full", "N'", "kN/m", 680.39, 0.005, normal},
          {"full", "sliding by friction", "–", 1.04, 0.005, friction_factor},
          {"full", "shear friction factor", "–", 24.6, 0.05, sliding_factor},
          {"full", "overturning", "–", 1.47, 0.005, overturning},
          {"full", "stress at the toe", "kPa", 170.7, 0.05, toe_stress},
          {"full", "stress at the heel", "kPa", -5.8, 0.05, heel_stress}}},
        {"example 8.15",
         23.5,
         9.81,
         R"([reservoir]
level_m = 89
model = "added-mass"
[section]
height_m = 90
base_m = 73.1
crest_m = 7
neck_m = 7
upstream_slope = 0.2857142857142857
upstream_slope_height_m = 28
[added_mass]
formula = "zangar"
zangar_table_deg = [[0, 0.735], [90, 0.735]]
inclined_face = "horizontal"
[contact]
friction = 0.75
cohesion_kPa = 1400
[uplift]
model = "points"
points_m = [[0, 0.6666666666666667], [73.1, 0]]
[[combination]]
name = "earthquake"
k_h = 0.1
crack = "none"
[[combination]]
name = "IS 6512:1984"
k_h = 0.1
friction_divisor = 1.2
cohesion_divisor = 2.4
crack = "none")",
         {{"earthquake", "uplift", "kN/m", 21274, 0.5, uplift},
          {"earthquake", "hydrodynamic force", "kN/m", 4146.4, 2.9, hydrodynamic},
          {"earthquake", "N'", "kN/m", 58710.7, 0.05, normal},
          {"earthquake", "shear", "kN/m", 50408.8, 2.9, shear},
          {"earthquake", "sliding by friction", "–", 0.87, 0.005, friction_factor},
          {"earthquake", "shear friction factor", "–", 2.90, 0.005, sliding_factor},
          {"earthquake", "overturning", "–", 1.44, 0.005, overturning},
          {"IS 6512:1984", "sliding with partial factors 1.2 and 2.4", "–", 1.57, 0.005, sliding_factor},
          {"earthquake", "stress at the toe", "kPa", 1948, 4.7, toe_stress},
          {"earthquake", "stress at the heel", "kPa", -342, 4.7, heel_stress}}},
        {"example 8.16",
         24.0,
         9.81,
         R"([reservoir]
level_m = 70
model = "added-mass"
[section]
height_m = 70
base_m = 52.5
crest_m = 7
neck_m = 10
upstream_slope = 0.1
upstream_slope_height_m = 35
[added_mass]
formula = "zangar"
zangar_table_deg = [[0, 0.712], [90, 0.712]]
inclined_face = "horizontal"
[contact]
friction = 0.7
cohesion_kPa = 1400
[curtain]
distance_m = 6.5
[uplift]
model = "curtain"
curtain_ratio = 0.3333333333333333
[[combination]]
name = "empty"
reservoir_level_m = 0
crack = "none"
[[combination]]
name = "no uplift"
uplift_factor = 0
crack = "none"
[[combination]]
name = "full"
crack = "none"
[[combination]]
name = "B"
friction_divisor = 1.5
cohesion_divisor = 3.6
crack = "none"
[[combination]]
name = "earthquake"
k_h = 0.1
k_v = -0.08
crack = "none"
[[combination]]
name = "E"
k_h = 0.1
k_v = -0.08
friction_divisor = 1.2
cohesion_divisor = 2.7
crack = "none")",
         {{"empty", "stress at the toe", "kPa", 143.5, 0.05, toe_stress},
          {"empty", "stress at the heel", "kPa", 1512.5, 0.05, heel_stress},
          {"no uplift", "stress at the toe", "kPa", 1301.7, 0.05, toe_stress},
          {"no uplift", "stress at the heel", "kPa", 423.0, 0.05, heel_stress},
          {"full", "stress at the toe", "kPa", 1348, 0.5, toe_stress},
          {"full", "stress at the heel", "kPa", 63, 0.5, heel_stress},
          {"full", "sliding by friction", "–", 1.079, 0.0005, friction_factor},
          {"full", "shear friction factor", "–", 4.14, 0.005, sliding_factor},
          {"full", "overturning", "–", 1.78, 0.005, overturning},
          {"B", "sliding with partial factors 1.5 and 3.6", "–", 1.569, 0.0005, sliding_factor},
          {"earthquake", "stress at the toe", "kPa", 1717, 4.4, toe_stress},
          {"earthquake", "stress at the heel", "kPa", -439, 4.4, heel_stress},
          {"earthquake", "sliding by friction", "–", 0.761, 0.0005, friction_factor},
          {"earthquake", "shear friction factor", "–", 3.14, 0.005, sliding_factor},
          {"earthquake", "overturning", "–", 1.33, 0.005, overturning},
          {"E", "sliding with partial factors 1.2 and 2.7", "–", 1.52, 0.005, sliding_factor}}},
        {"example 8.18",
         2.4 * 9.80665,
         9.80665,
         R"([reservoir]
level_m = 97
[section]
height_m = 100
base_m = 75
crest_m = 7
neck_m = 10
[contact]
friction = 0.75
[uplift]
model = "none"
[[combination]]
name = "full"
crack = "none")",
         {{"full", "sliding", "–", 1.439, 0.0005, sliding_factor}}},
        {"example 8.20",
         23.5,
         9.81,
         R"([reservoir]
level_m = 80
[tailwater]
level_m = 6
[section]
height_m = 84
base_m = 56
crest_m = 6
neck_m = 9
[contact]
friction = 0.7
[curtain]
distance_m = 8
[uplift]
model = "curtain"
curtain_ratio = 0.3333333333333333
[[combination]]
name = "full"
crack = "none")",
         {{"full", "stress at the toe", "kPa", 1586.7, 0.05, toe_stress},
          {"full", "stress at the heel", "kPa", -49.3, 0.05, heel_stress}}},
        {"example 8.1",
         24.0,
         9.81,
         R"([reservoir]
level_m = 98
model = "added-mass"
[section]
height_m = 100
base_m = 70
crest_m = 7
neck_m = 10
[added_mass]
formula = "zangar"
zangar_table_deg = [[0, 0.735], [90, 0.735]]
[contact]
friction = 0.7
[uplift]
model = "none"
[[combination]]
name = "falling"
k_h = 0.1
k_profile_m = [[0, 0], [100, 1.5]]
crack = "none"
[[combination]]
name = "mean"
k_h = 0.050941772748703496
crack = "none")",
         {{"falling", "inertia, coefficient falling to 0 at the base", "kN/m", 4321.9, 0.105, inertia},
          {"falling", "its moment at the base", "kNm/m", 221790, 9.5, inertia_moment},
          {"mean", "hydrodynamic force at the base", "kN/m", 2561, 2.3, hydrodynamic},
          {"mean", "its moment", "kNm/m", 103366, 2536, hydrodynamic_moment}}},
        {"example 8.3",
         24.0,
         9.81,
         R"([section]
height_m = 100
base_m = 70
crest_m = 7
neck_m = 10
[contact]
friction = 0.7
[[combination]]
name = "coefficient"
k_v = -0.05
k_profile_m = [[0, 0], [100, 1.5]]
crack = "none"
[[combination]]
name = "spectrum"
k_v = -0.07125
k_profile_m = [[0, 0], [100, 1]]
crack = "none")",
         {{"coefficient", "vertical inertia, coefficient 0.075 falling to 0", "kN/m", 2160.9, 0.05, lift},
          {"spectrum", "vertical inertia, coefficient 0.07125 falling to 0", "kN/m", 2052.86, 0.006, lift}}},
    };
}

/// Counted together by their unit.
Result result(const std::string& example, const std::string& what, std::string_view unit, double theirs,
              double accuracy, double ours)
{
    const char* group = unit == "kN/m"    ? "forces"
                        : unit == "kNm/m" ? "moments"
                        : unit == "kPa"   ? "stresses and pressures"
                        : unit == "m"     ? "eccentricities"
                                          : "factors of safety";
    return {.group = group,
            .what = example + ": " + what,
            .unit = std::string(unit),
            .theirs = theirs,
            .ours = ours,
            .accuracy = accuracy,
            .reason = ""};
}

/// Shear and moment 10 m below the crest of example 8.1, where the joint is as wide as the crest, and the vertical force of 8.3.
std::vector<Result> upper_part()
{
    const TextbookDam dam{"example 8.1, 10 m below the crest",
                          24.0,
                          9.81,
                          R"([section]
height_m = 100
base_m = 70
crest_m = 7
neck_m = 10
[contact]
friction = 0.7
[lifts]
elevations_m = [90]
friction = 0.7
uplift = "none"
amplification = "points"
amplification_points_m = [[0, 0], [100, 1.5]])",
                          {}};
    const double g = units::standard_gravity;
    const auto planes = sliding::lift_planes(
        scene_of(dam), {{"rest", 0.0, 0.0}, {"horizontal", 0.1 * g, 0.0}, {"vertical", 0.0, -0.05 * g}});
    const std::vector<sliding::LiftState>& s = planes.front().states;
    const double width = planes.front().length;
    const double bending = (s[1].toe_stress - s[1].heel_stress) * width * width / 12.0;
    return {result(dam.example, "shear", "kN/m", 239.5, 0.105, s[1].shear / kilo),
            result(dam.example, "moment", "kNm/m", 1218, 0.5, bending / kilo),
            result(dam.example, "vertical force (8.3)", "kN/m", 119.7, 0.05, (s[0].normal - s[2].normal) / kilo)};
}

/// Pressure on a battered face at half the depth, example 8.13. Its shear and moment are coefficients of the base times this
/// pressure; the integral of the same pressures down to there is smaller.
std::vector<Result> battered_face()
{
    AddedMass method;
    method.formula = AddedMassFormula::zangar;
    method.inclined_face = InclinedFaceRule::printed;
    method.zangar_table = {{0.0, 0.735}, {0.5 * std::numbers::pi, 0.0}};
    const double depth = 100.0, y = 50.0, acceleration = 0.1 * 9.81;
    const double p =
        acceleration * sliding::added_mass_per_area(method, {depth, 1000.0, 2200e6}, y, std::atan(0.15)) / kilo;
    return {result("example 8.13", "pressure on a face of 0.15 at 50 of 100 m", "kPa", 52.738, 0.0005, p)};
}

std::vector<Result> run()
{
    std::vector<Result> all;
    for (const TextbookDam& dam : dams()) {
        const auto states = sliding::evaluate_combinations(scene_of(dam));
        for (const Printed& n : dam.numbers)
            for (const Equilibrium& e : states)
                if (e.name == n.combination)
                    all.push_back(result(dam.example, fmt::format("{}, {}", n.combination, n.what), n.unit, n.value,
                                         n.accuracy, n.ours(e)));
    }
    for (const std::vector<Result>& more : {upper_part(), battered_face()})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

} // namespace

Source textbook_dams_source()
{
    return {
        "punmia",
        "Punmia & Lal, Irrigation and water power engineering, chapter 8: examples 8.1 to 8.20 as its public worked "
        "code "
        "(FOSSEE, Scilab textbook companion 2087, commit b1f5c3f8) prints them",
        "15 dams and walls of 3 to 100 m by limit equilibrium: weight, uplift with and without gallery, tailwater, "
        "shutters, "
        "seismic coefficients, Zangar's pressure, partial factors of IS 6512",
        "Half a unit of the last digit. Of what rests on Zangar's force also half a unit of its printed 0.726, of what "
        "rests "
        "on his moment the printed 0.299 against 7/24, the moment of the same pressures; of 8.1 its 0.25 for 0.252. "
        "Heights found for a limit are put in, and the limit is compared, by the half unit of the height",
        "",
        [](const auto&) { return run(); }};
}

} // namespace damslip::external
