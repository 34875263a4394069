#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide_batch.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/reference_scene.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;
using std::numbers::pi;

/// A bar that holds nothing before it is stretched. @param stiffness  E A/L [N/m²]
AnchorBar slack_bar(double inclination, double length, double stiffness, double yield_force)
{
    AnchorBar bar;
    bar.name = "bar";
    bar.length = length;
    bar.sine = std::sin(inclination);
    bar.cosine = std::cos(inclination);
    bar.axial_stiffness = stiffness * length;
    bar.yield_force = yield_force;
    return bar;
}

/// Mass 1 on a level base, g = 10 m/s².
RigidBlock unit_mass(double friction)
{
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    block.friction = friction;
    return block;
}

GroundMotion constant_push(double accel, double duration, double dt)
{
    GroundMotion motion;
    motion.dt = dt;
    motion.accel_h.assign(static_cast<std::size_t>(std::lround(duration / dt)) + 1, accel);
    return motion;
}

SlideOptions on_anchors(std::vector<AnchorBar> bars)
{
    SlideOptions options;
    options.history = HistoryOutput::samples;
    options.anchors = std::move(bars);
    return options;
}

/// A bar along the slip, P over friction R: D = P - R. Elastic s = (D/k)(1 - cos ωt), M ω² = k, up to s_y = N_y/k with
/// v_y² = 2(D s_y - k s_y²/2)/M; then (D - N_y)/M.
std::vector<Check> slider_with_bar()
{
    constexpr double friction = 0.25, accel = 5.0, D = accel - friction * 10.0, k = 40.0, yield_force = 4.0;
    const double omega = std::sqrt(k), s_y = yield_force / k, t_y = std::acos(1.0 - k * s_y / D) / omega,
                 v_y = std::sqrt(2.0 * (D * s_y - 0.5 * k * s_y * s_y));
    std::vector<Check> checks;
    for (const double dt : {0.05, 0.013}) {
        const GroundMotion push = constant_push(accel, 60 * dt, dt);
        const SlipStages block{{0.0, unit_mass(friction), 0.0}};
        SlideOptions options = on_anchors({slack_bar(0.5 * pi, 10.0, k, yield_force)});
        const SlideResult relieved = slide(push, block, options);
        options.sliding.run_out_max = 0.0;
        const SlideResult r = slide(push, block, options);
        double elastic = 0.0, slip = 0.0, rate = 0.0;
        for (std::size_t i = 0; i < push.accel_h.size(); ++i) {
            const double t = r.history.time[i], s = r.history.slip[i], v = r.history.slip_rate[i], after = t - t_y;
            if (after < 0.0) {
                elastic = std::max(elastic, std::abs(s - D / k * (1.0 - std::cos(omega * t))));
                continue;
            }
            const double a = D - yield_force, stops = -v_y / a; // N_y > D: it comes to rest
            const double until = std::min(after, stops);
            slip = std::max(slip, std::abs(s - (s_y + until * (v_y + 0.5 * a * until))));
            rate = std::max(rate, std::abs(v - (v_y + a * until)));
        }
        const AnchorOutcome& bar = r.anchors.front();
        const double end = s_y + 0.5 * v_y * v_y / (yield_force - D);
        // D s = ½ N_y²/k + N_y (s - s_y): what pushes less friction, against what the bar took.
        const double balance = bar.stored + bar.history.plastic_work - D * r.slip;
        const std::string with = ", dt " + std::to_string(dt).substr(0, 5) + " s";
        checks.push_back({"slip before yield" + with, "m", 0.0, elastic, 1e-10 * s_y, Measure::absolute});
        checks.push_back({"slip after yield" + with, "m", 0.0, slip, 1e-10 * end, Measure::absolute});
        checks.push_back({"rate after yield" + with, "m/s", 0.0, rate, 1e-10 * v_y, Measure::absolute});
        checks.push_back({"slip at rest" + with, "m", end, r.slip, 1e-10});
        // Without the push the bar, N_y > R, draws the block back, to as much below R as it was above.
        checks.push_back({"slip when the push is gone" + with, "m", end - 2.0 * (yield_force - friction * 10.0) / k,
                          relieved.slip, 1e-10});
        checks.push_back({"force of the bar then" + with, "N/m", 2.0 * friction * 10.0 - yield_force,
                          relieved.anchors.front().history.force, 1e-10});
        checks.push_back({"plastic strain" + with, "-", (end - s_y) / 10.0, bar.history.plastic_strain, 1e-10});
        checks.push_back({"energy of the bar less work of the push" + with, "J/m", 0.0, balance, 1e-10 * D * end,
                          Measure::absolute});
    }
    return checks;
}

/// A bar across the joint, no friction: ½ v² = P s - ∫N dl, so up to rupture the work of the bar is known from its strain.
std::vector<Check> bar_across()
{
    constexpr double length = 2.0, axial = 100.0, yield_force = 2.0, rupture = 0.05, accel = 3.0;
    AnchorBar bar = slack_bar(0.0, length, axial / length, yield_force);
    bar.rupture_strain = rupture;
    std::vector<Check> checks;
    double worst = 0.0;
    for (const double s : {1e-3, 0.1, 0.7}) { // by long double, 19 digits, of which the difference costs 7
        const long double wide = s, exact = std::sqrt(length * length + wide * wide) - length;
        worst = std::max(worst, std::abs(bar.stretch(0.0, s) / static_cast<double>(exact) - 1.0));
    }
    checks.push_back({"stretch against √(L² + s²) - L, relative", "-", 0.0, worst, 1e-11, Measure::absolute});

    const double s_u = length * std::sqrt((1.0 + rupture) * (1.0 + rupture) - 1.0), yield_strain = yield_force / axial,
                 work = length * yield_force * (rupture - 0.5 * yield_strain),
                 v_u = std::sqrt(2.0 * (accel * s_u - work));
    const SlideResult r =
        slide(constant_push(accel, 2.0, 0.01), SlipStages{{0.0, unit_mass(0.0), 0.0}}, on_anchors({bar}));
    const AnchorHistory& h = r.anchors.front().history;
    const double t_u = h.snapped_at.value_or(std::nan("")), end = 1.5;
    const double then = s_u + v_u * (end - t_u) + 0.5 * accel * (end - t_u) * (end - t_u);
    checks.push_back({"slip after rupture, from s_u and v_u", "m", then, r.history.slip[150], 1e-10});
    checks.push_back({"rate after rupture", "m/s", v_u + accel * (end - t_u), r.history.slip_rate[150], 1e-10});
    checks.push_back({"plastic strain at rupture", "-", rupture - yield_strain, h.plastic_strain, 1e-10});
    checks.push_back({"energy lost in rupture", "J/m", 0.5 * yield_force * yield_strain * length, h.loss, 1e-10});
    return checks;
}

/// Limit equilibrium: T <= mu (N' + N cos ψ) + N sin ψ by hand; a passive bar resists, a prestressed one is a load.
std::vector<Check> in_limit_equilibrium()
{
    constexpr double mu = 0.7, P = 1.2e6, yield = 3.0e6, at = 4.0, g = 9.81;
    const double psi = pi / 12.0;
    Scene scene = exact::bare_scene({{0, 0}, {40, 0}, {40, 50}, {0, 50}}, 2400.0);
    scene.contact.friction = mu;
    scene.reservoir = Reservoir{};
    scene.reservoir->level = 45.0;
    Anchor anchor;
    anchor.name = "crest anchors";
    anchor.distance = at;
    anchor.inclination = psi;
    anchor.free_length = 30.0;
    anchor.area = 0.002;
    anchor.yield_strength = yield / anchor.area;
    anchor.prestress = P;
    scene.anchors = {anchor};
    Combination c;
    c.name = "case";
    c.crack = CrackRule::none;
    const double weight = 40.0 * 50.0 * 2400.0 * g, thrust = 0.5 * 1000.0 * g * 45.0 * 45.0;
    std::vector<Check> checks;
    const Equilibrium prestressed = evaluate(scene, c, {});
    checks.push_back({"FS, N = P₀", "-", mu * (weight + P * std::cos(psi)) / (thrust - P * std::sin(psi)),
                      prestressed.sliding_factor, 1e-13});
    // About the heel: weight at 20 m, thrust at 15 m above, anchor at 4 m.
    checks.push_back({"resultant from the heel", "m",
                      (20.0 * weight + 15.0 * thrust + at * P * std::cos(psi)) / (weight + P * std::cos(psi)),
                      40.0 - prestressed.resultant_from_toe, 1e-13});
    scene.anchors.front().limit_force = AnchorForceRule::yield;
    scene.anchors.front().prestress = 0.0;
    checks.push_back({"FS, passive, N = N_y", "-",
                      (mu * (weight + yield * std::cos(psi)) + yield * std::sin(psi)) / thrust,
                      evaluate(scene, c, {}).sliding_factor, 1e-13});
    scene.anchors.front().dowel = true;
    scene.anchors.front().limit_force = AnchorForceRule::prestress;
    const double dowel = yield / std::sqrt(3.0) * (std::cos(psi) - mu * std::sin(psi));
    checks.push_back(
        {"FS, dowel alone", "-", (mu * weight + dowel) / thrust, evaluate(scene, c, {}).sliding_factor, 1e-13});
    scene.anchors.front().dowel = false;
    scene.anchors.front().prestress = P;
    const double added = scene_added_mass(scene, 45.0).xx;
    checks.push_back({"a_y of the block, N = P₀", "m/s²",
                      (mu * (weight + P * std::cos(psi)) + P * std::sin(psi) - thrust) / (weight / g + added),
                      yield_acceleration(make_rigid_block(scene)), 1e-13});
    return checks;
}

} // namespace

void add_anchor_cases(Registry& registry)
{
    const std::string series =
        "Taylor series to round-off, changes of state located to the last digits: 1e-10 of the largest";
    registry.push_back(
        {"sliding.anchor.slider-with-bar",
         "A block pushed against an elastic, then yielding bar, through yield to rest, and its energy.",
         "oscillator and constant deceleration by hand: s = (D/k)(1 - cos ωt), v_y² = 2(D s_y - k s_y²/2)/M", series,
         slider_with_bar});
    registry.push_back(
        {"sliding.anchor.bar-across", "A bar across the joint stretches with the square of the slip and snaps.",
         "Pythagoras: ΔL = √(L² + s²) - L, rupture at L √((1 + ε_u)² - 1); rates there by energy", series, bar_across});
    registry.push_back({"sliding.anchor.limit-equilibrium", "An anchor in the sums of forces and moments.",
                        "T <= mu (N' + N cos ψ) + N sin ψ by hand, N = P₀ or f_y A", "one sum: round-off",
                        in_limit_equilibrium});
}

} // namespace damslip::verification
