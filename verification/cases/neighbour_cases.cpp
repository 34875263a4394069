#include "core/units.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "sliding/flexible/flexible_mode.hpp"
#include "sliding/wedge/wedge.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/flexible_slip.hpp"
#include "verification/exact/plane_failure.hpp"
#include "verification/exact/reference_scene.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;

constexpr double degree = std::numbers::pi / 180.0;

/// The scene of a rock slope with water in its crack, as the scene file fills it in.
Scene slope_scene(const RockSlope& slope, const exact::PlaneFailure& p)
{
    Scene scene = exact::bare_scene(sliding_block(slope), p.unit_weight / 9.81);
    scene.contact.friction = std::tan(p.friction_angle);
    scene.contact.cohesion = p.cohesion;
    if (p.water_depth > 0.0) {
        scene.reservoir = Reservoir{};
        scene.reservoir->level = p.water_depth;
        scene.reservoir->model = ReservoirModel::hydrostatic;
        scene.uplift.emplace().model = UpliftModel::linear;
    }
    return scene;
}

double sliding_factor(const Scene& scene, double k)
{
    Combination c;
    c.name = "case";
    c.crack = CrackRule::none;
    c.k_h = k * 9.81 / units::standard_gravity;
    return evaluate(scene, c, {}).sliding_factor;
}

/// The exercise of Wyllie & Mah: H 12 m, 60 deg, plane 35 deg, crack 4 m behind the crest, 3 m of water.
std::vector<damslip::verification::Check> plane_failure_exercise()
{
    const RockSlope slope{12.0, 60 * degree, 35 * degree, 4.0, 0.0};
    exact::PlaneFailure p;
    p.height = 12.0;
    p.face_dip = 60 * degree;
    p.plane_dip = 35 * degree;
    p.crack_depth = crack_depth(slope);
    p.water_depth = 3.0;
    p.unit_weight = 26e3;
    p.cohesion = 25e3;
    p.friction_angle = 37 * degree;
    const Scene scene = slope_scene(slope, p);
    const RigidBlock block = make_rigid_block(scene);
    return {{"depth of the crack, printed", "m", 4.35, crack_depth(slope), 5e-3, Measure::absolute},
            {"area of the plane, printed", "m²/m", 13.34, base_length(scene.section), 5e-3, Measure::absolute},
            {"weight", "N/m", plane_weight(p), block.mass * 9.81, 1e-14},
            {"U on the plane", "N/m", plane_uplift(p), block.uplift, 1e-14},
            {"V in the crack", "N/m", crack_thrust(p), block.horizontal_force, 1e-14},
            {"factor of safety, printed", "–", 1.25, sliding_factor(scene, 0.0), 5e-3, Measure::absolute},
            {"factor of safety", "–", plane_factor(p), sliding_factor(scene, 0.0), 1e-13},
            {"factor with 0.08 W out of the slope", "–", plane_factor(p, 0.08), sliding_factor(scene, 0.08), 1e-13},
            {"yield acceleration", "m/s²", 9.81 * plane_yield_coefficient(p), yield_acceleration(block), 1e-12}};
}

/// Crack in the face, at the crest and behind it, wet and dry, over dips.
std::vector<damslip::verification::Check> plane_failure_range()
{
    std::vector<damslip::verification::Check> checks;
    for (const double distance : {-6.0, 0.0, 11.0})
        for (const double plane : {22.0, 40.0})
            for (const double fill : {0.0, 0.7}) {
                const RockSlope slope{40.0, 65 * degree, plane * degree, distance, 0.0};
                exact::PlaneFailure p;
                p.height = slope.height;
                p.face_dip = slope.face_dip;
                p.plane_dip = slope.plane_dip;
                p.crack_depth = crack_depth(slope);
                p.crack_in_face = distance < 0.0;
                if (p.crack_in_face) // there the printed z goes from the level of the crest to the foot of the crack
                    p.crack_depth = 40.0 - (40.0 / std::tan(slope.face_dip) + distance) * std::tan(slope.plane_dip);
                p.water_depth = fill * crack_depth(slope);
                p.unit_weight = 25e3;
                p.cohesion = 60e3;
                p.friction_angle = 33 * degree;
                const Scene scene = slope_scene(slope, p);
                checks.push_back({"weight", "N/m", plane_weight(p), make_rigid_block(scene).mass * 9.81, 1e-13});
                checks.push_back({"factor of safety", "–", plane_factor(p), sliding_factor(scene, 0.0), 1e-12});
            }
    return checks;
}

/// Mass 1 on a level base, g = 10 m/s^2.
SlipStages level_block(double yield)
{
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    block.friction = 0.1 * yield;
    return {{0.0, block, 0.0}};
}

FlexibleBlock flexible(double period, double damping, double mass_ratio)
{
    FlexibleBlock block;
    block.period = period;
    block.damping_ratio = damping;
    block.mass_ratio = mass_ratio;
    return block;
}

GroundMotion sampled(const std::function<double(double)>& accel, double dt, int n)
{
    GroundMotion motion;
    motion.dt = dt;
    for (int k = 0; k <= n; ++k) motion.accel_h.push_back(accel(k * dt));
    return motion;
}

/// Amplitude 3 m/s^2, 1.5 Hz, growing and fading within 4 s; at rest from then on.
double wave(double t)
{
    return t < 4.0 ? 3.0 * std::pow(std::sin(std::numbers::pi * t / 4.0), 2) * std::sin(3.0 * std::numbers::pi * t)
                   : 0.0;
}

/// One push of 3 m/s^2 within 0.8 s; steepest 3.75 pi m/s^3.
double pulse(double t)
{
    return t < 0.8 ? 3.0 * std::pow(std::sin(std::numbers::pi * t / 0.8), 2) : 0.0;
}

std::vector<damslip::verification::Check> flexible_step()
{
    std::vector<damslip::verification::Check> checks;
    SlideOptions options;
    options.sliding.run_out_max = 0.0;
    for (const double gamma : {0.3, 0.8}) {
        const double A = 6.0;
        const GroundMotion steady = sampled([=](double) { return A; }, 0.01, 100);
        const exact::FlexibleSlipCase c{2.0 * std::numbers::pi / 0.4, 0.0, gamma, 1.0};
        const FlexibleSlide coupled = slide_coupled(steady, level_block(1.0), flexible(0.4, 0.0, gamma), options);
        checks.push_back({"coupled slip after 1 s", "m", exact::slip_under_step(c, A, 1.0), coupled.slide.slip, 1e-12});
        // Without slip x = A/omega^2 (1 - cos omega t): k = A (1 - Gamma cos omega t), largest at half a period.
        checks.push_back(
            {"peak of the average acceleration without slip", "m/s²", A * (1.0 + gamma),
             slide_decoupled(steady, level_block(20.0), flexible(0.4, 0.0, gamma), options).peak_acceleration, 1e-12});
    }
    return checks;
}

std::vector<damslip::verification::Check> flexible_impulses()
{
    std::vector<damslip::verification::Check> checks;
    for (const auto& [period, damping, gamma] :
         {std::array{0.3, 0.05, 0.81}, std::array{0.7, 0.15, 0.6}, std::array{1.5, 0.05, 0.4}}) {
        const exact::FlexibleSlipCase c{2.0 * std::numbers::pi / period, damping, gamma, 0.9};
        SlideOptions options;
        options.sliding.run_out_max = 0.0;
        const FlexibleSlide coupled =
            slide_coupled(sampled(wave, 0.0025, 2400), level_block(0.9), flexible(period, damping, gamma), options);
        checks.push_back({"coupled slip, T = " + std::to_string(period).substr(0, 3) + " s", "m",
                          exact::slip_by_impulses(c, wave, 6.0, 1e-5), coupled.slide.slip, 1e-4, Measure::absolute});
        checks.push_back({"the same, moved in all", "m", coupled.slide.downstream_slip - coupled.slide.upstream_slip,
                          coupled.slide.slip, 1e-14, Measure::absolute});
    }
    return checks;
}

std::vector<damslip::verification::Check> flexible_limits()
{
    std::vector<damslip::verification::Check> checks;
    const GroundMotion push = sampled(pulse, 0.01, 150);
    const double rigid = slide(push, level_block(0.9)).slip;
    double before = 0.0;
    for (const double period : {0.04, 0.02}) {
        const FlexibleBlock block = flexible(period, 0.05, 0.81);
        const double omega = 2.0 * std::numbers::pi / period;
        const double bound = 0.81 * (2.0 * 3.0 + 3.75 * std::numbers::pi * 1.0) / (omega * omega);
        const std::string at = ", T = " + std::to_string(period).substr(0, 4) + " s";
        const double coupled = slide_coupled(push, level_block(0.9), block).slide.slip;
        checks.push_back({"coupled against rigid" + at, "m", rigid, coupled, bound, Measure::absolute});
        checks.push_back({"decoupled against rigid" + at, "m", rigid,
                          slide_decoupled(push, level_block(0.9), block).slide.slip, bound, Measure::absolute});
        if (before != 0.0)
            checks.push_back({"difference over that of half the period", "–", 4.0, before / (coupled - rigid), 0.05});
        before = coupled - rigid;
    }
    const GroundMotion motion = sampled(wave, 0.01, 600);
    const FlexibleBlock block = flexible(0.5, 0.05, 0.81);
    const double peak = slide_decoupled(motion, level_block(50.0), block).peak_acceleration;
    checks.push_back({"slip below the yield, coupled", "m", 0.0,
                      slide_coupled(motion, level_block(1.001 * peak), block).slide.max_slip, 0.0, Measure::absolute});
    checks.push_back({"slip below the yield, decoupled", "m", 0.0,
                      slide_decoupled(motion, level_block(1.001 * peak), block).slide.max_slip, 0.0,
                      Measure::absolute});
    checks.push_back({"peak acceleration below the yield, coupled", "m/s²", peak,
                      slide_coupled(motion, level_block(50.0), block).peak_acceleration, 2e-3});
    const FlexibleSlide at_peak = slide_coupled(motion, level_block(0.99 * peak), block);
    const double slides = at_peak.slide.max_slip;
    checks.push_back(
        {"a sliding mass gets no more than the yield", "m/s²", 0.99 * peak, at_peak.peak_acceleration, 1e-9});
    checks.push_back({"slip just above it, coupled", "m", 0.0, slides, 0.0, Measure::lower_bound});
    return checks;
}

/// A wave whose samples are far apart for it: what lies between them counts.
double short_wave(double t)
{
    return t < 4.0 ? 2.0 * std::pow(std::sin(std::numbers::pi * t / 4.0), 2) * std::sin(7.0 * std::numbers::pi * t)
                   : 0.0;
}

std::vector<damslip::verification::Check> flexible_decoupled()
{
    std::vector<damslip::verification::Check> checks;
    SlideOptions options;
    options.sliding.two_way = false;
    for (const auto& [period, damping, yield] :
         {std::array{0.05, 0.05, 1.0}, std::array{0.3, 0.05, 1.9}, std::array{0.3, 0.05, 3.4},
          std::array{1.2, 0.15, 0.25}, std::array{6.0, 0.15, 0.3}}) {
        const GroundMotion motion = sampled(short_wave, 0.02, 200);
        const double gamma = 0.81;
        const FlexibleSlide r = slide_decoupled(motion, level_block(yield), flexible(period, damping, gamma), options);
        const exact::FlexibleSlipCase c{2.0 * std::numbers::pi / period, damping, gamma, yield};
        checks.push_back({"slip, T = " + std::to_string(period).substr(0, 4) + " s", "m",
                          exact::slip_decoupled_by_steps(c, motion.accel_h, motion.dt, 60.0, 128.0), r.slide.slip,
                          1e-6});
    }
    return checks;
}

/// T -> infinity: the mode stays where it is, k = (1 - Gamma) a_h.
std::vector<damslip::verification::Check> flexible_soft()
{
    std::vector<damslip::verification::Check> checks;
    const double gamma = 0.6, yield = 0.4;
    const GroundMotion motion = sampled(wave, 0.01, 600);
    const double rest = 1.0 - gamma, slip = slide(motion, level_block(yield / rest)).max_slip;
    for (const double period : {100.0, 1e4}) {
        const FlexibleBlock block = flexible(period, 0.05, gamma);
        const std::string at = period > 100.0 ? ", T = 10000 s" : ", T = 100 s";
        const double tolerance = 40.0 / period;
        checks.push_back(
            {"coupled" + at, "m", slip, slide_coupled(motion, level_block(yield), block).slide.max_slip, tolerance});
        checks.push_back({"decoupled" + at, "m", rest * slip,
                          slide_decoupled(motion, level_block(yield), block).slide.max_slip, tolerance});
    }
    return checks;
}

/// Energies per mass of the block, by trapezoids over the samples.
std::vector<damslip::verification::Check> flexible_energy()
{
    const double dt = 0.0005, yield = 0.9, zeta = 0.05, gamma = 0.81, omega = 2.0 * std::numbers::pi / 0.4;
    const GroundMotion motion = sampled(wave, dt, 10000);
    SlideOptions options;
    options.history = HistoryOutput::samples;
    options.sliding.run_out_max = 0.0;
    const FlexibleSlide r = slide_coupled(motion, level_block(yield), flexible(0.4, zeta, gamma), options);
    const auto& w = r.slide.history.slip_rate;
    const auto& u = r.deflection_rate;
    double input = 0.0, damping = 0.0;
    for (std::size_t k = 0; k + 1 < w.size(); ++k)
        for (const std::size_t i : {k, k + 1}) {
            input += 0.5 * dt * motion.accel_h[i] * (w[i] + gamma * u[i]);
            damping += 0.5 * dt * 2.0 * zeta * omega * gamma * u[i] * u[i];
        }
    const double x = r.deflection.back();
    const double stored = 0.5 * w.back() * w.back() + gamma * w.back() * u.back() + 0.5 * gamma * u.back() * u.back() +
                          0.5 * gamma * omega * omega * x * x;
    const double friction = yield * (r.slide.downstream_slip + r.slide.upstream_slip);
    return {{"friction, damping and stored energy", "J/kg", input, friction + damping + stored, 1e-5},
            {"share of friction", "–", 0.3, friction / input, 0.0, Measure::lower_bound}};
}

Wedge wedge_of(double dip_1, double direction_1, double phi_1, double dip_2, double direction_2, double phi_2)
{
    Wedge w;
    w.mass = 1e5;
    w.first = {dip_1 * degree, direction_1 * degree, 10.0, std::tan(phi_1 * degree), 0.0, 0.0};
    w.second = {dip_2 * degree, direction_2 * degree, 10.0, std::tan(phi_2 * degree), 0.0, 0.0};
    return w;
}

/// Planes that mirror each other about the vertical plane through north: the line plunges psi to the north, the angle
/// between the planes is xi, beta = 90 degrees.
std::vector<damslip::verification::Check> symmetric_wedge()
{
    std::vector<damslip::verification::Check> checks;
    for (const double dip : {45.0, 65.0})
        for (const double turn : {35.0, 60.0}) {
            const double phi = 32.0 * degree, d = dip * degree, t = turn * degree;
            const Wedge w = wedge_of(dip, turn, 32.0, dip, -turn, 32.0);
            const double psi = std::atan(std::tan(d) * std::cos(t));
            const double cos_xi = -(std::sin(d) * std::sin(d) * std::cos(2.0 * t) + std::cos(d) * std::cos(d));
            const double sin_half = std::sqrt(0.5 * (1.0 - cos_xi));
            checks.push_back({"factor of safety", "–", std::tan(phi) / std::tan(psi) / sin_half,
                              wedge_state(w).factor_of_safety, 1e-13});
            // In its plane of symmetry it is a block on a plane with tan phi_e = tan phi / sin(xi/2).
            const double phi_e = std::atan(std::tan(phi) / sin_half);
            if (phi_e <= psi) continue;
            const WedgeYield y = wedge_yield(w, {0.0, 1.0, 0.0});
            checks.push_back({"yield acceleration", "m/s²", 9.81 * std::tan(phi_e - psi), y.acceleration, 1e-12});
            checks.push_back(
                {"slip acceleration per excess", "–", std::cos(phi_e - psi) / std::cos(phi_e), y.factor, 1e-12});
        }
    return checks;
}

std::vector<damslip::verification::Check> wedge_modes()
{
    // Printed for planes 45/105 and 70/235: N_A sin-ratio A = (cos psi_a - cos psi_b cos theta)/(sin psi_5 sin^2 theta).
    const WedgeState both = wedge_state(wedge_of(45, 105, 20, 70, 235, 30));
    std::vector<damslip::verification::Check> checks{
        {"both planes: mode", "–", 0.0, static_cast<double>(both.mode), 0.0, Measure::absolute},
        {"both planes: N_A over the drive", "–", 1.5475, both.first_normal / both.drive, 5e-3},
        {"both planes: plunge of the line", "°", 31.2, std::asin(-both.direction[2]) / degree, 0.05,
         Measure::absolute}};
    // Dipping much the same way, it slides on the flatter plane, away from the steeper one; the other way round it would
    // go through the flatter one.
    const Wedge one = wedge_of(60, 20, 40, 25, 0, 40);
    const WedgeState alone = wedge_state(one);
    checks.push_back({"second plane only: mode", "–", 2.0, static_cast<double>(alone.mode), 0.0, Measure::absolute});
    checks.push_back({"second plane only: factor", "–", std::tan(40 * degree) / std::tan(25 * degree),
                      alone.factor_of_safety, 1e-13});
    const Wedge stands = wedge_of(25, 0, 40, 10, 180, 40);
    const Wedge first = wedge_of(30, 0, 40, 60, 20, 40);
    checks.push_back(
        {"first plane only: mode", "–", 1.0, static_cast<double>(wedge_state(first).mode), 0.0, Measure::absolute});
    RigidBlock block;
    block.mass = first.mass;
    block.friction = first.first.friction;
    block.base_inclination = 30 * degree;
    const WedgeYield yield = wedge_yield(first, {0.0, 1.0, 0.0});
    checks.push_back({"first plane only: a_y", "m/s²", 9.81 * std::tan(10 * degree), yield.acceleration, 1e-12});
    const GroundMotion motion = sampled(pulse, 0.01, 150);
    checks.push_back({"first plane only: slip, against the rigid block", "m", slide(motion, block).slip,
                      slide_wedge(motion, yield).slip, 1e-10});
    Wedge floats = stands;
    floats.first.water_force = floats.second.water_force = floats.mass * 9.81;
    checks.push_back({"water on both planes lifts: mode", "–", 3.0, static_cast<double>(wedge_state(floats).mode), 0.0,
                      Measure::absolute});
    checks.push_back({"its factor of safety", "–", 0.0, wedge_state(floats).factor_of_safety, 0.0, Measure::absolute});
    // Exchanging the planes exchanges the names.
    Wedge a = wedge_of(45, 105, 20, 70, 235, 30), b = a;
    a.first.water_force = b.second.water_force = 2e5;
    std::swap(b.first, b.second);
    b.second.water_force = 2e5;
    b.first.water_force = 0.0;
    checks.push_back(
        {"planes exchanged: factor", "–", wedge_state(a).factor_of_safety, wedge_state(b).factor_of_safety, 1e-13});
    return checks;
}

} // namespace

void add_neighbour_cases(Registry& registry)
{
    registry.push_back(
        {"sliding.neighbours.plane-failure",
         "Plane failure with a water-filled tension crack: forces, factor of safety, yield acceleration.",
         "exercise of Wyllie & Mah (2004), Rock Slope Engineering, ch. 6, by the formulas of Hoek & Bray "
         "(1981), ch. 7 (verification/exact/plane_failure.hpp)",
         "printed values to their digits; formulas to round-off, a_y amplified by the difference of forces",
         plane_failure_exercise});
    registry.push_back({"sliding.neighbours.plane-failure-range",
                        "Crack in the face, at the crest and behind it, wet and dry: weight and factor of safety.",
                        "Hoek & Bray (1981), ch. 7", "round-off", plane_failure_range});
    registry.push_back({"sliding.neighbours.symmetric-wedge",
                        "Wedge on two equal planes: factor of safety, yield acceleration, slip acceleration.",
                        "Hoek & Bray (1981), ch. 8: FS = tan phi/tan psi sin beta/sin(xi/2); Newmark (1965) with that "
                        "friction in the plane of symmetry",
                        "round-off", symmetric_wedge});
    registry.push_back(
        {"sliding.neighbours.wedge-modes",
         "The way of sliding is found: both planes, either alone, lifting; slip against the rigid block.",
         "planes of the example of Hoek & Bray (1981), ch. 8 (45/105 and 70/235: A = 1.5475, plunge "
         "31.2 deg); a block on one plane",
         "the printed A comes from angles rounded to 0.1 and 1 degree: 0.5 %; round-off", wedge_modes});
    registry.push_back({"sliding.neighbours.flexible-step",
                        "Flexible block under a sudden steady acceleration: coupled slip, response without slip.",
                        "closed forms (verification/exact/flexible_slip.hpp)", "round-off", flexible_step});
    registry.push_back({"sliding.neighbours.flexible-impulses",
                        "Coupled slip with starts, stops and reversals against a time-stepping scheme without events.",
                        "Moreau (1999), Comput. Methods Appl. Mech. Eng. 177; step 1e-5 s",
                        "the scheme is of first order: step x peak rate (about 0.5 m/s) x a few reversals, 2e-5 m, and "
                        "samples 2.5 ms apart of a 1.5 Hz wave, (omega dt)^2/12 = 5e-5 of it",
                        flexible_impulses});
    registry.push_back({"sliding.neighbours.flexible-limits",
                        "Stiff: the rigid block; never above its yield: no slip, coupled and decoupled alike.",
                        "definition; k - a_h = -Gamma x'' integrated twice over a slip of duration D changes it by "
                        "Gamma (x - x_0 - x_0' D), with x = A/omega^2, x_0' = A'/omega^2 of slow motion",
                        "Gamma (2 A + A' D)/omega^2 with D = 1 s, of second order in T (next order: 5 % of the ratio); "
                        "peaks of coupled seen at looks T sqrt(1 - Gamma)/40 apart",
                        flexible_limits});
    registry.push_back(
        {"sliding.neighbours.flexible-decoupled",
         "Decoupled slip of stiff and soft blocks, with a yield far below and near the peak, against small "
         "steps.",
         "Runge-Kutta of fourth order and cubics between its steps (verification/exact/flexible_slip.hpp)",
         "events within 1e-6 of k; the steps: 4e-12", flexible_decoupled});
    registry.push_back(
        {"sliding.neighbours.flexible-soft",
         "Very soft: the mode stays where it is, the rest 1 - Gamma moves with the ground.",
         "definition: k = (1 - Gamma) a_h; coupled s'' = a_h - a_y/(1 - Gamma), decoupled (1 - Gamma) of it",
         "damper and spring over the 6 s of the motion, of first order in 1/T: 40 s/T", flexible_soft});
    registry.push_back({"sliding.neighbours.flexible-energy",
                        "Coupled: work of the ground = friction + damping + kinetic and strain energy.",
                        "equations of motion of the two coordinates",
                        "trapezoids over samples T/800 apart, (omega dt)^2/12 = 5e-6", flexible_energy});
}

} // namespace damslip::verification
