#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/planes/lifts.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/reference_scene.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;
using Checks = std::vector<damslip::verification::Check>;

constexpr double degree = std::numbers::pi / 180.0;

double tan_deg(double angle)
{
    return std::tan(angle * degree);
}

// Passive thrust on a wall: the force T on a weightless block on ice, in front of which a wedge is pushed up, at a_y = a_h.

struct Wall {
    double unit_weight = 26e3, height = 10.0, phi = 35.0, cohesion = 0.0, delta = 0.0, k_h = 0.0, k_v = 0.0;
    bool water = false; ///< still, up to the surface
};

double thrust(const Wall& wall, double alpha)
{
    constexpr double g = 9.81;
    Chain chain;
    chain.gravity = g;
    ChainBlock plate, wedge;
    plate.length = 1.0;
    wedge.dip = -alpha;
    wedge.length = wall.height / std::sin(alpha);
    wedge.mass = 0.5 * wall.unit_weight * wall.height * wall.height / std::tan(alpha) / g;
    wedge.friction = tan_deg(wall.phi);
    wedge.cohesion = wall.cohesion;
    ChainInterface face;
    face.length = wall.height;
    face.friction = tan_deg(wall.delta);
    if (wall.water) {
        wedge.uplift = 0.5 * 1000.0 * g * wall.height * wedge.length;
        face.water = 0.5 * 1000.0 * g * wall.height * wall.height;
    }
    chain.blocks = {plate, wedge};
    chain.interfaces = {face};
    const ChainLaw law = chain_law(chain);
    return -(law.constant + law.per_a_v * wall.k_v * g + law.drive * wall.k_h * g) / law.weights[0].x;
}

/// Least thrust over the angle: by parabolas through three points, closer and closer.
std::array<double, 2> least_thrust(const Wall& wall)
{
    double middle = 25.0 * degree, step = 5.0 * degree;
    for (int i = 0; i < 60; ++i) {
        const double left = thrust(wall, middle - step), here = thrust(wall, middle), right = thrust(wall, middle + step);
        if (left < here) middle -= step;
        else if (right < here) middle += step;
        else {
            middle += 0.5 * step * (left - right) / (left - 2.0 * here + right);
            if ((step *= 0.5) < 1e-4) break;
        }
    }
    return {middle / degree, thrust(wall, middle)};
}

Checks passive_thrust()
{
    const auto rankine = least_thrust({.cohesion = 20e3});
    const auto coulomb = least_thrust({.delta = 15.0});
    const auto shaken = least_thrust({.k_h = 0.2, .k_v = -0.1});
    Wall wet{.unit_weight = 2600.0 * 9.81};
    wet.water = true;
    const double own = 0.5 * wet.unit_weight * 100.0 / tan_deg(30.0), gamma = 9810.0;
    // Rankine: γ h²/2 K_p + 2 c h √K_p; Coulomb and Mononobe & Okabe: closed coefficients for a vertical wall, level ground.
    const double kp = std::pow(tan_deg(45.0 + 17.5), 2.0);
    const auto coefficient = [](double phi, double delta, double psi) {
        const double root = std::sqrt(std::sin((phi + delta) * degree) * std::sin((phi - psi) * degree) /
                                      (std::cos(delta * degree + psi * degree)));
        return std::pow(std::cos((phi - psi) * degree), 2.0) /
               (std::cos(psi * degree) * std::cos((delta + psi) * degree) * std::pow(1.0 - root, 2.0));
    };
    const double psi = std::atan(0.2 / 0.9) / degree;
    return {
        {"Rankine: angle", "deg", 27.5, rankine[0], 1e-6},
        {"Rankine: thrust", "N/m", 0.5 * 26e3 * 100.0 * kp + 2.0 * 20e3 * 10.0 * std::sqrt(kp), rankine[1], 1e-12},
        {"Coulomb: angle", "deg", 18.674252, coulomb[0], 1e-6},
        {"Coulomb: normal to the wall", "N/m", 0.5 * 26e3 * 100.0 * coefficient(35.0, 15.0, 0.0) * std::cos(15.0 * degree),
         coulomb[1], 1e-11},
        {"Mononobe & Okabe: angle", "deg", 24.664037, shaken[0], 1e-6},
        {"Mononobe & Okabe: thrust", "N/m", 0.5 * 26e3 * 0.9 * 100.0 * coefficient(35.0, 0.0, psi), shaken[1], 1e-11},
        {"still water, at 30 degrees", "N/m",
         (own - 0.5 * gamma * 100.0 / tan_deg(30.0)) * tan_deg(65.0) + 0.5 * gamma * 100.0, thrust(wet, 30.0 * degree), 1e-12},
        {"still water, printed", "kN/m", 3405.557152, 1e-3 * thrust(wet, 30.0 * degree), 1e-9},
    };
}

/// Two blocks: 5e6 kg/m on a level seam, 2e5 kg/m on a plane at 25 degrees.
Chain two_blocks(double delta, double psi = 0.0, double psi_wedge = 0.0, double psi_face = 0.0)
{
    Chain chain;
    ChainBlock body, wedge;
    body.mass = 5e6;
    body.length = 1.0;
    body.force = {22e6, 0.0};
    body.uplift = 15e6;
    body.friction = 0.6;
    body.dilation = psi * degree;
    wedge.mass = 2e5;
    wedge.dip = -25.0 * degree;
    wedge.length = 8.0 / std::sin(25.0 * degree);
    wedge.friction = tan_deg(40.0);
    wedge.cohesion = 100e3;
    wedge.uplift = 1e6;
    wedge.dilation = psi_wedge * degree;
    ChainInterface face;
    face.length = 8.0;
    face.friction = tan_deg(delta);
    face.dilation = psi_face * degree;
    chain.blocks = {body, wedge};
    chain.interfaces = {face};
    return chain;
}

/// Closed form of the level seam with one smooth wedge: P_p(F), then T = [μ(W - U) + c L]/F + P_p(F).
double closed_thrust(double factor)
{
    const double alpha = 25.0 * degree, phi = std::atan(tan_deg(40.0) / factor), length = 8.0 / std::sin(alpha);
    return 2e5 * 9.81 * std::tan(phi + alpha) +
           (100e3 * length * std::cos(phi) / factor - 1e6 * std::sin(phi)) / std::cos(phi + alpha);
}

/// Power of all forces with ψ = φ on all faces, per rate of the body: strengths c only, water and weight as they are. Its
/// zero is the upper bound of the yield.
double power_balance_yield(double delta)
{
    Chain chain = two_blocks(delta, std::atan(0.6) / degree, 40.0, delta);
    const auto movement = [](const ChainBlock& b) {
        return Point{std::cos(b.dip - b.dilation), -std::sin(b.dip - b.dilation)};
    };
    const Point v0 = movement(chain.blocks[0]), v1 = movement(chain.blocks[1]);
    // The jump at the vertical face leans up and away by δ.
    const double q = (v0.x + std::tan(delta * degree) * -v0.y) / (v1.x - std::tan(delta * degree) * v1.y);
    double power = 0.0, inertia = 0.0;
    const std::array<Point, 2> v{v0, Point{q * v1.x, q * v1.y}};
    for (std::size_t i = 0; i < 2; ++i) {
        const ChainBlock& b = chain.blocks[i];
        const Point n{std::sin(b.dip), std::cos(b.dip)}, t{std::cos(b.dip), -std::sin(b.dip)};
        power += v[i].x * (b.force.x + b.uplift * n.x) + v[i].y * (b.force.y - 9.81 * b.mass + b.uplift * n.y) -
                 b.cohesion * b.length * (v[i].x * t.x + v[i].y * t.y);
        inertia += b.mass * v[i].x;
    }
    return -power / inertia;
}

Checks chain_of_two()
{
    const Chain smooth = two_blocks(0.0);
    const ChainLaw law = chain_law(smooth);
    Chain body = smooth;
    body.blocks.resize(1);
    body.interfaces.clear();
    const double factor = chain_factor(smooth), total = 5.2e6, tangent = tan_deg(25.0) * tan_deg(65.0);
    Checks checks{
        {"F: thrust of the closed form at this F", "N/m", 22e6,
         0.6 * (5e6 * 9.81 - 15e6) / factor + closed_thrust(factor), 1e-12},
        {"F", "-", 1.192490221, factor, 1e-9},
        {"F without the wedge", "-", 0.6 * (5e6 * 9.81 - 15e6) / 22e6, chain_factor(body), 1e-12},
        {"a_y", "m/s²", (0.6 * (5e6 * 9.81 - 15e6) + closed_thrust(1.0) - 22e6) / total, law.yield(), 1e-12},
        {"factor", "-", total / (total + 2e5 * tangent), law.factor(), 1e-12},
        {"da_y/da_v", "-", 0.659404112, -law.per_a_v / law.drive, 1e-9},
        {"κ", "1/s²", 2650.0 * 9.81 * 8.0 * (tan_deg(65.0) - 0.6) / total, yield_growth(smooth, 2650.0), 1e-9},
        {"impact on the wedge", "-", 25.0 / 27.0, chain_law(body).mass / law.mass, 1e-12},
    };
    struct Printed {
        double delta, factor, yield, slip_factor, thrust;
    };
    for (const Printed& p : {Printed{10.0, 1.247235737, 1.366779986, 0.948416418, 9398.192921},
                             Printed{20.0, 1.325814349, 3.539452546, 0.889129365, 24650.489366}}) {
        const Chain chain = two_blocks(p.delta);
        const ChainLaw rough = chain_law(chain);
        const std::string name = fmt::format("δ {:g}°: ", p.delta);
        checks.push_back({name + "F", "-", p.factor, chain_factor(chain), 1e-9});
        checks.push_back({name + "a_y", "m/s²", p.yield, rough.yield(), 1e-9});
        checks.push_back({name + "a_y by the power balance with ψ = φ", "m/s²", power_balance_yield(p.delta), rough.yield(), 1e-12});
        checks.push_back({name + "factor", "-", p.slip_factor, rough.factor(), 1e-9});
        checks.push_back({name + "E at the yield", "kN/m", p.thrust,
                          1e-3 * chain_forces(chain, rough, rough.yield(), 0.0).thrust[0], 1e-9});
    }
    const ChainLaw dilating = chain_law(two_blocks(20.0, 5.0, 8.0)), all = chain_law(two_blocks(20.0, 5.0, 8.0, 4.0));
    checks.push_back({"ψ 5°, 8°: factor", "-", 0.823068848, dilating.factor(), 1e-9});
    checks.push_back({"ψ 4° at the face too: factor", "-", 0.814863470, all.factor(), 1e-9});
    checks.push_back({"ψ: the same a_y", "m/s²", chain_law(two_blocks(20.0)).yield(), all.yield(), 1e-12});
    return checks;
}

/// Equilibrium of each block while the chain slides, by the forces themselves.
Checks chain_in_equilibrium()
{
    Chain chain = two_blocks(15.0, 4.0, 6.0, 3.0);
    ChainBlock middle = chain.blocks[0];
    middle.dip = 4.0 * degree;
    middle.mass = 1e6;
    middle.force = {1e5, -2e5};
    middle.length = 12.0;
    middle.uplift = 2e6;
    middle.friction = 0.5;
    middle.added_mass = {2e5, -3e4, 1e4};
    chain.blocks.insert(chain.blocks.begin() + 1, middle);
    ChainInterface leaning;
    leaning.angle = 75.0 * degree;
    leaning.length = 9.0;
    leaning.friction = 0.3;
    leaning.cohesion = 2e4;
    leaning.water = 3e5;
    chain.interfaces.insert(chain.interfaces.begin(), leaning);
    const ChainLaw law = chain_law(chain);
    const double a_h = law.yield(0.4) + 1.3, a_v = 0.4, slip_accel = 1.3 * law.factor();
    const ChainForces f = chain_forces(chain, law, a_h, a_v, slip_accel);
    // What is left of the last block's equation along its segment; the others' are how the forces were found.
    const ChainBlock& last = chain.blocks[2];
    const ChainInterface& face = chain.interfaces[1];
    const double c = std::cos(last.dip), s = std::sin(last.dip), q = law.rates[2] * slip_accel;
    const double ax = -a_h + q * std::cos(last.dip - last.dilation), ay = a_v - q * std::sin(last.dip - last.dilation);
    const double e = f.thrust[1] + face.water;
    const double along = last.mass * (c * ax - s * ay) -
                         (s * last.mass * 9.81 - f.resistance[2] + c * e + s * f.shear[1]);
    Chain one = chain;
    one.blocks = {chain.blocks[0], chain.blocks[0]};
    one.blocks[0].length = one.blocks[1].length = 0.5;
    for (ChainBlock& b : one.blocks) b.mass *= 0.5, b.force.x *= 0.5, b.uplift *= 0.5, b.cohesion = 5e4, b.dilation = 0.0;
    one.interfaces = {ChainInterface{}};
    Chain whole = one;
    whole.blocks.resize(1);
    whole.interfaces.clear();
    ChainBlock& b = whole.blocks[0];
    b.mass *= 2.0, b.force.x *= 2.0, b.uplift *= 2.0, b.length = 1.0;
    return {
        {"what is left of the last block's equation, over its weight", "-", 0.0, along / (last.mass * 9.81), 1e-12,
         Measure::absolute},
        {"straight plane cut in two: F", "-", chain_factor(whole), chain_factor(one), 1e-12},
        {"straight plane cut in two: a_y", "m/s²", chain_law(whole).yield(), chain_law(one).yield(), 1e-12},
        {"straight plane cut in two: factor", "-", chain_law(whole).factor(), chain_law(one).factor(), 1e-12},
    };
}

/// Strip load on cohesive ground: three equilateral blocks, 10 c/√3, and two right isosceles ones, 6 c.
Checks strip_load()
{
    const auto least_load = [](const std::vector<double>& dips, const std::vector<double>& faces) {
        Chain chain;
        for (const double dip : dips) {
            ChainBlock block;
            block.dip = dip * degree;
            block.length = 1.0;
            block.mass = 0.0;
            block.cohesion = 1.0;
            chain.blocks.push_back(block);
        }
        for (const double angle : faces) {
            ChainInterface face;
            face.angle = angle * degree;
            face.length = 1.0;
            face.cohesion = 1.0;
            chain.interfaces.push_back(face);
        }
        return chain;
    };
    // Widths: the load stands on the first block, of side 1.
    const auto limit = [](Chain chain, double width) {
        ChainLaw law = chain_law(chain);
        return law.constant / law.weights[0].y / width;
    };
    Chain three = least_load({60.0, 0.0, -60.0}, {60.0, 120.0});
    Chain two = least_load({45.0, -45.0}, {90.0});
    two.blocks[0].length = two.blocks[1].length = std::sqrt(2.0);
    return {
        {"three equilateral blocks", "c", 10.0 / std::sqrt(3.0), limit(three, 1.0), 1e-12},
        {"two right isosceles blocks", "c", 6.0, limit(two, 1.0), 1e-12},
    };
}

/// The dam of exact::seam_scene(); with friction in the interface.
Scene dam_on_seam(double delta = 0.0)
{
    Scene scene = exact::seam_scene();
    if (delta > 0.0) scene.seams[0].interface = {InterfaceModel::friction, std::nullopt, tan_deg(delta), 0.0};
    return scene;
}

SeamPlane plane_of(const Scene& scene)
{
    return seam_plane(scene, scene.seams[0], {{"static"}});
}

Checks seam_and_wedge()
{
    Scene scene = dam_on_seam();
    const SeamPlane given = plane_of(scene), rough = plane_of(dam_on_seam(20.0));
    Scene searched = scene;
    searched.seams[0].wedge->angles.clear();
    const SeamPlane best = plane_of(searched);
    Scene searched_rough = dam_on_seam(20.0);
    searched_rough.seams[0].wedge->angles.clear();
    searched_rough.seams[0].wedge->search_from = 5.0 * degree;
    const SeamPlane best_rough = plane_of(searched_rough);
    Scene bare = scene;
    bare.seams[0].wedge.reset();
    bare.seams[0].exit = SeamExit::free_face;
    const SeamPlane open = plane_of(bare);
    Scene undrained = scene;
    undrained.seams[0].uplift = UpliftModel::linear;
    const auto status = [&](double angle) {
        undrained.seams[0].wedge->angles = {angle * degree};
        return plane_of(undrained).trials[0].statuses[0] == ChainStatus::stands ? 1.0 : 0.0;
    };
    return {
        {"F", "-", 1.240163734, given.factors[0].factor, 1e-9},
        {"a_y", "m/s²", 0.799915098, given.yield, 1e-8},
        {"δ 20°: F", "-", 1.275100518, rough.factors[0].factor, 1e-9},
        {"δ 20°: a_y", "m/s²", 1.243300392, rough.yield, 1e-8},
        {"free face: F", "-", 1.187663694, open.factors[0].factor, 1e-9},
        {"free face: a_y", "m/s²", 0.638460430, open.yield, 1e-8},
        {"μ that just holds", "-", 0.554957019, given.holding_friction, 1e-8},
        {"searched: F", "-", 1.235701938, best.factors[0].factor, 1e-9},
        {"searched: angle", "deg", 13.0894, best.factors[0].angle.value_or(0.0) / degree, 1e-4, Measure::absolute},
        {"searched, δ 20°: F", "-", 1.246172901, best_rough.factors[0].factor, 1e-9},
        {"searched, δ 20°: angle", "deg", 7.9802, best_rough.factors[0].angle.value_or(0.0) / degree, 1e-4, Measure::absolute},
        {"no drains: stands at 43.8°", "-", 0.0, status(43.8), 0.0, Measure::absolute},
        {"no drains: stands at 44°", "-", 1.0, status(44.0), 0.0, Measure::absolute},
        {"shares of the resistance", "-", 1.0, rough.shares[0] + rough.shares[1] + rough.shares[2], 1e-12},
    };
}

/// Triangle of 3 m/s² over 2 x 0.3 s against a_y 1 m/s², with a factor of 0.9.
Checks slip_under_triangle()
{
    RigidBlock block;
    block.mass = 0.9;
    block.chain_mass = 0.1;
    block.friction = 1.0 / block.gravity;
    GroundMotion triangle;
    triangle.dt = 0.3;
    triangle.accel_h = {0.0, 3.0, 0.0, 0.0, 0.0};
    return {{"slip", "mm", 161.625, 1e3 * slide(triangle, block).max_slip, 1e-12}};
}

Checks lift_checks()
{
    Scene scene = exact::reference_scene(exact::ReferenceUplift::none, 0.77);
    scene.added_mass.formula = AddedMassFormula::westergaard;
    Lifts& lifts = scene.lifts.emplace();
    lifts.elevations = {30.0};
    lifts.bonded = true;
    lifts.strength.friction = 0.7;
    lifts.strength.bond.tensile_strength = 1e6;
    const std::vector<GroundState> states{{"static"}, {"k_h 0.2", 0.2 * 9.80665}};
    const LiftPlane whole = lift_planes(scene, states)[0];
    Scene cracked = scene;
    cracked.lifts->strength.bond.tensile_strength = 0.0;
    cracked.uplift.emplace().crack = CrackRule::seismic_full;
    const LiftState open = lift_planes(cracked, states)[0].states[1];
    Scene cohesive = scene;
    cohesive.lifts->strength.cohesion = 500e3;
    Scene drained = scene;
    drained.lifts->uplift = LiftUplift::drains;
    drained.lifts->drains_distance = 3.0;
    drained.lifts->drains_efficiency = 0.67;
    Scene wall = exact::bare_scene({{0, 0}, {10, 0}, {10, 60}, {0, 60}});
    wall.lifts = lifts;
    wall.lifts->elevations = {24.0};
    wall.lifts->uplift = LiftUplift::none;
    wall.lifts->amplification = Amplification::power;
    wall.lifts->crest_amplification = 3.0;
    const LiftPlane amplified = lift_planes(wall, states)[0];
    // Mean of 1 + 2 (y/60)^1.5 over 24 ... 60, and its arm above the joint.
    const double r = 0.4, mean = 1.0 + 2.0 / 2.5 * (1.0 - std::pow(r, 2.5)) / (1.0 - r);
    const double moment = 0.5 * (1.0 - r * r) + 2.0 / 3.5 * (1.0 - std::pow(r, 3.5));
    const double arm = 60.0 * moment / ((1.0 - r) * mean) - 24.0;
    const LiftState& shaken = amplified.states[1];
    return {
        {"N'", "kN/m", 9087.76256, 1e-3 * whole.states[0].normal, 1e-9},
        {"F", "-", 1.22786121, whole.states[0].factor, 1e-8},
        {"heel", "kPa", 159.785738, 1e-3 * whole.states[0].heel_stress, 1e-8},
        {"toe", "kPa", 545.328796, 1e-3 * whole.states[0].toe_stress, 1e-8},
        {"a_y", "m/s²", 0.549726127, whole.yield, 1e-8},
        {"k_h 0.2: F", "-", 0.677264926, whole.states[1].factor, 2e-8},
        {"k_h 0.2: heel", "kPa", -343.494778, 1e-3 * whole.states[1].heel_stress, 5e-8},
        {"k_h 0.2, full head in the crack: its length", "m", 22.9210495, open.base.crack.length, 5e-8},
        {"k_h 0.2, full head in the crack: F", "-", 0.404958127, open.factor, 5e-8},
        {"k_h 0.2, c 500 kPa: F", "-", 2.04941268, lift_planes(cohesive, states)[0].states[1].factor, 1e-8},
        {"drains at 3 m, E 0.67: F", "-", 1.55654649, lift_planes(drained, states)[0].states[0].factor, 1e-8},
        {"wall: Ā", "-", mean, amplified.mean_amplification, 1e-9},
        {"wall: A/Ā", "-", (1.0 + 2.0 * std::pow(r, 1.5)) / mean,
         amplified.joint_amplification / amplified.mean_amplification, 1e-9},
        {"wall: arm", "m", arm, (shaken.toe_stress - shaken.heel_stress) * 100.0 / 12.0 / shaken.shear, 1e-9},
    };
}

/// An undamped mode of 4 Hz, Γψ 1.2, under 2 m/s² for two of its periods: a_J = 2 - 2.4 cos ωt, then nothing; a_y 2.5 m/s².
Checks slip_in_two_steps()
{
    constexpr double omega = 8.0 * std::numbers::pi, yield = 2.5, end = 0.5;
    // Slip rate since it began at t: the block slides where it is positive.
    const auto rate = [&](double from, double t) {
        return (2.0 - yield) * (t - from) - 2.4 / omega * (std::sin(omega * t) - std::sin(omega * from));
    };
    const auto slip = [&](double from, double t) {
        return 0.5 * (2.0 - yield) * (t - from) * (t - from) +
               2.4 / omega * ((std::cos(omega * t) - std::cos(omega * from)) / omega + std::sin(omega * from) * (t - from));
    };
    double exact = 0.0, earliest = 0.0;
    for (double from = std::acos(-0.5 / 2.4) / omega; from < end; from += 0.25) {
        if (from < earliest) continue; // it slides
        double low = from + 1e-3, high = end;
        if (rate(from, end) > 0.0) {
            exact += slip(from, end) + 0.5 * rate(from, end) * rate(from, end) / yield;
            break;
        }
        for (int i = 0; i < 100; ++i) (rate(from, 0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
        exact += slip(from, low);
        earliest = low;
    }
    const ModalShares none{{0.0}, 0.0};
    const PlaceShares place{{{1.2}, -0.2}, none, none, none};
    const TiedPart part{{{4.0, 0.0}}, place, place};
    GroundMotion ground;
    ground.dt = 0.005;
    ground.accel_h.assign(101, 2.0);
    const GroundMotion joint = joint_motions(ground, part, 500, 0.0).joint;
    RigidBlock block;
    block.mass = 1.0;
    block.friction = yield / block.gravity;
    return {{"slip", "mm", 1e3 * exact, 1e3 * slide(joint, block).max_slip, 1e-8},
            {"slip, printed", "mm", 26.604686, 1e3 * slide(joint, block).max_slip, 1e-7}};
}

/// The base as a chain of one block against the rigid block, level and dipping.
Checks base_as_chain()
{
    Checks checks;
    for (const double dip : {0.0, 6.0}) {
        Chain chain = two_blocks(0.0);
        chain.blocks.resize(1);
        chain.interfaces.clear();
        ChainBlock& b = chain.blocks[0];
        b.dip = dip * degree;
        b.friction = 0.77;
        b.cohesion = 1e5;
        b.length = 40.0;
        b.added_mass = {6e5, -1e5, 2e4};
        b.force = {1.2e7, -3e6};
        RigidBlock block;
        block.mass = b.mass;
        block.added_mass = b.added_mass;
        block.gravity = chain.gravity;
        block.horizontal_force = b.force.x;
        block.vertical_force = -b.force.y;
        block.uplift = b.uplift;
        block.cohesion_force = 4e6;
        block.friction = b.friction;
        block.base_inclination = b.dip;
        const Yield yield = yield_downstream(block), of_chain = yield_downstream(chain_block(chain, chain_law(chain)));
        const std::string name = fmt::format("dip {:g}°: ", dip);
        checks.push_back({name + "a_y", "m/s²", yield.law.constant, of_chain.law.constant, 1e-12});
        checks.push_back({name + "da_y/da_v", "-", yield.law.per_a_v, of_chain.law.per_a_v, 1e-12});
        checks.push_back({name + "factor", "-", yield.factor, of_chain.factor, 1e-12});
    }
    return checks;
}

} // namespace

void add_plane_cases(Registry& registry)
{
    registry.push_back({"sliding.planes.passive-thrust",
                        "Thrust of a wall on the ground in front of it, the least over the angle of the wedge.",
                        "Rankine (1857), Coulomb (1776), Mononobe & Okabe; with still water W' tan(φ + α) + γ_w d²/2",
                        "closed coefficients: round-off of a least value; angles printed to 8 digits", passive_thrust});
    registry.push_back({"sliding.planes.two-blocks",
                        "Factor of safety, yield, motion and impact of a body that pushes a wedge up a plane.",
                        "closed form of a level seam with a smooth wedge; power balance of the associated mechanism "
                        "(Donald & Chen 1997); digits by a system of 2 n linear equations",
                        "closed forms: round-off; printed digits: half a unit of the last", chain_of_two});
    registry.push_back({"sliding.planes.equilibrium",
                        "Forces between three blocks that slide, with dilation, leaning faces and water; a plane cut in two.",
                        "Newton's law of each block; the plane as one", "round-off", chain_in_equilibrium});
    registry.push_back({"sliding.planes.strip-load", "Limit load of a strip on cohesive ground by rigid blocks.",
                        "10 c/√3 for three equilateral blocks, 6 c for two right isosceles ones", "round-off", strip_load});
    registry.push_back({"sliding.planes.base", "The base as a chain of one block.", "the rigid block", "round-off", base_as_chain});
    registry.push_back({"sliding.planes.seam",
                        "A dam on a drained seam with a wedge in front of its toe: factors, yields, searched angles.",
                        "digits by an independent solution of the 2 n equations with the geometry of the scene",
                        "half a unit of the last printed digit", seam_and_wedge});
    registry.push_back({"sliding.planes.triangle", "Slip of a chain, whose H/M* is not 1, under a triangle.", "closed form",
                        "round-off", slip_under_triangle});
    registry.push_back({"sliding.planes.two-steps", "Slip on a joint under its motion in a bonded dam of one undamped mode.",
                        "closed form between start and stop", "linear between 50,000 steps: (ω h)²/12 = 5e-9",
                        slip_in_two_steps});
    registry.push_back({"sliding.planes.lifts", "A lift joint: forces, stresses, crack, drains; a wall that amplifies.",
                        "beam theory with the whole reservoir's added mass; integrals of (y/H)^n",
                        "printed digits; the printed added mass is a sum cut off, 2e-8", lift_checks});
}

} // namespace damslip::verification
