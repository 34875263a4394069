#include "verification/cases/modules.hpp"

#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "verification/cases/fe_hard_steps.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace damslip::verification {

namespace {

using fe2d::EarthquakeRun;
using fe2d::RunOptions;
using fe2d::RunResult;
using std::numbers::pi;
constexpr double first_frequency = 3.6, fifth_frequency = 15.0; ///< of the dam, about [Hz]

/// None, or 5 % at modes 1 and 5 wherever these lie for moduli times `stiffness`.
fe2d::RayleighConstants damping_of(double ratio, double stiffness)
{
    const double to_omega = 2.0 * pi * std::sqrt(stiffness);
    return ratio == 0.0 ? fe2d::RayleighConstants{}
                        : fe2d::rayleigh_constants(ratio, to_omega * first_frequency, to_omega * fifth_frequency);
}

double rigid_slip(Scene scene, double friction, const GroundMotion& motion)
{
    scene.contact.friction = friction;
    return sliding::slide(motion, sliding::make_rigid_block(scene)).slip;
}

GroundMotion amplified(GroundMotion motion, double factor)
{
    for (auto* a : {&motion.accel_h, &motion.accel_v})
        for (double& value : *a) value *= factor;
    return motion;
}

/// mu and polarity of the sliding tables.
struct Setting {
    double friction;
    bool flip;
    GroundMotion of(const GroundMotion& motion) const { return flip ? fe2d::test::flipped(motion) : motion; }
    std::string text() const { return fmt::format("mu {:.2f}{}", friction, flip ? " flipped" : ""); }
};
constexpr Setting settings[] = {{0.77, false}, {0.77, true}, {0.70, false}, {0.70, true}, {0.66, false}, {0.66, true}};

EarthquakeRun prepared(Scene scene, double ratio, double stiffness, int halvings)
{
    RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = halvings;
    options.damping = damping_of(ratio, stiffness);
    return EarthquakeRun(scene, options);
}

RunResult run_with(const EarthquakeRun& run, Contact contact, const Setting& setting, const GroundMotion& motion)
{
    contact.friction = setting.friction;
    return run.run(setting.of(motion), contact);
}

/// What shakes at f, up to 10 Hz here, is amplified by a dam of first frequency f_1 by 1/(1 - (f/f_1)²): the slip lies
/// between the rigid block's under the motion and under the motion amplified as its fastest part, with 1 % for the step.
/// Where f_1 lies within the motion only the lower bound holds.
std::vector<Check> rigid_limit_in_stiffness(double ratio)
{
    std::vector<Check> checks;
    const GroundMotion motion = fe2d::test::sines(1.0, 10.0);
    for (const double stiffness : {1.0, 10.0, 1e2, 1e3, 1e4}) {
        Scene scene = fe2d::test::sliding_dam(0.70, stiffness, 5.0);
        scene.sliding.run_out_max = 1.0; // without damping a soft dam does not come to rest
        const EarthquakeRun run = prepared(scene, ratio, stiffness, 2);
        const double share = 100.0 / (stiffness * first_frequency * first_frequency);
        for (const Setting& setting : settings) {
            if (setting.flip && share > 0.1) continue;
            const GroundMotion ground = setting.of(motion);
            const double rigid = rigid_slip(scene, setting.friction, ground);
            Check check{fmt::format("E x {:g}, {}", stiffness, setting.text()), "m", rigid,
                        run_with(run, scene.contact, setting, motion).slip,     0.0, Measure::lower_bound};
            if (share < 0.1) {
                check.measure = Measure::relative;
                check.tolerance =
                    0.01 + rigid_slip(scene, setting.friction, amplified(ground, 1.0 / (1.0 - share))) / rigid - 1.0;
            }
            checks.push_back(check);
        }
    }
    return checks;
}

std::vector<Check> rigid_limit_in_step(double ratio)
{
    std::vector<Check> checks;
    const GroundMotion motion = fe2d::test::sines(1.0);
    const double tolerance[] = {0.04, 0.02, 0.01};
    for (int halvings = 0; halvings <= 2; ++halvings) {
        const Scene scene = fe2d::test::sliding_dam(0.70, 1e4, 3.0);
        const EarthquakeRun run = prepared(scene, ratio, 1e4, halvings);
        for (const Setting& setting : settings)
            checks.push_back({fmt::format("dt {:g} s, {}", 0.01 / (1 << halvings), setting.text()), "m",
                              rigid_slip(scene, setting.friction, setting.of(motion)),
                              run_with(run, scene.contact, setting, motion).slip, tolerance[halvings],
                              Measure::relative});
    }
    return checks;
}

/// Error of the slip by the stiffness of a penalty, and by the slip tolerance of a stiffness that follows the pressure.
std::vector<Check> penalty()
{
    Scene scene = fe2d::test::sliding_dam(0.70, 1.0, 1.0);
    const GroundMotion motion = fe2d::test::sines(1.0, 6.0);
    RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = 0;
    options.damping = damping_of(0.05, 1.0);
    options.contact.landing = fe2d::Landing::ringing; // a penalty has no landings: the same step otherwise
    const auto slip = [&] { return EarthquakeRun(scene, options).run(motion).slip; };
    const double exact = slip();
    std::vector<Check> checks;
    const auto error_of = [&](const std::string& what, double bound) {
        const double error = std::abs(slip() / exact - 1.0);
        checks.push_back({"error of the slip, " + what, "-", bound, error, 0.0, Measure::upper_bound});
        return error;
    };
    double before = 0.0;
    for (int power = 8; power <= 13; ++power) {
        scene.contact.enforcement = ContactEnforcement::penalty;
        scene.contact.tangential_stiffness = std::pow(10.0, power);
        const std::string name = fmt::format("k = 1e{} N/m3", power);
        const double error = error_of(name, power == 8 ? 10.0 : 0.3 * before);
        if (power >= 12)
            checks.push_back({"over the decade before, " + name, "-", 0.1, error / before, 0.02, Measure::absolute});
        before = error;
    }
    scene.contact.enforcement = ContactEnforcement::slip_tolerance;
    before = 10.0;
    for (const double tolerance : {0.05, 0.005, 0.0005, 1e-5}) {
        scene.contact.slip_tolerance = tolerance;
        before = error_of(fmt::format("F_f = {:g}", tolerance), before);
    }
    return checks;
}

struct HardRun {
    const char* name;
    double friction, stiffness, contact_size, peak, duration;
};

std::vector<Check> hardest_steps_by_lemke()
{
    std::vector<Check> checks;
    for (const HardRun& hard :
         {HardRun{"mu 0.66", 0.66, 1.0, 1.5, 1.0, 20.0}, HardRun{"rocking, mu 1.0, 5 m/s2", 1.0, 1.0, 1.5, 5.0, 20.0},
          HardRun{"undamped, E x 100, 4 m/s2", 0.66, 1e2, 3.0, 4.0, 10.0},
          HardRun{"undamped, E x 1e4, 2 m/s2", 0.66, 1e4, 3.0, 2.0, 20.0}}) {
        const Scene scene = fe2d::test::sliding_dam(hard.friction, hard.stiffness, hard.contact_size);
        RunOptions options = fe2d::test::options_of(scene);
        if (hard.stiffness > 1.0) options.damping = fe2d::RayleighConstants{};
        const StepRecords records = recorded_run(scene, options, fe2d::test::sines(hard.peak, hard.duration));
        int solved = 0, least = 1000;
        double force = 0.0, displacement = 0.0;
        for (const std::size_t step : hardest_steps(records, 25)) {
            const LemkeDifference difference = compare_with_lemke(records, step);
            solved += difference.solved;
            force = std::max(force, difference.force);
            displacement = std::max(displacement, difference.displacement);
            least = std::min(least, records.steps[step].report.iterations);
        }
        const auto row = [&](const char* what, double expected, double computed, Measure measure) {
            checks.push_back({std::string(hard.name) + ": " + what, "-", expected, computed, 0.0, measure});
        };
        row("steps solved by Lemke's method", 25.0, solved, Measure::absolute);
        row("iterations of the easiest of them", 4.0, least, Measure::lower_bound);
        row("difference of a force over N'", hard.stiffness > 1e3 ? 1e-6 : 1e-8, force, Measure::upper_bound);
        if (hard.stiffness < 1e3) row("difference of V_ii x_i over N'", 1e-8, displacement, Measure::upper_bound);
    }
    return checks;
}

/// A burst of two sines of 2 and 3 Hz under a window that starts and ends smoothly.
GroundMotion burst(double peak)
{
    GroundMotion motion;
    motion.name = "burst";
    motion.dt = 0.02;
    for (int k = 0; k <= 110; ++k) {
        const double t = k * motion.dt, window = t < 2.0 ? std::pow(std::sin(0.5 * pi * t), 2) : 0.0;
        motion.accel_h.push_back(peak * window * std::sin(4.0 * pi * t));
        motion.accel_v.push_back(0.5 * peak * window * std::sin(6.0 * pi * t));
    }
    return motion;
}

/// Largest difference of two histories of the same rows.
double distance(const std::vector<double>& a, const std::vector<double>& b)
{
    double largest = 0.0;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
    return largest;
}

/// Errors of the history of slip, or of the crest where friction and a shut joint tie the dam, against a finest step.
std::vector<Check> order_in_step()
{
    std::vector<Check> checks;
    for (const bool slides : {false, true}) {
        Scene scene = fe2d::test::sliding_dam(slides ? 0.70 : 5.0, 1.0, 5.0);
        scene.sliding.run_out_max = 0.1;
        RunOptions options = fe2d::test::options_of(scene);
        options.damping = damping_of(0.05, 1.0);
        const auto history = [&](int halvings) {
            scene.time.substeps = halvings;
            const RunResult result = EarthquakeRun(scene, options).run(burst(slides ? 3.0 : 1e-3));
            return slides ? result.history.slip : result.history.crest_x;
        };
        const std::vector<double> finest = history(8);
        const double first = distance(history(1), finest);
        double before = first;
        for (int halvings = 2; halvings <= 5; ++halvings) {
            const double error = distance(history(halvings), finest);
            const std::string step = fmt::format("dt {:g} s", 0.02 / (1 << halvings));
            if (slides)
                checks.push_back({"error of the slip, " + step, "m", first / (1 << (halvings - 1)), error, 0.0,
                                  Measure::upper_bound});
            else
                checks.push_back(
                    {"order, tied, " + step, "-", 2.0, std::log2(before / error), 0.05, Measure::absolute});
            before = error;
        }
        if (slides)
            checks.push_back(
                {"mean order, sliding", "-", 1.5, 0.25 * std::log2(first / before), 0.6, Measure::absolute});
    }
    return checks;
}

} // namespace

void add_fe_sliding_cases(Registry& registry)
{
    for (const double ratio : {0.0, 0.05}) {
        const std::string suffix = ratio == 0.0 ? "-undamped" : "-damped";
        const std::string damping = ratio == 0.0 ? "undamped." : "5 % damping of the deformation only.";
        registry.push_back(
            {"fe.sliding.rigid-limit-in-stiffness" + suffix,
             "Slip of the dam as its moduli and the rock's grow, both polarities and vertical motion: " + damping,
             "event-located rigid block, Newmark (1965), Goldgruber (2015) eq. (4-1), (4-3)",
             "E x 100 on: what the rigid block slides more under the motion amplified by 1/(1 - (10 Hz/f_1)^2), and 1 "
             "% "
             "for the step of 0.0025 s; softer dams, whose f_1 is shaken, slide more",
             [ratio] { return rigid_limit_in_stiffness(ratio); }});
        registry.push_back(
            {"fe.sliding.rigid-limit-in-step" + suffix,
             "Slip of the dam with moduli times 1e4 as the step gets smaller, both polarities and vertical motion: " +
                 damping,
             "event-located rigid block",
             "first order: friction switches at step ends, so a slide lasts up to a step too long, 4 % at 0.01 s with "
             "slides of some 0.25 s; 1 % at 0.0025 s",
             [ratio] { return rigid_limit_in_step(ratio); }});
    }
    registry.push_back(
        {"fe.sliding.penalty-to-exact",
         "The slip with a tangential penalty tends to that of the exact law, with first order in 1/k.",
         "exact Coulomb contact of the same mesh and step; Goldgruber (2015) eq. (4-10)...(4-12) for F_f",
         "each decade of k takes away 70 % of the error at least, from 1e11 on nine tenths: the spring's "
         "give is proportional to 1/k. F_f: each smaller than the one before; 0.005 is the source's",
         penalty});
    registry.push_back(
        {"fe.sliding.hardest-steps-by-lemke",
         "The 25 steps of a run that took most iterations have the solution that complementary pivoting finds.",
         "Lemke's method (Cottle, Pang & Stone 1992) on the formulation of Stewart & Trinkle (1996)",
         "1e-8 of N': ties of the pivoting are broken by 1e-11 of N', times the condition of V, 50 to 800; 7e4 with "
         "E x 1e4, where a force is compared to 1e-6",
         hardest_steps_by_lemke});
    registry.push_back(
        {"fe.sliding.order-in-step",
         "A smooth burst on the reference scene: second order tied, between first and second order sliding.",
         "the same run with steps of 0.08 ms",
         "tied: 0.05 of the order, steps of 0.005 s on; sliding: pairs stick and slip at step ends, so single errors "
         "only "
         "stay below first order from the first, and the order is a mean over four halvings",
         order_in_step});
}

} // namespace damslip::verification
