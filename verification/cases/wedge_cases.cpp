#include "scene/scene.hpp"
#include "scene/rock_wedge.hpp"
#include "sliding/flexible/flexible_mode.hpp"
#include "sliding/wedge/wedge.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/wedge_short_solution.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;
using Checks = std::vector<damslip::verification::Check>;

constexpr double deg = std::numbers::pi / 180.0;

/// Hoek & Bray's example, in their units: feet, pounds per cubic and square foot.
struct Example {
    double height = 130.0, rock = 160.0, water = 62.5;
    double c_a = 500.0, phi_a = 30.0 * deg, c_b = 1000.0, phi_b = 20.0 * deg;
    exact::DipAndDirection a{45 * deg, 105 * deg}, b{70 * deg, 235 * deg}, face{65 * deg, 185 * deg},
        upper{12 * deg, 195 * deg};
};

RockWedge rock_wedge(const Example& e)
{
    RockWedge w;
    w.height = e.height;
    w.face_dip = e.face.dip;
    w.face_dip_direction = e.face.direction;
    w.upper_dip = e.upper.dip;
    w.upper_dip_direction = e.upper.direction;
    w.planes.resize(2);
    w.planes[0].dip = e.a.dip;
    w.planes[0].dip_direction = e.a.direction;
    w.planes[1].dip = e.b.dip;
    w.planes[1].dip_direction = e.b.direction;
    return w;
}

/// By the shape of the scene, weights as forces (gravity 1).
double factor_of_shape(const Example& e, double water)
{
    const WedgeShape s = wedge_shape(rock_wedge(e)).value();
    Wedge w;
    w.gravity = 1.0;
    w.mass = e.rock * s.volume;
    const double pressure = water * e.height / 6.0;
    w.first = {e.a.dip, e.a.direction, s.first_area, std::tan(e.phi_a), e.c_a, pressure * s.first_area};
    w.second = {e.b.dip, e.b.direction, s.second_area, std::tan(e.phi_b), e.c_b, pressure * s.second_area};
    return wedge_state(w).factor_of_safety;
}

Checks published_wedge()
{
    const Example e;
    // The angles the book reads from its stereonet.
    const exact::ShortSolution printed = exact::short_solution(
        {45 * deg, 70 * deg, 31.2 * deg, 101 * deg, 65 * deg, 25 * deg, 50 * deg, 62 * deg, 31 * deg, 60 * deg});
    const exact::ShortSolution whole = exact::short_solution(exact::wedge_angles(e.a, e.b, e.face, e.upper));
    const auto factor = [&e](const exact::ShortSolution& s, double water) {
        return s.factor(e.height, e.rock, water, e.c_a, e.phi_a, e.c_b, e.phi_b);
    };
    Checks checks{
        {"factor of safety with the book's angles: printed 1.36", "–", 1.36, factor(printed, e.water), 0.005,
         Measure::absolute},
        {"factor of safety of the scene's shape: printed 1.36", "–", 1.36, factor_of_shape(e, e.water), 0.015},
        {"the same by the formula with unrounded angles", "–", factor(whole, e.water), factor_of_shape(e, e.water),
         1e-12},
        {"dry", "–", factor(whole, 0.0), factor_of_shape(e, 0.0), 1e-12}};
    // Another wedge, steeper ground, an obtuse angle between the planes.
    Example other;
    other.a = {52 * deg, 150 * deg};
    other.b = {40 * deg, 262 * deg};
    other.face = {74 * deg, 210 * deg};
    other.upper = {5 * deg, 30 * deg};
    const exact::ShortSolution s =
        exact::short_solution(exact::wedge_angles(other.a, other.b, other.face, other.upper));
    checks.push_back({"another wedge, wet", "–", factor(s, other.water), factor_of_shape(other, other.water), 1e-12});
    return checks;
}

GroundMotion shaking()
{
    GroundMotion motion;
    motion.dt = 0.01;
    for (int k = 0; k <= 600; ++k) {
        const double t = 0.01 * k, rise = std::sin(std::numbers::pi * t / 6.0);
        motion.accel_h.push_back(6.0 * rise * std::sin(9.0 * t));
        motion.accel_v.push_back(3.0 * rise * std::cos(14.0 * t));
    }
    motion.accel_v.back() = motion.accel_h.back() = 0.0;
    return motion;
}

/// A wedge that slides on its flatter plane alone along the dip is the block on that plane: 30 degrees to the north.
Wedge on_flatter_plane(double cohesion)
{
    Wedge w;
    w.mass = 1e5;
    w.first = {30 * deg, 0.0, 10.0, std::tan(40 * deg), cohesion, 4e4};
    w.second = {60 * deg, 20 * deg, 10.0, std::tan(40 * deg), 0.0, 0.0};
    return w;
}

Checks wedge_and_block()
{
    Checks checks;
    const GroundMotion motion = shaking();
    SlideOptions options;
    options.sliding.two_way = false;
    for (const double cohesion : {0.0, 6e3}) {
        const Wedge w = on_flatter_plane(cohesion);
        RigidBlock block;
        block.mass = w.mass;
        block.friction = w.first.friction;
        block.base_inclination = 30 * deg;
        block.uplift = w.first.water_force;
        block.cohesion_force = cohesion * w.first.area;
        SlipStages stages{{0.0, block, 0.0}};
        WedgeYields yields{wedge_yield(w, {0.0, 1.0, 0.0}), std::nullopt};
        if (cohesion > 0.0) {
            block.cohesion_force = 0.0;
            stages.push_back({0.0, block, 0.0});
            yields.moving = without_cohesion(w, yields.at_rest);
        }
        const Yield yield = yield_downstream(stages.front().block);
        const std::string with = cohesion > 0.0 ? ", cohesion lost at the first slip" : ", no cohesion";
        checks.push_back({"a_y per a_v" + with, "–", yield.law.per_a_v, yields.at_rest.law.per_a_v, 1e-12});
        checks.push_back(
            {"slip" + with, "m", slide(motion, stages, options).slip, slide_wedge(motion, yields, options).slip, 1e-9});
        checks.push_back({"it slides at all" + with, "m", 0.01, slide_wedge(motion, yields, options).slip, 0.0,
                          Measure::lower_bound});
    }
    // Equal planes, mirrored about the vertical plane through north: a block with tan(phi)/sin(xi/2) on the plunge of the line.
    Wedge w;
    w.mass = 1e5;
    w.first = {45 * deg, 35 * deg, 10.0, std::tan(32 * deg), 0.0, 0.0};
    w.second = {45 * deg, -35 * deg, 10.0, std::tan(32 * deg), 0.0, 0.0};
    const double cos_xi = -(std::pow(std::sin(45 * deg), 2) * std::cos(70 * deg) + std::pow(std::cos(45 * deg), 2));
    RigidBlock block;
    block.mass = w.mass;
    block.friction = std::tan(32 * deg) / std::sqrt(0.5 * (1.0 - cos_xi));
    block.base_inclination = std::atan(std::cos(35 * deg));
    checks.push_back({"slip on both planes, with vertical motion", "m", slide(motion, block, options).slip,
                      slide_wedge(motion, {wedge_yield(w, {0.0, 1.0, 0.0}), std::nullopt}, options).slip, 1e-9});
    return checks;
}

/// psi = (y/H)^n over a rectangle b x H, water to the crest by Westergaard's simplified formula 7/8 rho sqrt(h z):
///     L = rho_c b H/(n + 1) + 7/8 rho h^2 B(3/2, n + 1),   M_1 with 2 n,   M = rho_c b H + 7/12 rho h^2.
Checks shape_sums()
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {20, 0}, {20, 40}, {0, 40}};
    scene.dam.density = 2400.0;
    Checks checks;
    for (const double n : {0.5, 1.5, 2.0}) {
        scene.reservoir.reset();
        const double mass = 2400.0 * 20.0 * 40.0;
        checks.push_back({"rectangle, dry: mass ratio", "–", (2 * n + 1) / ((n + 1) * (n + 1)),
                          power_shape(scene, n).mass_ratio(), 1e-13});
        scene.reservoir.emplace().level = 40.0;
        scene.reservoir->model = ReservoirModel::added_mass;
        scene.added_mass.formula = AddedMassFormula::westergaard_simplified;
        const double water = 1000.0 * 40.0 * 40.0;
        const double load = mass / (n + 1) + 7.0 / 8.0 * water * std::beta(1.5, n + 1),
                     modal = mass / (2 * n + 1) + 7.0 / 8.0 * water * std::beta(1.5, 2 * n + 1);
        const ModalSums sums = power_shape(scene, n);
        checks.push_back({"with water: L", "kg/m", load, sums.load, 1e-6});
        checks.push_back({"with water: M_1", "kg/m", modal, sums.mass, 1e-6});
        checks.push_back({"with water: M", "kg/m", mass + 7.0 / 12.0 * water, sums.total, 1e-12});
    }
    // A triangle with a vertical face, width b (1 - y/H): L = rho b H/((n + 1)(n + 2)).
    scene.reservoir.reset();
    scene.section.polygon = {{0, 0}, {30, 0}, {0, 40}};
    const double n = 1.5, half = 2400.0 * 30.0 * 40.0;
    checks.push_back({"triangle: L", "kg/m", half / ((n + 1) * (n + 2)), power_shape(scene, n).load, 1e-13});
    return checks;
}

} // namespace

void add_wedge_cases(Registry& registry)
{
    registry.push_back(
        {"sliding.neighbours.wedge-example",
         "Factor of safety of a wedge with cohesion and water, its volume and areas from the orientations.",
         "Hoek & Bray (1981), ch. 8, and Wyllie & Mah (2004), ch. 7: planes 45/105 and 70/235, face 65/185, "
         "upper ground 12/195, FS = 1.36; the short solution (verification/exact/wedge_short_solution.hpp)",
         "printed: half a unit of the last digit with the book's angles; these are read to 1 degree, which moves "
         "X by 2 % and the factor by half of that, 1.5 %; unrounded: round-off",
         published_wedge});
    registry.push_back(
        {"sliding.neighbours.wedge-vertical-motion",
         "Slip of a wedge under both components, with cohesion lost, against the rigid block on an incline.",
         "the same equation of motion where one plane, or a plane of symmetry, carries the wedge",
         "slips: events located by two integrators, 1e-9; else round-off", wedge_and_block});
    registry.push_back({"sliding.neighbours.flexible-shape",
                        "L, M_1 and mass ratio of the shape (y/H)^n, water included.",
                        "closed integrals, with the beta function for Westergaard's root (3-4)",
                        "the water's integral by 4000 midpoints: 1e-6; else round-off", shape_sums});
}

} // namespace damslip::verification
