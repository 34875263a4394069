#include "verification/cases/modules.hpp"

#include "fe2d/run/earthquake_run.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using std::numbers::pi;

constexpr double block_base = 8.0, block_height = 4.0, block_mass = block_base * block_height * 2400.0; // [m], [kg/m]

/// A stiff block on a rigid plane with a row of anchors through the middle of its base.
Scene anchored_block(const Anchor& anchor)
{
    Scene scene = exact::bare_scene({{0, 0}, {block_base, 0}, {block_base, block_height}, {0, block_height}}, 2400.0);
    scene.dam.young_modulus = 3e12;
    scene.dam.poisson_ratio = 0.0;
    scene.contact.friction = 0.3;
    scene.mesh.size = block_base / 4.0;
    scene.mesh.contact_size = block_base / 4.0;
    scene.damping.method = DampingMethod::none;
    scene.anchors = {anchor};
    return scene;
}

/// Along the slip where ψ = 90°: k of a period of 0.5 s.
Anchor row_of_bars(double inclination, double yield_over_weight)
{
    Anchor anchor;
    anchor.name = "row";
    anchor.distance = 3.3; // between two nodes
    anchor.inclination = inclination;
    anchor.free_length = 10.0;
    anchor.young_modulus = 200e9;
    const double k = block_mass * 16.0 * pi * pi;
    anchor.area = k * anchor.free_length / anchor.young_modulus;
    anchor.yield_strength = yield_over_weight * block_mass * 9.81 / anchor.area;
    return anchor;
}

GroundMotion level_pulse(double accel, double seconds, double duration)
{
    GroundMotion motion;
    motion.dt = 0.01;
    for (double t = 0.0; t < duration + 1e-9; t += motion.dt) motion.accel_h.push_back(t < seconds ? accel : 0.0);
    return motion;
}

/// Slip and plastic strain against the rigid block, which sliding.anchor.slider-with-bar holds to a solution by hand.
std::vector<Check> fe_slider_with_bar()
{
    std::vector<Check> checks;
    for (const double psi : {0.5 * pi, pi / 6.0}) {
        Scene scene = anchored_block(row_of_bars(psi, 0.35));
        scene.time.substeps = 3;
        const GroundMotion motion = level_pulse(6.0, 0.3, 1.0);
        const sliding::SlideResult rigid =
            sliding::slide(motion, sliding::SlipStages{{0.0, sliding::make_rigid_block(scene), 0.0}},
                           {scene.sliding, 1, sliding::HistoryOutput::none, sliding::base_anchors(scene)});
        const fe2d::RunResult fe = fe2d::EarthquakeRun(scene, fe2d::test::options_of(scene)).run(motion);
        const std::string with = psi > 1.0 ? ", along the slip" : ", 30° from the normal";
        const AnchorHistory &a = fe.anchors.front().history, &b = rigid.anchors.front().history;
        checks.push_back({"largest slip" + with, "m", rigid.max_slip, fe.max_slip, 0.01});
        checks.push_back({"slip at the end" + with, "m", rigid.slip, fe.slip, 0.01});
        checks.push_back({"largest force" + with, "N/m", b.largest_force, a.largest_force, 0.01});
        checks.push_back({"plastic strain" + with, "-", b.plastic_strain, a.plastic_strain, 0.01});
        checks.push_back({"imbalance of energy over the largest term" + with, "-", 1e-9, fe.energy_error, 0.0,
                          Measure::upper_bound});
        // What the linear force of each step leaves of the bar's work is the scheme's.
        const fe2d::Energy& energy = fe.history.energy.back();
        checks.push_back({"energy of the scheme over plastic work" + with, "-", 0.02,
                          std::abs(energy.numerical) / energy.anchor_plastic, 0.0, Measure::upper_bound});
        checks.push_back({"unresolved steps" + with, "-", 0.5, static_cast<double>(fe.counts.unresolved), 0.0,
                          Measure::upper_bound});
    }
    return checks;
}

/// The prestress presses and, inclined, pulls: N' and T of the stage by hand, and the force that is left after all stages.
std::vector<Check> prestress_stage()
{
    Anchor anchor = row_of_bars(pi / 12.0, 1.0);
    anchor.prestress = 0.5 * anchor.yield_strength * anchor.area;
    Scene scene = anchored_block(anchor);
    scene.contact.friction = 0.7;
    const fe2d::RunResult fe =
        fe2d::EarthquakeRun(scene, fe2d::test::options_of(scene)).run(level_pulse(0.0, 0.0, 0.1));
    const double P = anchor.prestress, weight = block_mass * 9.81;
    std::vector<Check> checks;
    if (fe.stages.size() < 2) return {{"stages", "-", 2.0, static_cast<double>(fe.stages.size()), 0.0}};
    const fe2d::StageResult& stage = fe.stages[1];
    checks.push_back(
        {"N' after stressing", "N/m", weight + P * std::cos(pi / 12.0), stage.resultant.normal_force, 1e-9});
    checks.push_back({"T after stressing", "N/m", -P * std::sin(pi / 12.0), stage.resultant.shear_force, 1e-9});
    checks.push_back(
        {"position of N' from the heel", "m",
         (0.5 * block_base * weight + anchor.distance * P * std::cos(pi / 12.0)) / (weight + P * std::cos(pi / 12.0)),
         stage.resultant.position, 1e-9});
    // On pairs that stick nothing stretches it.
    checks.push_back({"force at the end", "N/m", P, fe.anchors.front().history.force, 1e-9});
    return checks;
}

} // namespace

void add_fe_anchor_cases(Registry& registry)
{
    registry.push_back(
        {"fe.anchor.slider-with-bar", "A stiff block against a bar by finite elements: stretch, yield, unload.",
         "rigid block on the same bar (sliding.anchor.slider-with-bar)",
         "1 %: slides begin and end, and bars yield, at step ends, 0.00125 s of slides of 0.3 s", fe_slider_with_bar});
    registry.push_back({"fe.anchor.prestress", "Prestress as a stage of its own.", "statics by hand",
                        "sums over nodes: 1e-9", prestress_stage});
}

} // namespace damslip::verification
