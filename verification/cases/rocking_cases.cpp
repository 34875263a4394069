#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/rocking/rocking.hpp"
#include "sliding/rocking/rocking_motion.hpp"
#include "verification/cases/flat_water.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/reference_scene.hpp"
#include "verification/exact/rocking_block.hpp"
#include "verification/exact/sampled_ground.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;
using exact::ground_of;
using exact::ReferenceUplift;
using exact::stillness;
using Check = damslip::verification::Check;

constexpr double gravity = 9.81, rocking_density = 2500.0,
                 no_slip = 50.0; // [m/s^2], [kg/m^3]; friction of a block that never slides

RockingBlock rectangle(const exact::Rocker& r, double friction = no_slip)
{
    return rectangular_block(r.width, r.height, rocking_density, r.gravity, friction);
}

RockingBlock dam_block(const Scene& scene)
{
    const StaticCase static_case = scene_static_case(scene);
    const BaseState state = base_state(scene, static_case);
    const std::optional<double> level = static_case.loads.reservoir_level;
    return make_rocking_block(scene, state, scene_added_mass(scene, level),
                              strength_stages(make_rigid_block(scene, state, level), scene.contact));
}

SlideOptions no_run_out()
{
    SlideOptions options;
    options.sliding.run_out_max = 0.0;
    return options;
}

/// a_h at which the block leaves its base, from a ramp.
double starts_at(const RockingBlock& block, double slope, double duration)
{
    const GroundMotion ramp = ground_of([=](double t) { return slope * t; }, duration, 97);
    return std::abs(slope) * rock_and_slide(ramp, block, no_run_out()).first_rock_time;
}

std::vector<Check> starts()
{
    const exact::Rocker r{4.0, 10.0, gravity};
    std::vector<Check> checks{
        {"rectangle 4 x 10 m: a_h = g x_c / y_c", "m/s²", r.starts(), starts_at(rectangle(r), 1.0, 5.0), 1e-10},
        {"the same upstream, on its heel", "m/s²", r.starts(), starts_at(rectangle(r), -1.0, 5.0), 1e-10}};
    Scene scene = exact::reference_scene(ReferenceUplift::printed_curtain, 3.0);
    checks.push_back({"reference dam, curtain, added mass: tipping by the moments of all loads", "m/s²",
                      base_limits(scene).tips, starts_at(dam_block(scene), 1.0, 12.0), 1e-10});
    scene.section.polygon = {{0.0, 0.0}, {45.0, -3.0}, {16.0, 62.5}, {4.0, 62.5}};
    checks.push_back({"base dipping downstream, sloping upstream face", "m/s²", base_limits(scene).tips,
                      starts_at(dam_block(scene), 1.0, 12.0), 1e-10});
    checks.push_back({"the same upstream", "m/s²", base_limits(scene).tips_upstream,
                      starts_at(dam_block(scene), -1.0, 60.0), 1e-10});
    return checks;
}

/// Released at a share of its slenderness, until just after the first landing.
RockingResult released(const RockingBlock& block, const exact::Rocker& r, double share, const SlideOptions& options,
                       double after = 1e-4)
{
    const double end = r.quarter_period(std::abs(share)) + after;
    return rock_and_slide(stillness(end, 400), block, options, {share * r.slenderness(), 0.0});
}

std::vector<Check> landings()
{
    std::vector<Check> checks;
    for (const double height : {40.0, 10.0, 5.0})
        for (const double share : {0.6, -0.6}) {
            const exact::Rocker r{4.0, height, gravity};
            const RockingResult result = released(rectangle(r), r, share, no_run_out());
            const double k = r.landing_ratio();
            checks.push_back(
                {fmt::format("4 x {:g} m, {}: energy left, rate² ratio", height, share > 0 ? "on toe" : "on heel"), "–",
                 k * k, 1.0 - result.energy.landings / released(rectangle(r), r, share, no_run_out(), 0.0).energy.loads,
                 1e-9});
        }
    const exact::Rocker r{4.0, 10.0, gravity};
    SlideOptions given = no_run_out();
    given.sliding.restitution = 0.5;
    const RockingResult half = released(rectangle(r), r, 0.6, given);
    checks.push_back({"restitution 0.5: rate² ratio", "–", 0.25,
                      1.0 - half.energy.landings / released(rectangle(r), r, 0.6, given, 0.0).energy.loads, 1e-9});
    const exact::Rocker flat{10.0, 4.0, gravity}; // sin² alpha > 2/3: both corners stay
    checks.push_back(
        {"10 x 4 m: stands after one landing", "–", 1.0,
         static_cast<double>(rock_and_slide(stillness(20.0, 2000), rectangle(flat), {}, {0.3, 0.0}).landings), 0.0,
         Measure::absolute});
    return checks;
}

std::vector<Check> free_periods()
{
    std::vector<Check> checks;
    for (const double share : {0.1, 0.5, 0.9}) {
        const exact::Rocker slender{0.02, 20.0, gravity}, dam{7.0, 10.0, gravity};
        checks.push_back({fmt::format("0.02 x 20 m, released at {:g} alpha: T/4 = acosh(1/(1 - share))/p", share), "s",
                          0.25 * slender.linear_period(share),
                          released(rectangle(slender), slender, share, no_run_out()).first_landing_time, 2e-6});
        checks.push_back({fmt::format("7 x 10 m, {:g} alpha: T/4 of finite angles", share), "s",
                          dam.quarter_period(share),
                          released(rectangle(dam), dam, share, no_run_out()).first_landing_time, 1e-10});
    }
    return checks;
}

/// Sines of four frequencies, both components.
GroundMotion broad_band(double peak)
{
    GroundMotion m = ground_of(
        [=](double t) {
            return peak *
                   (0.4 * std::sin(7.0 * t) + 0.3 * std::sin(12.7 * t + 1.0) + 0.2 * std::sin(23.1 * t + 2.0) +
                    0.1 * std::sin(41.9 * t)) *
                   std::exp(-0.1 * t);
        },
        20.0, 4000);
    for (std::size_t k = 0; k < m.accel_h.size(); ++k)
        m.accel_v.push_back(0.3 * peak * std::sin(31.0 * m.dt * static_cast<double>(k)));
    return m;
}

std::vector<Check> slides_like_the_block()
{
    std::vector<Check> checks;
    Scene scene = exact::reference_scene(ReferenceUplift::printed_curtain, 0.77);
    const auto add = [&](const std::string& what, double peak) {
        const RockingBlock block = dam_block(scene);
        SlipStages stages;
        for (const RockingStage& stage : block.stages) stages.push_back(stage.slip);
        const SlideResult slides = slide(broad_band(peak), stages);
        const RockingResult rocks = rock_and_slide(broad_band(peak), block);
        checks.push_back({what + ": slip at end", "m", slides.slip, rocks.slide.slip, 1e-9});
        checks.push_back({what + ": largest slip", "m", slides.max_slip, rocks.slide.max_slip, 1e-9});
        checks.push_back({what + ": corners that leave the rock", "–", 0.0, static_cast<double>(rocks.rocks), 0.0,
                          Measure::absolute});
    };
    add("reference dam, both components", 4.0);
    scene.section.polygon = {{0.0, 0.0}, {45.0, 2.0}, {16.0, 62.5}, {4.0, 62.5}};
    add("base rising downstream, sloping face", 5.0);
    scene = exact::reference_scene(ReferenceUplift::printed_curtain, 0.85);
    scene.contact.residual_friction = 0.78;
    add("residual friction from the first slip on", 4.0);
    return checks;
}

/// Nothing pushes the centroid sideways on a base without friction, so the corner goes its way under it: from
/// rho_t(theta) = -x_c cos theta + y_c sin theta to rho_t(0), for good, whatever the landings.
std::vector<Check> frictionless()
{
    const exact::Rocker r{4.0, 10.0, gravity};
    const double theta = 0.2, way = 2.0 * (1.0 - std::cos(theta)) + 5.0 * std::sin(theta);
    std::vector<Check> checks;
    for (const double sense : {1.0, -1.0}) {
        const RockingResult result = rock_and_slide(stillness(20.0, 4000), rectangle(r, 0.0), {}, {sense * theta, 0.0});
        checks.push_back({sense > 0 ? "released on its toe: slip of the corner" : "released on its heel", "m",
                          sense * way, result.slide.slip, 1e-9});
        checks.push_back({"its energy balance", "–", 0.0, result.energy.imbalance, 1e-9, Measure::absolute});
    }
    return checks;
}

std::vector<Check> energies()
{
    std::vector<Check> checks;
    const auto add = [&](const std::string& what, const RockingResult& r) {
        checks.push_back({what + ": at rest in the end", "–", 1.0, r.slide.status == Status::at_rest ? 1.0 : 0.0, 0.0,
                          Measure::absolute});
        checks.push_back({what + ": imbalance", "–", 0.0, r.energy.imbalance, 1e-9, Measure::absolute});
        checks.push_back({what + ": landings", "–", 1.0, static_cast<double>(r.landings), 0.0, Measure::lower_bound});
    };
    const exact::Rocker r{4.0, 10.0, gravity};
    add("4 x 10 m, mu 0.5: rocks and slides", rock_and_slide(broad_band(7.0), rectangle(r, 0.5)));
    add("4 x 10 m, mu 5: rocks", rock_and_slide(broad_band(6.0), rectangle(r, 5.0)));
    Scene scene = exact::reference_scene(ReferenceUplift::printed_curtain, 1.6);
    add("reference dam, mu 1.6", rock_and_slide(broad_band(9.0), dam_block(scene)));
    return checks;
}

/// A rectangle 40 m wide and 50 m high, 40 m of water, linear uplift with full head in the crack, c and mu.
std::vector<Check> yield_with_crack()
{
    Scene scene = exact::bare_scene({{0.0, 0.0}, {40.0, 0.0}, {40.0, 50.0}, {0.0, 50.0}}, rocking_density);
    scene.reservoir = Reservoir{};
    scene.reservoir->level = 40.0;
    scene.reservoir->model = ReservoirModel::hydrostatic;
    scene.uplift = Uplift{};
    scene.uplift->model = UpliftModel::linear;
    scene.uplift->crack = CrackRule::seismic_full;
    scene.contact.friction = 0.7;
    scene.contact.cohesion = 100e3;
    const double length = 40.0, mass = rocking_density * 2000.0, normal = mass * gravity, p = 1000.0 * gravity * 40.0;
    const double thrust = 0.5 * p * 40.0;
    // Full pressure over the crack T, then linear to zero: T = (N L + p L^2/2 - 3 M)/(N - p L), M about the toe, U = p (L + T)/2
    // (exact::linear_uplift_crack); the stress is a triangle over L - T, three times the distance of N' from the toe.
    const auto excess = [&](double a) {
        const double moment = normal * 20.0 - thrust * 40.0 / 3.0 - mass * a * 25.0;
        const double crack =
            std::max(0.0, (normal * length + 0.5 * p * length * length - 3.0 * moment) / (normal - p * length));
        const double effective = normal - 0.5 * p * (length + crack);
        return thrust + mass * a - (100e3 * (length - crack) + 0.7 * effective);
    };
    double below = 0.0, above = 5.0;
    for (int k = 0; k < 100; ++k) (excess(0.5 * (below + above)) > 0.0 ? above : below) = 0.5 * (below + above);
    const BaseLimits limits = base_limits(scene);
    const RigidBlock block = make_rigid_block(scene);
    return {{"a_y with the crack that it opens", "m/s²", above, limits.yield_with_crack, 1e-9},
            {"a_y with the static crack: more", "m/s²", 1.05 * above, yield_downstream(block).law.constant, 0.0,
             Measure::lower_bound},
            {"the dam tips later than that", "m/s²", above, limits.tips, 0.0, Measure::lower_bound}};
}

/// Under a tower 4 x 10 m nothing stops the water of both mouths: about the toe 5 m a = 2 m g - p (x L - x²/2) with
/// a = slope t and x = v t, a quadratic in t.
std::vector<Check> tips_by_water_on_its_way()
{
    std::vector<Check> checks;
    const exact::Rocker r{4.0, 10.0, gravity};
    const double mass = rocking_density * r.width * r.height, pressure = 0.2 * rocking_density * r.height * gravity;
    for (const double speed : {0.3, 1.2})
        for (const double slope : {1.5, -1.5}) {
            RockingBlock block = rectangle(r);
            const MouthEnd end{.empty = {}, .first = 0.0, .pressure = pressure, .gradient = 0.0};
            block.mouth = RockingMouth{std::make_shared<FlatWater>(speed, r.width, true), end, end};
            const double a = -0.5 * pressure * speed * speed, c = -0.5 * r.width * mass * gravity;
            const double b = 0.5 * r.height * mass * std::abs(slope) + pressure * speed * r.width;
            checks.push_back({fmt::format("{:g} m/s, about the {}: a_h", speed, slope > 0.0 ? "toe" : "heel"), "m/s²",
                              std::abs(slope) * (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a),
                              starts_at(block, slope, 5.0), 1e-9});
        }
    return checks;
}

} // namespace

void add_rocking_cases(Registry& registry)
{
    const std::string events = "closed solution; events by bracketed roots of the step, local error 1e-12";
    registry.push_back({"sliding.rocking.starts", "A block starts to rock where N' reaches its corner.",
                        "Housner (1963): a = g x_c/y_c; of dams the moments of all loads about the corner", events,
                        starts});
    registry.push_back({"sliding.rocking.landing", "What a landing takes.",
                        "Housner (1963): rate² ratio (1 - 1.5 sin² alpha)²",
                        "energies of two runs, one to just before the landing, over each other: 1e-9", landings});
    registry.push_back({"sliding.rocking.free-period", "Free rocking of a block released at an angle.",
                        "Housner (1963): T = 4/p acosh(1/(1 - theta_0/alpha)), p² = 3 g/(4 R); of finite angles the "
                        "integral of the energy",
                        "slender block, alpha 1e-3: small angles leave alpha²; finite angles 1e-10", free_periods});
    registry.push_back({"sliding.rocking.slides-like-the-block",
                        "A block that would tip far above its yield slides as the sliding block does.",
                        "slide(), closed forms between events", "two integrators, some hundred movements: 1e-9",
                        slides_like_the_block});
    registry.push_back(
        {"sliding.rocking.frictionless", "Rocking on a base without friction leaves the centroid above its place.",
         "conservation of momentum along the base, by hand", "rounded by some hundred landings: 1e-9", frictionless});
    registry.push_back({"sliding.rocking.energy", "Ground and loads pay for friction, landings and motion.",
                        "energy balance; works are integrated beside the motion, kinetic energy is that of the state",
                        "1e-9 of the largest work", energies});
    registry.push_back({"sliding.rocking.mouth",
                        "Water on its way into the joint tips the block, uplift.opening = mouth.",
                        "moments about the corner by hand, a quadratic in t", events, tips_by_water_on_its_way});
    registry.push_back(
        {"sliding.rocking.yield-with-crack", "Yield acceleration with the crack that it opens, full head in it.",
         "triangular stress, tip at L - 3 x_toe, by hand and bisection", "bisection to 1e-12", yield_with_crack});
}

} // namespace damslip::verification
