#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/slide_batch.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/block_slip.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;

template <typename Function>
std::vector<double> samples(Function&& accel, double dt, int n)
{
    std::vector<double> result;
    for (int k = 0; k <= n; ++k) result.push_back(accel(k * dt));
    return result;
}

template <typename Function>
GroundMotion motion(Function&& accel_h, double dt, int n)
{
    return {"", dt, samples(accel_h, dt, n), {}, {}};
}

GroundMotion steady(double a_h, double duration, int n)
{
    return motion([=](double) { return a_h; }, duration / n, n);
}

GroundMotion triangle(double A, double t1, int n)
{
    return motion([=](double t) { return A * (1.0 - std::abs(t / t1 - 1.0)); }, t1 / n, 2 * n);
}

/// Mass 1, g = 10 m/s^2, horizontal base; friction and thrust give the yields.
RigidBlock block_with_yields(double down, double up)
{
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    block.friction = 0.05 * (down + up);
    block.horizontal_force = 0.5 * (up - down);
    return block;
}

double slip(const GroundMotion& ground, const SlipStages& stages, LiftOff lift_off = LiftOff::no_friction)
{
    SlideOptions options;
    options.sliding.lift_off = lift_off;
    return slide(ground, stages, options).slip;
}

double slip(const GroundMotion& ground, const RigidBlock& block, LiftOff lift_off = LiftOff::no_friction)
{
    return slip(ground, SlipStages{{0.0, block, 0.0}}, lift_off);
}

std::vector<Check> yields()
{
    RigidBlock dam;
    dam.mass = 0.5 * 45.0 * 62.5 * 2500.0;
    dam.added_mass.xx = 7.0 / 12.0 * 1000.0 * 62.5 * 62.5;
    dam.horizontal_force = 0.5 * 9810.0 * 62.5 * 62.5;
    dam.friction = 0.77;
    const double by_hand = (0.77 * dam.mass * 9.81 - dam.horizontal_force) / (dam.mass + dam.added_mass.xx);
    RigidBlock wedge;
    wedge.mass = 1.0;
    wedge.friction = std::tan(0.6);
    wedge.base_inclination = 0.25;
    return {{"triangular dam, 62.5 m, mu 0.77: a_y", "m/s²", by_hand, yield_acceleration(dam), 1e-14},
            {"the same, printed digits", "m/s²", 1.27640, yield_acceleration(dam), 5e-6, Measure::absolute},
            {"the friction that just holds it", "–", dam.horizontal_force / (dam.mass * 9.81), critical_friction(dam),
             1e-14},
            {"dry wedge, phi 0.6, theta 0.25: a_y", "m/s²", 9.81 * std::tan(0.35), yield_acceleration(wedge), 1e-14},
            {"its slip acceleration per excess", "–", std::cos(0.35) / std::cos(0.6), yield_downstream(wedge).factor,
             1e-14},
            {"its upstream yield", "m/s²", 9.81 * std::tan(0.85), yield_upstream(wedge).law.constant, 1e-14}};
}

std::vector<Check> pulses()
{
    std::vector<Check> checks;
    for (const int n : {1, 7}) {
        const std::string at = ", " + std::to_string(n) + " intervals";
        checks.push_back({"rectangle 5 m/s², 1 s, a_y 2" + at, "m", exact::slip_under_rectangle(5.0, 1.0, 2.0),
                          slip(steady(5.0, 1.0, n), block_with_yields(2.0, 2.0)), 1e-12});
        for (const double a_y : {0.3, 3.5})
            checks.push_back({"triangle 5 m/s², 2 x 0.5 s, a_y " + std::string(a_y < 1.0 ? "0.3" : "3.5") + at, "m",
                              exact::slip_under_triangle(5.0, 0.5, a_y),
                              slip(triangle(5.0, 0.5, n), block_with_yields(a_y, a_y)), 1e-12});
    }
    return checks;
}

std::vector<Check> decaying_ramp()
{
    std::vector<Check> checks;
    for (const double dt : {0.1, 0.0625, 0.005}) {
        const GroundMotion ramp =
            motion([](double t) { return 5.0 * (1.0 - t); }, dt, static_cast<int>(std::lround(1.0 / dt)));
        const SlideResult result = slide(ramp, block_with_yields(3.0, 3.0));
        const std::string at = ", dt " + std::to_string(dt) + " s";
        checks.push_back({"slip" + at, "m", 16.0 / 75.0, result.slip, 1e-13});
        checks.push_back({"stop" + at, "s", 0.8, result.last_slip_time, 1e-13});
    }
    return checks;
}

/// Slip under the sampled half sine; the record is the interpolant, so it tends to the sine's slip with the square of the step.
double half_sine_slip(double a_y, int n)
{
    const double omega = 5.0;
    return slip(motion([=](double t) { return 4.0 * std::sin(omega * t); }, std::numbers::pi / omega / n, n),
                block_with_yields(a_y, a_y));
}

std::vector<Check> sines()
{
    std::vector<Check> checks;
    for (const double a_y : {0.4, 2.0, 3.4}) {
        const double exact = exact::slip_under_half_sine(4.0, 5.0, a_y);
        const double coarse = half_sine_slip(a_y, 500) - exact, fine = half_sine_slip(a_y, 1000) - exact;
        const std::string name = "half sine, a_y/A " + std::to_string(a_y / 4.0).substr(0, 4);
        checks.push_back({name + ": order in dt", "–", 2.0, std::log2(coarse / fine), 0.05, Measure::absolute});
        checks.push_back(
            {name + ": extrapolated slip", "m", exact, half_sine_slip(a_y, 1000) + (fine - coarse) / 3.0, 1e-7});
    }
    // Ten cycles of a train, one-way: ten times one cycle (the quarter wave before and after moves nothing more), at 4000 samples a cycle.
    const double dt = 2.0 * std::numbers::pi / 5.0 / 4000.0;
    const std::vector<double> train = samples([](double t) { return 4.0 * std::sin(5.0 * t); }, dt, 40000);
    checks.push_back({"sine train, 10 cycles, one-way", "m", 10.0 * exact::slip_per_sine_cycle(4.0, 5.0, 2.0),
                      slide_constant_yield(train, dt, 2.0).slip, 3e-6});
    checks.push_back({"sine train, two-way, yields 1 and 1.5: the interpolant in extended precision", "m",
                      exact::slip_of_interpolant(train, dt, 1.0, 1.5),
                      slip(GroundMotion{"sine train", dt, train, {}, {}}, block_with_yields(1.0, 1.5)), 1e-12});
    return checks;
}

/// A broad-band motion of unrelated sines under an envelope.
GroundMotion broad_band(double peak, double dt, int n)
{
    return motion(
        [=](double t) {
            const double envelope = t < 2.0 ? t / 2.0 : std::exp(-0.15 * (t - 2.0));
            return peak * envelope *
                   (0.5 * std::sin(7.3 * t) + 0.35 * std::sin(19.1 * t + 1.0) + 0.3 * std::sin(41.7 * t + 2.0));
        },
        dt, n);
}

std::vector<double> refined(const std::vector<double>& a, int parts)
{
    std::vector<double> fine;
    for (std::size_t k = 0; k + 1 < a.size(); ++k)
        for (int i = 0; i < parts; ++i) fine.push_back(a[k] + (a[k + 1] - a[k]) * i / parts);
    fine.push_back(a.back());
    return fine;
}

std::vector<Check> broad_band_motion()
{
    const GroundMotion ground = broad_band(6.0, 0.01, 3000);
    std::vector<Check> checks;
    for (const double a_y : {0.5, 1.7, 4.0}) {
        const std::string name = ", a_y " + std::to_string(a_y).substr(0, 3);
        const double one_way = exact::slip_of_interpolant(ground.accel_h, 0.01, a_y, 1e9);
        const double both = exact::slip_of_interpolant(ground.accel_h, 0.01, a_y, 1.6 * a_y);
        checks.push_back({"one-way" + name, "m", one_way, slide_constant_yield(ground.accel_h, 0.01, a_y).slip, 1e-12});
        checks.push_back({"two-way" + name, "m", both, slip(ground, block_with_yields(a_y, 1.6 * a_y)), 1e-11});
        for (const int parts : {2, 7})
            checks.push_back({"one-way, each interval in " + std::to_string(parts) + name, "m", one_way,
                              slide_constant_yield(refined(ground.accel_h, parts), 0.01 / parts, a_y).slip, 1e-12});
    }
    const SkippingMotion blocks(ground);
    const ConstantYieldOptions every{1, 60.0, Scan::every_sample};
    checks.push_back({"skipping blocks changes", "m", 0.0,
                      slide_constant_yield(blocks, {1.7}).slip - slide_constant_yield(blocks, {1.7}, every).slip,
                      0.0, Measure::absolute});
    return checks;
}

std::vector<Check> vertical()
{
    std::vector<Check> checks;
    const auto with_vertical = [](double A, auto&& a_v, double T, int n) {
        GroundMotion ground = steady(A, T, n);
        ground.accel_v = samples(a_v, T / n, n);
        return ground;
    };
    RigidBlock block = block_with_yields(4.0, 4.0);
    for (const int n : {1, 3, 10}) {
        const std::string at = ", " + std::to_string(n) + " intervals";
        checks.push_back({"a_v falls to -8 m/s²" + at, "m",
                          exact::slip_under_falling_vertical(2.0, 8.0, 1.0, 0.4, 10.0),
                          slip(with_vertical(
                                   2.0, [](double t) { return -8.0 * t; }, 1.0, n),
                               block),
                          1e-12});
        checks.push_back({"a_v falls to -20 m/s², no resistance when open" + at, "m",
                          exact::slip_with_lift_off(2.0, 20.0, 1.0, 0.4, 10.0),
                          slip(with_vertical(
                                   2.0, [](double t) { return -20.0 * t; }, 1.0, n),
                               block),
                          1e-12});
        RigidBlock flying = block_with_yields(3.0, 3.0);
        flying.mass = 2.0;
        flying.added_mass.xx = 1.0;
        checks.push_back({"flight and plastic landing" + at, "m",
                          exact::slip_with_landing(30.0, 18.0, 0.5, 0.3, 10.0, 2.0, 1.0),
                          slip(with_vertical(
                                   30.0, [](double) { return -18.0; }, 0.5, n),
                               flying, LiftOff::ballistic),
                          1e-12});
    }
    // The sign of a_v: up presses the block on its base. A flipped sign would give the value of a_v down.
    const double up = 5.0 - 0.3 * 13.0, down = 5.0 - 0.3 * 7.0;
    const double slip_up = slip(with_vertical(
                                    5.0, [](double) { return 3.0; }, 1.0, 2),
                                block_with_yields(3.0, 3.0));
    checks.push_back({"steady a_v = +3 m/s²", "m", up / 2.0 + up * up / 6.0, slip_up, 1e-12});
    checks.push_back({"distance from the answer of a flipped sign", "m", 1.0,
                      (down / 2.0 + down * down / 6.0) - slip_up, 0.0, Measure::lower_bound});
    return checks;
}

std::vector<Check> inclined()
{
    RigidBlock wedge;
    wedge.mass = 1.0;
    wedge.gravity = 10.0;
    wedge.friction = std::tan(0.5);
    wedge.base_inclination = 0.2;
    const double exact = std::cos(0.3) / std::cos(0.5) * exact::slip_under_rectangle(6.0, 1.0, 10.0 * std::tan(0.3));
    return {{"dry wedge, phi 0.5, theta 0.2, 6 m/s² for 1 s", "m", exact, slip(steady(6.0, 1.0, 5), wedge), 1e-12}};
}

std::vector<Check> strength_over_slip()
{
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    RigidBlock bonded = block;
    bonded.cohesion_force = 1.5;
    Contact cohesion;
    cohesion.friction = 0.3;
    Contact residual;
    residual.friction = 0.3;
    residual.residual_friction = 0.2;
    residual.residual_slip = 0.25;
    const auto linear = [](double from, double to, double over) {
        Contact contact;
        contact.friction = from;
        contact.residual_friction = to;
        contact.residual_slip = over;
        contact.residual_path = Interpolation::linear;
        return contact;
    };
    const double omega = std::sqrt(6.0), kappa = 4.0;
    GroundMotion with_vertical = steady(4.0, 3.0, 8);
    with_vertical.accel_v = samples([](double t) { return 0.5 + 1.5 * t; }, 3.0 / 8, 8);
    return {{"cohesion lost at first slip", "m", exact::slip_under_triangle_after_start(5.0, 0.5, 4.5, 3.0),
             slip(triangle(5.0, 0.5, 7), strength_stages(bonded, cohesion)), 1e-12},
            {"peak to residual friction by a step", "m", exact::slip_with_residual(5.0, 1.0, 3.0, 2.0, 0.25),
             slip(steady(5.0, 1.0, 3), strength_stages(block, residual)), 1e-12},
            {"friction falling with slip (sinh)", "m", exact::slip_with_softening(4.0, 1.0, 3.0, kappa, 0.5),
             slip(steady(4.0, 1.0, 10), strength_stages(block, linear(0.3, 0.1, 0.5))), 1e-12},
            {"friction rising with slip (sin)", "m", exact::slip_with_hardening(4.0, 3.0, omega),
             slip(steady(4.0, 2.0, 5), strength_stages(block, linear(0.3, 0.9, 1.0))), 1e-12},
            {"friction rising with slip, a_v rising (series)", "m",
             exact::slip_with_sloped_friction(4.0, 0.3, 0.6, 10.0, 0.5, 1.5, 20000),
             slip(with_vertical, strength_stages(block, linear(0.3, 0.9, 1.0))), 1e-12}};
}

/// Mean over 32 positions of the samples of the relative slip error of SLAMMER's scheme under a half sine with `per_wave` samples.
double slammer_error(double ratio, int per_wave)
{
    constexpr int positions = 32;
    double sum = 0.0;
    for (int i = 0; i < positions; ++i) {
        const double dt = 1.0 / per_wave, shift = (i + 0.5) / positions * dt;
        const auto wave = [=](double t) { return t < shift ? 0.0 : std::sin(std::numbers::pi * (t - shift)); };
        const std::vector<double> record = samples(wave, dt, 2 * per_wave); // a whole wave: every block stops in it
        sum += std::abs(slammer_slip(record, dt, ratio) / slide_constant_yield(record, dt, ratio).slip - 1.0);
    }
    return sum / positions;
}

std::vector<Check> slammer_bias()
{
    const double low = slammer_error(0.2, 50), middle = slammer_error(0.5, 50), high = slammer_error(0.95, 50);
    return {{"order in dt at a_y = 0.5 peak", "–", 2.0,
             std::log2(slammer_error(0.5, 100) / slammer_error(0.5, 400)) / 2.0, 0.15, Measure::absolute},
            {"order in dt at a_y = 0.95 peak", "–", 2.0,
             std::log2(slammer_error(0.95, 100) / slammer_error(0.95, 400)) / 2.0, 0.15, Measure::absolute},
            {"error at 0.5 peak, 50 samples per half wave", "–", 0.02, middle, 0.0, Measure::upper_bound},
            {"error at 0.95 peak over error at 0.2 peak", "–", 10.0, high / low, 0.0, Measure::lower_bound}};
}

} // namespace

void add_block_cases(Registry& registry)
{
    const std::string round_off = "closed solutions and events located to the last digits: round-off only";
    registry.push_back(
        {"sliding.block.yield", "Yield accelerations of a dam and of a wedge.",
         "Goldgruber (2015) (4-3) by hand; Newmark (1965): g tan(phi - theta), cos(phi - theta)/cos(phi)",
         "one formula: round-off", yields});
    registry.push_back(
        {"sliding.block.pulses", "Slip under a rectangle and a triangle does not depend on the sampling.",
         "Newmark (1965): A (A - a_y) t²/(2 a_y); integrated by hand for the triangle", round_off, pulses});
    registry.push_back(
        {"sliding.block.decaying-ramp",
         "Slip under a decaying ramp with the stop on a sample (0.1, 0.005 s) and inside an interval (0.0625 s).",
         "D = (2/3) t_d² (A - a_y)³/A², at rest from 2 t_d (A - a_y)/A on", round_off, decaying_ramp});
    registry.push_back({"sliding.block.sines", "Slip under sampled sines tends to that of the sine.",
                        "integrated by hand, the stop by bisection",
                        "A record is linear between its samples, so against the sine the sampling errs with dt²: the "
                        "order is checked, and the value "
                        "extrapolated from two steps (1e-7: next term); the train has 4000 samples a cycle, dt²/12 of "
                        "the curvature; against the "
                        "interpolant itself only round-off",
                        sines});
    registry.push_back(
        {"sliding.block.broad-band",
         "One- and two-way slip under a broad-band motion, and its independence of subdivision.",
         "the same interpolant in extended precision with bisection for every event",
         "round-off of some hundred movements; two-way slip is a difference of two sums ten times larger",
         broad_band_motion});
    registry.push_back(
        {"sliding.block.vertical", "Vertical motion, lift-off without and with flight, sign of a_v.",
         "integrated by hand: yield mu (g + a_v), no resistance while N' <= 0, landing impulse mu m |y'| on (m + M_w)",
         round_off, vertical});
    registry.push_back(
        {"sliding.block.inclined", "Slip of a wedge on an inclined plane.", "Newmark (1965)", round_off, inclined});
    registry.push_back({"sliding.block.strength-over-slip", "Strength that changes with slip.",
                        "integrated by hand; Runge-Kutta in extended precision where friction and N' both change",
                        round_off, strength_over_slip});
    registry.push_back({"sliding.block.slammer-bias", "SLAMMER's trapezoid scheme errs with dt², most near the peak.",
                        "the exact slip of the same record, a half sine in 32 positions of its samples",
                        "mean error over the positions; the order within 0.15, as a scheme that starts and stops on "
                        "samples is not smooth in dt",
                        slammer_bias});
}

} // namespace damslip::verification
