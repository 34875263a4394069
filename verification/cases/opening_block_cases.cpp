#include "verification/cases/modules.hpp"

#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "verification/exact/reference_scene.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace damslip::verification {

namespace {

constexpr double rectangle_base = 12.0, rectangle_height = 20.0, rectangle_depth = 15.0, rectangle_density = 2400.0,
                 rectangle_gravity = 9.81, rectangle_friction = 0.6;
constexpr double rectangle_unit_weight = 1000.0 * rectangle_gravity;

/// A rectangular dam without added mass, linear uplift.
Scene rectangle(OpeningWater opening)
{
    Scene scene = exact::bare_scene(
        {{0, 0}, {rectangle_base, 0}, {rectangle_base, rectangle_height}, {0, rectangle_height}}, rectangle_density);
    scene.gravity = rectangle_gravity;
    scene.contact.friction = rectangle_friction;
    scene.reservoir.emplace();
    scene.reservoir->level = rectangle_depth;
    scene.reservoir->model = ReservoirModel::hydrostatic;
    scene.uplift.emplace();
    scene.uplift->model = UpliftModel::linear;
    scene.uplift->water.opening = opening;
    return scene;
}

/// By hand: weight, thrust and inertia about the toe, stress a triangle over L - x.
struct ByHand {
    OpeningWater opening;

    struct Uplift {
        double force, about_toe;
    };
    Uplift uplift(double x) const
    {
        const double p = rectangle_unit_weight * rectangle_depth, rest = rectangle_base - x;
        if (opening == OpeningWater::full)
            return {p * x + 0.5 * p * rest, p * x * (rectangle_base - 0.5 * x) + 0.5 * p * rest * (2.0 / 3.0) * rest};
        const double at_tip = p * rest / rectangle_base; // zero: the pressure before beyond the tip
        return {0.5 * at_tip * rest, 0.5 * at_tip * rest * (2.0 / 3.0) * rest};
    }
    double weight() const { return rectangle_density * rectangle_gravity * rectangle_base * rectangle_height; }
    double normal(double x) const { return weight() - uplift(x).force; }
    /// (L - x) N' - 3 M', zero at the tip.
    double misfit(double x, double a) const
    {
        const double thrust = 0.5 * rectangle_unit_weight * rectangle_depth * rectangle_depth,
                     mass = weight() / rectangle_gravity;
        const double moment = 0.5 * weight() * rectangle_base - thrust * rectangle_depth / 3.0 -
                              mass * a * 0.5 * rectangle_height - uplift(x).about_toe;
        return (rectangle_base - x) * normal(x) - 3.0 * moment;
    }
    double tip(double a) const
    {
        if (misfit(0.0, a) <= 0.0) return 0.0;
        double shut = 0.0, past = rectangle_base;
        for (int k = 1; k <= 4000; ++k) // the first change of sign
            if (misfit(rectangle_base * k / 4000.0, a) <= 0.0) {
                past = rectangle_base * k / 4000.0;
                break;
            } else {
                shut = rectangle_base * k / 4000.0;
            }
        for (int k = 0; k < 60; ++k) (misfit(0.5 * (shut + past), a) > 0.0 ? shut : past) = 0.5 * (shut + past);
        return past;
    }
    double yield() const
    {
        const double thrust = 0.5 * rectangle_unit_weight * rectangle_depth * rectangle_depth,
                     mass = weight() / rectangle_gravity;
        double holds = 0.0, slides = 8.0;
        for (int k = 0; k < 60; ++k) {
            const double a = 0.5 * (holds + slides);
            (thrust + mass * a > rectangle_friction * normal(tip(a)) ? slides : holds) = a;
        }
        return slides;
    }
};

sliding::RigidBlock block_of(const Scene& scene)
{
    sliding::RigidBlock block = sliding::make_rigid_block(scene);
    const sliding::StaticCase static_case = sliding::scene_static_case(scene);
    block.opening =
        sliding::opening_uplift(scene, static_case, sliding::base_state(scene, static_case), block, false, {});
    return block;
}

/// a(t) = A (1 - t/t_d): the slip of a block with a constant yield is (2/3) t_d² (A - a_y)³/A² for A/2 <= a_y < A.
double slip_of_ramp(double yield, double peak, double seconds)
{
    return 2.0 / 3.0 * seconds * seconds * std::pow(peak - yield, 3) / (peak * peak);
}

std::vector<Check> slides_with_its_crack()
{
    std::vector<Check> checks;
    for (const OpeningWater opening : {OpeningWater::zero, OpeningWater::full}) {
        const ByHand hand{opening};
        const sliding::RigidBlock block = block_of(rectangle(opening));
        const double yield = hand.yield(), peak = 1.5 * yield, seconds = 0.8;
        const std::string rule = opening == OpeningWater::zero ? "zero" : "full";
        checks.push_back({rule + ": crack at yield is one", "m", 0.1, hand.tip(yield), 0.0, Measure::lower_bound});
        checks.push_back({rule + ": a_y with the crack", "m/s²", yield, sliding::yield_acceleration(block, 0.0), 1e-9});
        GroundMotion motion;
        motion.dt = 0.01;
        for (int k = 0; k <= 80; ++k) motion.accel_h.push_back(peak * (1.0 - k / 80.0));
        sliding::SlideOptions options;
        options.sliding.two_way = false;
        checks.push_back({rule + ": slip", "m", slip_of_ramp(yield, peak, seconds),
                          sliding::slide(motion, block, options).slip, 1e-8});
    }
    return checks;
}

/// Water on its way by hand: full head to w, none to the tip x, beyond it as of a crack of length w.
struct SlowByHand {
    double speed;

    double mass() const { return rectangle_density * rectangle_base * rectangle_height; }
    double weight() const { return mass() * rectangle_gravity; }
    double thrust() const { return 0.5 * rectangle_unit_weight * rectangle_depth * rectangle_depth; }
    ByHand::Uplift uplift(double w, double x) const
    {
        const double p = rectangle_unit_weight * rectangle_depth, shut = rectangle_base - x;
        const double beyond = 0.5 * p * shut / (rectangle_base - w) * shut;
        return {p * w + beyond, p * w * (rectangle_base - 0.5 * w) + beyond * (2.0 / 3.0) * shut};
    }
    /// (L - x) N' - 3 M' about the toe: positive where the crack goes on.
    double misfit(double w, double x, double a) const
    {
        const ByHand::Uplift u = uplift(w, x);
        const double moment = 0.5 * weight() * rectangle_base - thrust() * rectangle_depth / 3.0 -
                              mass() * a * 0.5 * rectangle_height - u.about_toe;
        return (rectangle_base - x) * (weight() - u.force) - 3.0 * moment;
    }
    double tip(double w, double a) const
    {
        double open = w, shut = rectangle_base * (1.0 - 1e-9);
        if (misfit(w, open, a) <= 0.0) return open;
        for (int k = 0; k < 50; ++k) (misfit(w, 0.5 * (open + shut), a) > 0.0 ? open : shut) = 0.5 * (open + shut);
        return open;
    }
    /// Acceleration and crack at which it slides with water as far as w.
    struct Edge {
        double accel, tip;
    };
    Edge edge(double w) const
    {
        double holds = 0.0, slides = 8.0;
        for (int k = 0; k < 50; ++k) {
            const double a = 0.5 * (holds + slides);
            const double resists = rectangle_friction * (weight() - uplift(w, tip(w, a)).force);
            (thrust() + mass() * a > resists ? slides : holds) = a;
        }
        return {slides, tip(w, slides)};
    }
    /// Shaken by `peak` for `seconds`, then by nothing, from rest to rest.
    double slip(double peak, double seconds) const
    {
        const double h = 1e-3;
        double w = 0.0, rate = 0.0, slip = 0.0;
        for (double time = 0.0; time < 10.0; time += h) {
            const Edge now = edge(w);
            const double further = std::min(w + speed * h, now.tip);
            const double yields = 0.5 * (now.accel + edge(further).accel);
            const double accel = (time < seconds - 0.5 * h ? peak : 0.0) - yields;
            if (rate + accel * h <= 0.0) return slip - 0.5 * rate * rate / accel;
            slip += rate * h + 0.5 * accel * h * h;
            rate += accel * h;
            w = further;
        }
        return std::numeric_limits<double>::infinity();
    }
};

std::vector<Check> water_on_its_way()
{
    std::vector<Check> checks;
    const double peak = 1.5 * ByHand{OpeningWater::zero}.yield(), seconds = 0.8;
    GroundMotion motion;
    motion.dt = 0.01;
    motion.accel_h.assign(81, peak);
    sliding::SlideOptions options;
    options.sliding.two_way = false;
    const auto slip_of = [&](OpeningWater rule, double speed) {
        Scene scene = rectangle(rule);
        if (rule == OpeningWater::mouth) scene.uplift->water.mouth_speed = speed;
        return sliding::slide(motion, block_of(scene), options).slip;
    };
    const double empty = slip_of(OpeningWater::zero, 0.0), full = slip_of(OpeningWater::full, 0.0);
    checks.push_back({"full slips further than empty", "m", 1.1 * empty, full, 0.0, Measure::lower_bound});
    checks.push_back({"no speed: as zero", "m", empty, slip_of(OpeningWater::mouth, 1e-9), 1e-8});
    checks.push_back({"a high speed: as full", "m", full, slip_of(OpeningWater::mouth, 1e6), 1e-3});
    for (const double speed : {0.5, 2.0, 8.0})
        checks.push_back({"v_w " + std::to_string(speed).substr(0, 3) + " m/s: slip", "m",
                          SlowByHand{speed}.slip(peak, seconds), slip_of(OpeningWater::mouth, speed), 5e-4});
    return checks;
}

} // namespace

void add_opening_block_cases(Registry& registry)
{
    registry.push_back({"sliding.opening-water.rectangle",
                        "A rectangular dam slides with the crack that its own acceleration opens, empty or full",
                        "no-tension base by hand: stress a triangle over L - x, moments about the toe; slip under a "
                        "decaying ramp (2/3) t_d² (A - a_y)³/A²",
                        "a_y by bisection on both sides, 1e-9; slip three times that at (A - a_y)/a_y = 1/2, 1e-8",
                        slides_with_its_crack});
    registry.push_back({"sliding.opening-water.mouth",
                        "Water that comes into the crack of a sliding rectangle with a finite speed",
                        "no-tension base by hand with full head to x_w and none to the tip; x_w by its speed, slip by "
                        "steps of 1 ms from rest to rest",
                        "limits: 1e-8 of zero, 1e-3 of full (its water is there from the start); "
                        "between them 5e-4, steps by hand and table over x_w",
                        water_on_its_way});
}

} // namespace damslip::verification
